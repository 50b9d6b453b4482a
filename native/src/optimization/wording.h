// The sentences and the input checks that all descents use.
#pragma once

#include <string>

#include "optimization/problem.h"
#include "reflines/minimizer_options.h"
#include "reflines/progress.h"

namespace reflines {

// Formats two numbers; `format` holds two %g.
std::string format_sentence(const char* format, double first, double second);

// Returns what ended a descent within limits, by the norm of the projected gradient and the one that was wanted.
std::string describe_small_gradient(double norm, double wanted);

// Throws InvalidInput unless there is one value for each unknown, and the energy and the norm of its gradient are
// finite.
void check_start(Eigen::Index values, int unknowns);
void check_start(double energy, double gradient_norm);

HessianModel choose_model(Strategy strategy);

// Reports a stage to `progress` (or to nobody), with the fraction of the digits of the gradient norm that are gained;
// it never decreases.
void report_digits(Progress* progress, const char* stage, double norm_before, double norm, double wanted_norm);

}  // namespace reflines
