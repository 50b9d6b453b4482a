#include "native/reflection/energy.h"

#include <Eigen/Eigenvalues>
#include <algorithm>
#include <cmath>

namespace reflines {
namespace {

// Sums of a fixed number of neighbours first, then those: the same bits for any number of threads, and better rounding
// than one long chain.
double chunked_sum(const Vector& values) {
  constexpr Eigen::Index kChunk = 1024;
  double sum = 0;
  for (Eigen::Index first = 0; first < values.size(); first += kChunk) {
    sum += values.segment(first, std::min(kChunk, values.size() - first)).sum();
  }
  return sum;
}

Vector pull_weights(const HeightField& field, double proximity) {
  if (proximity <= 0) return {};
  Vector pull = Vector::Zero(field.vertex_count());
  const double scale = proximity / std::pow(field.diagonal(), 4);
  for (int t = 0; t < field.triangle_count(); ++t) {
    for (int i = 0; i < 3; ++i) pull(field.F(t, i)) += scale * field.area(t) / 3.0;
  }
  return pull;
}

Matrix5 projected(const Matrix5& M) {
  const Eigen::SelfAdjointEigenSolver<Matrix5> eigen(M);
  if (eigen.eigenvalues()(0) >= 0) return M;
  return eigen.eigenvectors() * eigen.eigenvalues().cwiseMax(0.0).asDiagonal() * eigen.eigenvectors().transpose();
}

Matrix5 term_hessian(const EnergyTerm& term, int t, const Vector5& u, HessianModel model) {
  if (term.theta.size() > 0) return value_fit_hessian(term.reflection, u, term.theta(t), term.weight(t), model);
  return gradient_fit_hessian(term.reflection, u, term.gradient.row(t), term.weight(t), model);
}

}  // namespace

Energy::Energy(const HeightField& field, const Stencils& stencils, double proximity)
    : stencils_(stencils),
      entries_(stencils, field.vertex_count()),
      start_(field.z),
      pull_(pull_weights(field, proximity)),
      y_(stencils.triangle_count(), 5),
      share_(stencils.triangle_count()) {}

double Energy::sum_triangles(bool with_gradient) {
#pragma omp parallel for schedule(static) if (stencils_.triangle_count() > kWorthThreads)
  for (int t = 0; t < stencils_.triangle_count(); ++t) {
    const Vector5 u = u_.row(t);
    Vector5 slope = Vector5::Zero();
    double sum = 0;
    for (const EnergyTerm& term : terms_) {
      if (term.weight(t) == 0) continue;
      Vector5* gradient = with_gradient ? &slope : nullptr;
      sum += term.theta.size() > 0 ? value_fit(term.reflection, u, term.theta(t), term.weight(t), gradient)
                                   : gradient_fit(term.reflection, u, term.gradient.row(t), term.weight(t), gradient);
    }
    share_(t) = sum;
    y_.row(t) = slope;
  }
  return chunked_sum(share_);
}

double Energy::evaluate(const Vector& z, Vector* gradient) {
  apply_stencils(stencils_, z, u_);
  double energy = sum_triangles(gradient != nullptr);
  if (gradient) apply_transposed(stencils_, entries_, y_, products_, *gradient);
  if (pull_.size() == 0) return energy;
  for (int v = 0; v < z.size(); ++v) energy += pull_(v) * (z(v) - start_(v)) * (z(v) - start_(v));
  if (gradient) gradient->array() += 2 * pull_.array() * (z - start_).array();
  return energy;
}

const Energy::ElementHessians& Energy::element_hessians(const Vector& z, HessianModel model) {
  apply_stencils(stencils_, z, u_);
  elements_.resize(stencils_.triangle_count(), 15);
#pragma omp parallel for schedule(static) if (stencils_.triangle_count() > kWorthThreads)
  for (int t = 0; t < stencils_.triangle_count(); ++t) {
    Matrix5 M = Matrix5::Zero();
    for (const EnergyTerm& term : terms_) {
      if (term.weight(t) != 0) M += term_hessian(term, t, u_.row(t), model);
    }
    if (model == HessianModel::kNewton) M = projected(M);
    int k = 0;
    for (int i = 0; i < 5; ++i) {
      for (int j = i; j < 5; ++j) elements_(t, k++) = M(i, j);
    }
  }
  return elements_;
}

}  // namespace reflines
