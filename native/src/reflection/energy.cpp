#include "reflection/energy.h"

#include <Eigen/Eigenvalues>
#include <algorithm>
#include <cmath>

namespace reflines {
namespace {

// Sums values in chunks of a fixed size and then the chunks: the same bits for any number of threads, and less rounding
// than one long chain.
double sum_in_chunks(const Vector& values) {
  constexpr Eigen::Index kChunk = 1024;
  double sum = 0;
  for (Eigen::Index first = 0; first < values.size(); first += kChunk) {
    sum += values.segment(first, std::min(kChunk, values.size() - first)).sum();
  }
  return sum;
}

Vector pull_weights(const HeightField& field, double density) {
  if (density <= 0) return {};
  Vector pull = Vector::Zero(field.vertex_count());
  for (int t = 0; t < field.triangle_count(); ++t) {
    for (int i = 0; i < 3; ++i) pull(field.F(t, i)) += density * field.area(t) / 3.0;
  }
  return pull;
}

Matrix5 project_semi_definite(const Matrix5& M) {
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
      pull_density_(proximity > 0 ? proximity / std::pow(field.piece_diagonal(), 4) : 0.0),
      proximity_(pull_weights(field, pull_density_)),
      pull_(proximity_),
      triangle_energy_(stencils.triangle_count()),
      products_(stencils.vertex.size()) {}

void Energy::pull_to(const Vector& z, const Vector& weight) {
  start_ = z;
  pull_ = proximity_.size() > 0 ? Vector(proximity_ + weight) : weight;
}

void Energy::pull_as_built(const Vector& z) {
  start_ = z;
  pull_ = proximity_;
}

double Energy::triangle(int t, const Vector5& u, Vector5* gradient) const {
  double sum = 0;
  for (const EnergyTerm& term : terms_) {
    if (term.weight(t) == 0) continue;
    sum += term.theta.size() > 0 ? value_fit(term.reflection, u, term.theta(t), term.weight(t), gradient)
                                 : gradient_fit(term.reflection, u, term.gradient.row(t), term.weight(t), gradient);
  }
  return sum;
}

Matrix5 Energy::triangle_hessian(int t, const Vector5& u, HessianModel model) const {
  Matrix5 M = Matrix5::Zero();
  for (const EnergyTerm& term : terms_) {
    if (term.weight(t) != 0) M += term_hessian(term, t, u, model);
  }
  return model == HessianModel::kNewton ? project_semi_definite(M) : M;
}

double Energy::measure_mean_rise(const Eigen::RowVector3i& corners, const Vector& z) const {
  double sum = 0;
  for (const int v : corners) sum += z(v) - start_(v);
  return sum / 3.0;
}

// Evaluates the energy in one pass over the triangles' weights, by far the largest arrays: an evaluation is bound by
// memory.
double Energy::evaluate(const Vector& z, Vector* gradient) {
#pragma omp parallel for schedule(static) if (stencils_.triangle_count() > kWorthThreads)
  for (int t = 0; t < stencils_.triangle_count(); ++t) {
    Vector5 y = Vector5::Zero();
    triangle_energy_(t) = triangle(t, apply_stencil(stencils_, t, z), gradient ? &y : nullptr);
    if (gradient) multiply_stencil(stencils_, t, y, products_);
  }
  double energy = sum_in_chunks(triangle_energy_);
  if (gradient) sum_products(entries_, products_, *gradient);
  if (pull_.size() == 0) return energy;
  for (int v = 0; v < z.size(); ++v) energy += pull_(v) * (z(v) - start_(v)) * (z(v) - start_(v));
  if (gradient) gradient->array() += 2 * pull_.array() * (z - start_).array();
  return energy;
}

const Energy::ElementHessians& Energy::element_hessians(const Vector& z, HessianModel model) {
  elements_.resize(stencils_.triangle_count(), 15);
#pragma omp parallel for schedule(static) if (stencils_.triangle_count() > kWorthThreads)
  for (int t = 0; t < stencils_.triangle_count(); ++t) {
    const Matrix5 M = triangle_hessian(t, apply_stencil(stencils_, t, z), model);
    int k = 0;
    for (int i = 0; i < 5; ++i) {
      for (int j = i; j < 5; ++j) elements_(t, k++) = M(i, j);
    }
  }
  return elements_;
}

}  // namespace reflines
