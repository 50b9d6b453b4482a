// The options of the minimizer: its strategy, its tolerance and its limit of steps. The defaults stand here once;
// bindings read them from the struct.
#pragma once

namespace reflines {

enum class Strategy {
  kAdaptive,     // Gauss-Newton factored once, accelerated from the gradients seen, refactored where that is too slow
  kLinearized,   // the paper, section 3.1: the constant linearised Hessian, factored once, with a line search
  kGaussNewton,  // Gauss-Newton, factored at every step
  kNewton,       // full second derivatives projected to positive semi-definite, factored at every step
};
const char* to_string(Strategy strategy);  // "adaptive", "linearized", "gauss_newton", "newton"

struct MinimizerOptions {
  Strategy strategy = Strategy::kAdaptive;
  double gradient_tolerance = 1e-6;  // |g| at the end / |g| at the start of this solve, Euclidean norms
  int max_iterations = 100;          // accepted steps
};

}  // namespace reflines
