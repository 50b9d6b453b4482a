// The coarse problem of a piece: heights moved by B-splines, the energy sampled on a few triangles, and the gradient
// corrected to that of the fine problem at the start (first-order coherence as in MG/OPT, Nash 2000).
#pragma once

#include <utility>

#include "optimization/problem.h"
#include "solver/coarse/sampled_energy.h"
#include "solver/coarse/spline_basis.h"

namespace reflines {

class CoarsePiece final : public CoarseProblem {
 public:
  // Samples the energy around the heights z (#V), where its gradient over the free vertices is `gradient`.
  CoarsePiece(const HeightField& field, const Energy& energy, SplineBasis modes, const Vector& z,
              const Vector& gradient)
      : modes_(std::move(modes)), energy_(field, energy, modes_, z), correction_(modes_.pull_back(gradient)) {
    Vector sampled(size());
    energy_.evaluate(Vector::Zero(size()), &sampled);
    correction_ -= sampled;
  }

  int size() const override { return modes_.count; }
  double evaluate(const Vector& c, Vector* gradient) override {
    const double energy = energy_.evaluate(c, gradient);
    if (gradient) *gradient += correction_;
    return energy + correction_.dot(c);
  }
  const SparseMatrix& hessian(const Vector& c, HessianModel model) override { return energy_.hessian(c, model); }
  void move(const Vector& c, Vector& x) const override { modes_.move(c, x); }

 private:
  SplineBasis modes_;
  SampledEnergy energy_;
  // The fine gradient at c = 0 minus the sampled one: samples alias detail finer than their distance into a smooth
  // change. With this linear correction coarse steps descend the fine energy whatever its detail.
  Vector correction_;
};

}  // namespace reflines
