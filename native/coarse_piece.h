// A piece from afar: its heights moved by B-splines, its energy read from a few triangles.
#pragma once

#include "native/geometry/smooth_modes.h"
#include "native/optimization/problem.h"
#include "native/reflection/sampled_energy.h"

namespace reflines {

class CoarsePiece final : public CoarseProblem {
 public:
  // Around the heights z (#V), where the energy's gradient over the free vertices is `gradient`.
  CoarsePiece(const HeightField& field, const Energy& energy, SmoothModes modes, const Vector& z,
              const Vector& gradient);

  int size() const override { return modes_.count; }
  double evaluate(const Vector& c, Vector* gradient) override;
  const SparseMatrix& hessian(const Vector& c, HessianModel model) override { return energy_.hessian(c, model); }
  void move(const Vector& c, Vector& x) const override { modes_.move(c, x); }

 private:
  SmoothModes modes_;
  SampledEnergy energy_;
  Vector missed_;  // the true gradient at c = 0 less that of the samples
};

}  // namespace reflines
