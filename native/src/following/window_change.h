// The smoothest change of theta by the motions of a window with given values at points, as targets/smooth_change.h has
// it on the whole mesh.
#pragma once

#include <Eigen/Cholesky>
#include <vector>

#include "following/spline_window.h"
#include "optimization/linear/linear_solver.h"
#include "reflines/types.h"

namespace reflines {

class WindowChange {
 public:
  // Minimizes the integral of the squared Laplacian and of the square times `firmness` (#samples); `still` are the
  // vertices where the change is 0. `window` outlives it.
  WindowChange(const SplineWindow& window, const std::vector<ModeRow>& still, const Vector& firmness,
               LinearSolverKind kind);

  // Chooses the points; places of equal handles keep their bits.
  void set_places(const std::vector<ModeRow>& places);

  // Returns the coefficients of the change with these values (#places). Where two places contradict each other it is
  // between them.
  Vector interpolate(const Vector& values) const;

 private:
  const SplineWindow& window_;
  LinearSolver solver_;
  Eigen::MatrixXd influence_;  // #motions x #places
  Eigen::LDLT<Eigen::MatrixXd> system_;
};

}  // namespace reflines
