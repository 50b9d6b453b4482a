#include "native/coarse_piece.h"

#include <utility>

namespace reflines {

// The samples see ripples finer than their distance as some other, smooth change. The exact gradient does not: with it
// in their place the motions start the right way whatever the detail.
CoarsePiece::CoarsePiece(const HeightField& field, const Energy& energy, SmoothModes modes, const Vector& z,
                         const Vector& gradient)
    : modes_(std::move(modes)), energy_(field, energy, modes_, z), missed_(modes_.pull_back(gradient)) {
  Vector sampled(size());
  energy_.evaluate(Vector::Zero(size()), &sampled);
  missed_ -= sampled;
}

double CoarsePiece::evaluate(const Vector& c, Vector* gradient) {
  const double energy = energy_.evaluate(c, gradient);
  if (gradient) *gradient += missed_;
  return energy + missed_.dot(c);
}

}  // namespace reflines
