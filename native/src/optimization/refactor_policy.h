// Decides when the factor of a Hessian at another point is to be replaced by one at the current point.
#pragma once

#include <array>

namespace reflines {

// Watches the gradient norms since the factor in use was made (or taken over from the solve before). Decides by counts
// and rates alone, never by a clock, so that the same input takes the same steps on any machine.
class RefactorPolicy {
 public:
  // A factor is taken into use at a point with this gradient norm; the solve ends when the norm is down to `target`.
  void start(double gradient_norm, double target);
  void observe(double gradient_norm);  // after every accepted step

  // True where a new factor costs fewer steps than the contraction of the last steps promises to need without it.
  bool is_too_slow() const;

 private:
  static constexpr int kWindow =
      4;  // single norms jump up and down under quasi-Newton steps; the mean rate of a few does not
  std::array<double, kWindow> norms_{};  // the latest last
  int count_ = 0;
  double target_ = 0.0;
};

}  // namespace reflines
