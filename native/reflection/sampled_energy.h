// The energy along smooth motions, E(z + P c), read from a few triangles that stand for their neighbours: what a far
// minimum is approached with, at a fraction of the cost of the energy itself.
#pragma once

#include <array>
#include <vector>

#include "native/geometry/smooth_modes.h"
#include "native/reflection/energy.h"
#include "native/types.h"

namespace reflines {

class SampledEnergy {
 public:
  // Of `energy` with its present terms at the heights z (#V). All three outlive it.
  SampledEnergy(const HeightField& field, const Energy& energy, const SmoothModes& modes, const Vector& z);

  double evaluate(const Vector& c, Vector* gradient) const;          // c: #modes; gradient of that length
  const SparseMatrix& hessian(const Vector& c, HessianModel model);  // lower triangle, overwritten by the next call

 private:
  using Block = Eigen::Matrix<double, 16, 16>;

  // A sample's triangle at the start: how far it is from where the pull goes to, and f_x, f_y, f_xx, f_xy, f_yy.
  using Vector6 = Eigen::Matrix<double, 6, 1>;
  struct Start {
    Vector6 u;
    double pull = 0.0;  // weight of the square of the first
  };
  void make_pattern();
  Block block(const ModeCell& cell, const Vector& c, HessianModel model) const;

  const Energy& energy_;
  const SmoothModes& modes_;
  std::vector<Start> start_;                     // #samples
  std::vector<std::array<int, 136>> positions_;  // of a cell's lower triangle among the values of H_, or -1
  SparseMatrix H_;
};

}  // namespace reflines
