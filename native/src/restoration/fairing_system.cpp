#include "restoration/fairing_system.h"

#include <algorithm>

#include "base/parallel_failure.h"
#include "optimization/linear/dissection.h"

namespace reflines {
namespace {

// Adds to the area of each vertex, relative to the mean, so that one whose triangles are tiny is determined.
constexpr double kLeastArea = 1e-9;

Vector measure_vertex_areas(const HeightField& field) {
  Vector result = Vector::Zero(field.vertex_count());
  for (int t = 0; t < field.triangle_count(); ++t) {
    for (int i = 0; i < 3; ++i) result(field.F(t, i)) += field.area(t) / 3.0;
  }
  result.array() += kLeastArea * result.mean();
  return result;
}

}  // namespace

// Holds what one thread adds up for a column: sums for each triangle and vertex, and which of them are not 0.
struct FairingSystem::Workspace {
  Workspace(int vertex_count, int triangle_count)
      : change(TriangleFields::Zero(triangle_count, 3)),
        seen_triangle(triangle_count, 0),
        sum(Vector::Zero(vertex_count)),
        seen_vertex(vertex_count, 0) {}

  void touch_triangle(int t) {
    if (!seen_triangle[t]) triangles.push_back(t);
    seen_triangle[t] = 1;
  }
  void touch_vertex(int v) {
    if (!seen_vertex[v]) vertices.push_back(v);
    seen_vertex[v] = 1;
  }
  void clear() {
    for (const int t : triangles) {
      change.row(t).setZero();
      seen_triangle[t] = 0;
    }
    for (const int v : vertices) {
      sum(v) = 0;
      seen_vertex[v] = 0;
    }
    triangles.clear();
    vertices.clear();
  }

