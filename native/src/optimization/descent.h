// A run of a Minimizer without limits.
#pragma once

#include "optimization/problem.h"
#include "optimization/workspace.h"
#include "reflines/minimizer_options.h"
#include "reflines/progress.h"
#include "reflines/report.h"

namespace reflines {

// Implements Minimizer::minimize. `progress` may be null.
Report descend(Problem& problem, Vector& x, const MinimizerOptions& options, Progress* progress, Workspace& workspace);

}  // namespace reflines
