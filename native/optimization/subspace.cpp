#include "native/optimization/subspace.h"

#include <utility>

namespace reflines {

Subspace::Subspace(Problem& whole, const SparseMatrix& modes, Point origin)
    : whole_(whole),
      modes_(modes),
      origin_(origin.x),
      point_(std::move(origin)),
      c_(Vector::Zero(modes.rows())),
      product_(modes) {}

const Subspace::Point& Subspace::point(const Vector& c) {
  if (c == c_) return point_;
  c_ = c;
  point_.x.noalias() = origin_ + modes_.transpose() * c;
  point_.energy = whole_.evaluate(point_.x, &point_.gradient);
  ++evaluations_;
  return point_;
}

double Subspace::evaluate(const Vector& c, Vector* gradient) {
  const Point& here = point(c);
  if (gradient != nullptr) gradient->noalias() = modes_ * here.gradient;
  return here.energy;
}

const SparseMatrix& Subspace::hessian(const Vector& c, HessianModel model) {
  const SparseMatrix& hessian = whole_.hessian(point(c).x, model);
  whole_diagonal_ = hessian.diagonal();
  return product_.project(hessian);
}

}  // namespace reflines