  TriangleFields change;  // #T x 3: what multiplies the form of each triangle
  std::vector<char> seen_triangle;
  Vector sum;  // #V: entries of the column
  std::vector<char> seen_vertex;
  std::vector<int> triangles, vertices;
};

FairingSystem::FairingSystem(const CurvatureVariation& variation)
    : variation_(variation),
      column_(variation.field().vertex_count(), -1),
      area_(measure_vertex_areas(variation.field())) {
  for (int v = 0; v < variation.field().vertex_count(); ++v) {
    if (variation.field().role[v] != VertexRole::kFree) continue;
    column_[v] = static_cast<int>(vertex_.size());
    vertex_.push_back(v);
  }
}

// Adds the products of the weights of v in the forms, through the edges of the triangles that have v in their stencil,
// with the weights of all vertices: the column of D^T W D, D being the changes of the forms across edges.
void FairingSystem::add_vertex(int v, Workspace& space) const {
  const Stencils& stencils = variation_.stencils();
  const StencilEntries& entries = variation_.entries();
  for (int k = entries.entries_of_vertex.begin(v); k < entries.entries_of_vertex.end(v); ++k) {
    const int e = entries.entries_of_vertex.items[k], t = entries.triangle[e];
    const Eigen::RowVector3d form = stencils.hessian.row(e) * variation_.form(t);
    space.touch_triangle(t);
    for (int i = 0; i < 3; ++i) {
      const int other = variation_.field().neighbors(t, i);
      if (other < 0) continue;
      space.touch_triangle(other);
      space.change.row(t) += scaled_(t, i) * form;
      space.change.row(other) -= scaled_(t, i) * form;
    }
  }
  for (const int t : space.triangles) {
    const Vector3 change = variation_.form(t) * space.change.row(t).transpose();
    for (int e = stencils.offset[t]; e < stencils.offset[t + 1]; ++e) {
      const int other = stencils.vertex[e];
      if (column_[other] < column_[v]) continue;
      space.touch_vertex(other);
      space.sum(other) += stencils.hessian.row(e).dot(change);
    }
  }
}

void FairingSystem::add_slopes(int v, Workspace& space) const {
  const HeightField& field = variation_.field();
  const Incidence& around = field.triangles_of_vertex;
  for (int k = around.begin(v); k < around.end(v); ++k) {
    const int t = around.items[k];
    const auto* gradient = variation_.stencils().gradient.data() + 6 * static_cast<Eigen::Index>(t);
    const int own = field.F(t, 0) == v ? 0 : field.F(t, 1) == v ? 1 : 2;
    for (int i = 0; i < 3; ++i) {
      const int other = field.F(t, i);
      if (column_[other] < column_[v]) continue;
      space.touch_vertex(other);
      space.sum(other) +=
          slope_(t) * (gradient[2 * own] * gradient[2 * i] + gradient[2 * own + 1] * gradient[2 * i + 1]);
    }
  }
  space.sum(v) += area_(v);
}

void FairingSystem::build_pattern(const Progress* progress) {
  const HeightField& field = variation_.field();
  Workspace space(field.vertex_count(), field.triangle_count());
  std::vector<int> rows, offset = {0};
  for (const int v : vertex_) {
    add_vertex(v, space);
    add_slopes(v, space);
    const auto begin = static_cast<std::ptrdiff_t>(rows.size());
    for (const int other : space.vertices) rows.push_back(column_[other]);
    std::sort(rows.begin() + begin, rows.end());
    offset.push_back(static_cast<int>(rows.size()));
    space.clear();
  }
  const auto count = static_cast<Eigen::Index>(vertex_.size());
  const std::vector<double> zeros(rows.size(), 0.0);
  pattern_ = Eigen::Map<const SparseMatrix>(count, count, static_cast<Eigen::Index>(rows.size()), offset.data(),
                                            rows.data(), zeros.data());
  PlanePositions places(count, 2);
  for (Eigen::Index i = 0; i < count; ++i) places.row(i) = field.xy.row(vertex_[i]);
  solver_ = std::make_unique<LinearSolver>(LinearSolverKind::kCholmod);
  solver_->analyze(pattern_, dissection_order(pattern_, places, progress), progress);
}

void FairingSystem::fill_columns(SparseMatrix& A) const {
  const HeightField& field = variation_.field();
  const auto count = static_cast<Eigen::Index>(vertex_.size());
  ParallelFailure failure;
#pragma omp parallel if (count > kWorthThreads)
  {
    std::unique_ptr<Workspace> space;
    failure.run([&] { space = std::make_unique<Workspace>(field.vertex_count(), field.triangle_count()); });
#pragma omp for schedule(dynamic, 256)
    for (Eigen::Index i = 0; i < count; ++i) {
      failure.run([&] {
        if (!space) return;
        add_vertex(vertex_[i], *space);
        add_slopes(vertex_[i], *space);
        for (int k = A.outerIndexPtr()[i]; k < A.outerIndexPtr()[i + 1]; ++k)
          A.valuePtr()[k] = space->sum(vertex_[A.innerIndexPtr()[k]]);
        space->clear();
      });
    }
  }
  failure.rethrow();
}

void FairingSystem::factorize(const EdgeWeights& weight, const Vector& slope, const Progress* progress) {
  scaled_ = variation_.scale_by_shape(weight);
  slope_ = variation_.field().area.cwiseProduct(slope);
  if (vertex_.empty()) return;
  if (!solver_) build_pattern(progress);
  SparseMatrix A = pattern_;
  fill_columns(A);
  solver_->factorize(A, progress);
  ++work_.factorizations;
}

Vector FairingSystem::smooth(const Vector& z) {
  Vector result = z;
  if (vertex_.empty()) return result;
  const Vector gradient = variation_.differentiate(z, scaled_);
  Vector move(static_cast<Eigen::Index>(vertex_.size()));
  for (Eigen::Index i = 0; i < move.size(); ++i) move(i) = -gradient(vertex_[i]);
  solver_->solve(move);
  ++work_.solves;
  for (Eigen::Index i = 0; i < move.size(); ++i) result(vertex_[i]) += move(i);
  return result;
}

}  // namespace reflines
