// Decides when the factor of a Hessian at another point is to be replaced by one at the current point.
#pragma once

#include <array>

namespace reflines {

// The policy of refactoring. It follows the gradient norms since the factor was made (or taken over from the previous
// solve) and decides by counts and rates alone, never by a clock, so that the same input takes the same steps on any
// machine.
class RefactorPolicy {
 public:
  // Takes the cost of an assembly and factorization in steps (a solve, an evaluation, the quasi-Newton products): 22 to
  // 28 were measured from 10k to 1M unknowns; and the number of steps to the last digits with a fresh factor.
  explicit RefactorPolicy(double steps_per_factorization = 25.0, double steps_after = 5.0)
      : steps_per_factorization_(steps_per_factorization), steps_after_(steps_after) {}

  // Starts with a factor at a point with this gradient norm; the solve ends when the norm has reached `target`.
  void start(double gradient_norm, double target);
  void observe(double gradient_norm);  // after every accepted step

  // Returns whether a new factor costs fewer steps than the present one is expected to need at the recent rate of
  // contraction.
  bool is_too_slow() const;

 private:
  static constexpr int kWindow = 4;  // single norms oscillate under quasi-Newton steps; the mean rate of a few does not
  double steps_per_factorization_, steps_after_;
  std::array<double, kWindow> norms_{};  // the latest last
  int count_ = 0;
  double target_ = 0.0;
};

}  // namespace reflines
