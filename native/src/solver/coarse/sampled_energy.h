// The energy of a coarse height change, E(z + P c), by reduced quadrature: each sampled triangle stands for its
// neighbours, at a fraction of the energy's cost.
#pragma once

#include <array>
#include <vector>

#include "reflection/energy.h"
#include "reflines/types.h"
#include "solver/coarse/spline_basis.h"

namespace reflines {

class SampledEnergy {
 public:
  // Samples `energy` with its present terms at the heights z (#V). `field`, `energy` and `modes` outlive it.
  SampledEnergy(const HeightField& field, const Energy& energy, const SplineBasis& modes, const Vector& z);

  double evaluate(const Vector& c, Vector* gradient) const;          // c: #modes; gradient of that length
  const SparseMatrix& hessian(const Vector& c, HessianModel model);  // lower triangle, overwritten by the next call

 private:
  using Block = Eigen::Matrix<double, 16, 16>;

  // The state of a sample's triangle at the start: its height above the rest of the pull, and f_x, f_y, f_xx, f_xy,
  // f_yy.
  using Vector6 = Eigen::Matrix<double, 6, 1>;
  struct Start {
    Vector6 u;
    double pull = 0.0;  // weight of the square of the first
  };
  using Coefficients = Eigen::Matrix<double, 16, 1>;  // of a cell's modes; 0 for those left out
  struct MovedSample {
    const SplineSample& sample;
    SplineDerivatives D;
    Vector6 u;  // the state after the move of its cell
  };

  MovedSample move_sample(int s, const Coefficients& own) const;
  void make_pattern();
  Block block(const SplineCell& cell, const Vector& c, HessianModel model) const;

  const Energy& energy_;
  const SplineBasis& modes_;
  std::vector<Start> start_;                     // #samples
  std::vector<std::array<int, 136>> positions_;  // of a cell's lower triangle among the values of H_, or -1
  SparseMatrix H_;
};

}  // namespace reflines
