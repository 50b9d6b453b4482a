// A run of a Minimizer within limits: sequential quadratic programming on a kept factor.
#pragma once

#include "optimization/problem.h"
#include "optimization/row_limits.h"
#include "optimization/workspace.h"
#include "reflines/minimizer_options.h"
#include "reflines/progress.h"
#include "reflines/report.h"

namespace reflines {

// Implements Minimizer::minimize by sequential quadratic programming; `progress` may be null. It starts with the free
// minimum: where that lies within the limits it is the result, to the last bit. Otherwise a quadratic model with the
// limits determines the contacts, and steps with its factor, accelerated like those of a free run, follow while these
// stay the same. All points are within the limits. It ends where the gradient without the contacts' forces has reached
// the tolerance: a Karush-Kuhn-Tucker point.
Report descend_within(const RowLimits& limits, Problem& problem, Vector& x, const MinimizerOptions& options,
                      Progress* progress, Workspace& workspace);

}  // namespace reflines
