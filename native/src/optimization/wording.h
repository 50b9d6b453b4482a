// What both descents say and ask in the same words.
#pragma once

#include <string>

#include "optimization/problem.h"
#include "reflines/minimizer_options.h"

namespace reflines {

// `format` holds two %g.
std::string sentence(const char* format, double first, double second);

// InvalidInput where there is not one value an unknown, or where the energy or the norm of its gradient is not finite.
void check_start(Eigen::Index values, int unknowns);
void check_start(double energy, double gradient_norm);

HessianModel model_of(Strategy strategy);

}  // namespace reflines
