#include "solver/coarse/coarse_piece.h"

#include <utility>

namespace reflines {

// Corrects the sampled gradient: samples alias detail finer than their distance into a smooth change. The linear
// correction makes the coarse gradient equal the projected fine one at c = 0, so that coarse steps descend the fine
// energy whatever its detail.
CoarsePiece::CoarsePiece(const HeightField& field, const Energy& energy, SplineBasis modes, const Vector& z,
                         const Vector& gradient)
    : modes_(std::move(modes)), energy_(field, energy, modes_, z), correction_(modes_.pull_back(gradient)) {
  Vector sampled(size());
  energy_.evaluate(Vector::Zero(size()), &sampled);
  correction_ -= sampled;
}

double CoarsePiece::evaluate(const Vector& c, Vector* gradient) {
  const double energy = energy_.evaluate(c, gradient);
  if (gradient) *gradient += correction_;
  return energy + correction_.dot(c);
}

}  // namespace reflines
