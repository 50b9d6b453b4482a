// The energy of a window's motions: that of the targets' terms on its samples, with a weight on vertices that stay.
#pragma once

#include <vector>

#include "following/coupled_sum.h"
#include "following/spline_window.h"
#include "optimization/problem.h"
#include "reflection/energy.h"
#include "reflines/types.h"

namespace reflines {

class WindowEnergy final : public Problem {
 public:
  // Takes heights z (#V) of the start, the energy whose triangles are the window's samples in order, the rows of
  // vertices that stay, and the density of the pull to the start (see Energy). All but z outlive it.
  WindowEnergy(const SplineWindow& window, const Energy& energy, const Vector& z, const std::vector<ModeRow>& still,
               double pull_density);

  int size() const override { return window_.count(); }
  double evaluate(const Vector& c, Vector* gradient) override;
  const SparseMatrix& hessian(const Vector& c, HessianModel model) override;

 private:
  using State = Eigen::Matrix<double, 6, 1>;
  State move(int s, const Vector& c) const;

  const SplineWindow& window_;
  const Energy& energy_;
  const std::vector<ModeRow>& still_;
  Eigen::Matrix<double, Eigen::Dynamic, 5, Eigen::RowMajor> start_;  // #samples
  Vector pull_;                                                      // #samples
  double still_weight_ = 0.0;
  CoupledSum sum_;
};

}  // namespace reflines
