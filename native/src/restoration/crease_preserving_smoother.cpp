#include "restoration/crease_preserving_smoother.h"

#include <algorithm>
#include <cmath>
#include <numbers>

#include "geometry/mesh.h"
#include "optimization/linear/dissection.h"
#include "optimization/linear/linear_solver.h"
#include "reflection/weighted_median.h"

namespace reflines {
namespace {

constexpr double kLeastTrust = 1e-6;
constexpr int kWarmRounds = 3;          // from weights of a field that is nearly the same
constexpr double kCornerWeight = 1e-4;  // see LineSmoother: undetermined corners of triangles that hang on one vertex

constexpr int kTriangleProducts = 6;  // of the lower triangle of a 3 x 3 matrix

// Gradients of the barycentric coordinates of a triangle, a row a corner.
Eigen::Matrix<double, 3, 2> barycentric_gradients(const PlanePositions& xy, const Triangles& F, int t) {
  const Vector2 a = xy.row(F(t, 0)), b = xy.row(F(t, 1)), c = xy.row(F(t, 2));
  const Vector2 opposite[3] = {c - b, a - c, b - a};
  const double doubled = opposite[0].x() * opposite[1].y() - opposite[0].y() * opposite[1].x();
  Eigen::Matrix<double, 3, 2> result;
  for (int i = 0; i < 3; ++i) result.row(i) << -opposite[i].y() / doubled, opposite[i].x() / doubled;
  return result;
}

int entry_index(const SparseMatrix& A, int i, int j) {
  const int row = std::max(i, j), column = std::min(i, j);
  const int* begin = A.innerIndexPtr() + A.outerIndexPtr()[column];
  const int* end = A.innerIndexPtr() + A.outerIndexPtr()[column + 1];
  return static_cast<int>(std::lower_bound(begin, end, row) - A.innerIndexPtr());
}

}  // namespace

// The linear system: its pattern is analyzed once, and its weights are factored for each solve.
class CreasePreservingSmoother::System {
 public:
  System(const CreasePreservingSmoother& owner, const PlanePositions& xy)
      : owner_(owner), solver_(LinearSolverKind::kCholmod) {
    solver_.analyze(owner.pattern_, dissection_order(owner.pattern_, xy));
  }
  // Factors anew where weights or stiffness are other ones than in the last call.
  TriangleFields solve(const Vector& trust, double stiffness, const TriangleFields& rhs) {
    if (trust_.size() != trust.size() || trust_ != trust || stiffness_ != stiffness) {
      trust_.resize(0);
      owner_.assemble(trust, stiffness, A_);
      solver_.factorize(A_);
      trust_ = trust;
      stiffness_ = stiffness;
    }
    TriangleFields U = rhs;
    for (Eigen::Index k = 0; k < rhs.cols(); ++k) {
      Vector x = rhs.col(k);
      solver_.solve(x);
      U.col(k) = x;
    }
    return U;
  }

 private:
  const CreasePreservingSmoother& owner_;
  LinearSolver solver_;
  SparseMatrix A_;
  Vector trust_;  // of the factor; empty before the first
  double stiffness_ = 0.0;
};

CreasePreservingSmoother::CreasePreservingSmoother(const PlanePositions& xy, const Triangles& F, const Vector& area,
                                                   double length, const SmootherOptions& options)
    : stiffness_(std::pow(length / (2 * std::numbers::pi), 4)), options_(options), F_(F), area_(area) {
  corner_ = Vector::Constant(xy.rows(), 1e-12 * area.mean());
  for (int t = 0; t < F.rows(); ++t) {
    for (int i = 0; i < 3; ++i) corner_(F(t, i)) += kCornerWeight * area(t) / 3.0;
  }
  add_edges(xy, F, area);
  edge_size_.resize(static_cast<Eigen::Index>(edges_.size()));
  for (size_t e = 0; e < edges_.size(); ++e)
    edge_size_(static_cast<Eigen::Index>(e)) = std::sqrt(edges_[e].length * edges_[e].distance);
  gather_patches(static_cast<int>(xy.rows()));
  build_pattern(static_cast<int>(xy.rows()));
  system_ = std::make_unique<System>(*this, xy);
}

CreasePreservingSmoother::~CreasePreservingSmoother() = default;

void CreasePreservingSmoother::add_edges(const PlanePositions& xy, const Triangles& F, const Vector& area) {
  const Triangles neighbors = edge_neighbors(F);
  for (int t = 0; t < F.rows(); ++t) {
    for (int i = 0; i < 3; ++i) {
      const int other = neighbors(t, i);
      if (other < t || area(t) <= 0 || area(other) <= 0) continue;
      const int a = F(t, (i + 1) % 3), b = F(t, (i + 2) % 3);
      const Vector2 along = (xy.row(b) - xy.row(a)).transpose();
      const double both = area(t) + area(other), length = along.norm();
      if (!(length > 0)) continue;
      Vector2 normal = Vector2(-along.y(), along.x()) / length;
      if (normal.dot((xy.row(F(t, i)) - xy.row(a)).transpose()) < 0) normal = -normal;  // towards t
      const Vector3 across(normal.x() * normal.x(), std::numbers::sqrt2 * normal.x() * normal.y(),
                           normal.y() * normal.y());
      Edge edge{{F(t, i), a, b, 0}, {}, across, length, 2.0 / 3.0 * both / length};
      const Eigen::Matrix<double, 3, 2> own = barycentric_gradients(xy, F, t),
                                        far = barycentric_gradients(xy, F, other);
      for (int k = 0; k < 3; ++k) edge.jump[k] = own.row((i + k) % 3).dot(normal);
      for (int k = 0; k < 3; ++k) {
        const double part = far.row(k).dot(normal);
        if (F(other, k) == a) {
          edge.jump[1] -= part;
        } else if (F(other, k) == b) {
          edge.jump[2] -= part;
        } else {
          edge.vertex[3] = F(other, k);
          edge.jump[3] = -part;
        }
      }
      edges_.push_back(edge);
    }
  }
}

// Gathers the edges at each vertex, and the vertices that their jumps couple.
void CreasePreservingSmoother::gather_patches(int vertex_count) {
  std::vector<std::vector<int>> edges(vertex_count);
  for (int e = 0; e < static_cast<int>(edges_.size()); ++e) {
    for (const int end : {edges_[e].vertex[1], edges_[e].vertex[2]}) edges[end].push_back(e);
  }
  Vector third = Vector::Zero(vertex_count);
  for (int t = 0; t < F_.rows(); ++t) {
    for (int i = 0; i < 3; ++i) third(F_(t, i)) += area_(t) / 3.0;
  }
  for (int v = 0; v < vertex_count; ++v) {
    if (edges[v].size() <= kMostEdges) {
      add_patch(edges[v], third(v));
    } else {
      for (const int e : edges[v]) add_patch({e}, third(v) / static_cast<double>(edges[v].size()));
    }
  }
}

void CreasePreservingSmoother::add_patch(const std::vector<int>& edges, double area) {
  if (edges.empty()) return;
  Patch patch{{}, {}, {}, area};
  for (const int e : edges) patch.vertex.insert(patch.vertex.end(), edges_[e].vertex, edges_[e].vertex + 4);
  std::sort(patch.vertex.begin(), patch.vertex.end());
  patch.vertex.erase(std::unique(patch.vertex.begin(), patch.vertex.end()), patch.vertex.end());
  for (const int e : edges) {
    PatchEdge own{e, {}};
    for (int i = 0; i < 4; ++i) {
      const auto place = std::lower_bound(patch.vertex.begin(), patch.vertex.end(), edges_[e].vertex[i]);
      own.place[i] = static_cast<int>(place - patch.vertex.begin());
    }
    patch.edges.push_back(own);
  }
  patches_.push_back(std::move(patch));
}

// Returns the weights of the patch's f_xx, sqrt(2) f_xy and f_yy, times its area, one column a vertex.
CreasePreservingSmoother::PatchWeights CreasePreservingSmoother::sum_jumps(const Patch& patch,
                                                                           const Vector& trust) const {
  PatchWeights result = PatchWeights::Zero(3, static_cast<Eigen::Index>(patch.vertex.size()));
  for (const PatchEdge& own : patch.edges) {
    const Edge& edge = edges_[own.edge];
    const Vector3 half = 0.5 * edge.length * std::sqrt(trust(own.edge)) * edge.across;
    for (int i = 0; i < 4; ++i) result.col(own.place[i]) += edge.jump[i] * half;
  }
  return result;
}

void CreasePreservingSmoother::build_pattern(int vertex_count) {
  std::vector<Eigen::Triplet<double>> entries;
  const auto add = [&](int i, int j) { entries.emplace_back(std::max(i, j), std::min(i, j), 0.0); };
  for (int v = 0; v < vertex_count; ++v) add(v, v);
  for (int t = 0; t < F_.rows(); ++t) {
    for (int i = 0; i < 3; ++i) add(F_(t, i), F_(t, (i + 1) % 3));
  }
  for (const Patch& patch : patches_) {
    for (const int i : patch.vertex) {
      for (const int j : patch.vertex) {
        if (j < i) add(i, j);
      }
    }
  }
  pattern_.resize(vertex_count, vertex_count);
  pattern_.setFromTriplets(entries.begin(), entries.end());
  for (int t = 0; t < F_.rows(); ++t) {
    for (int i = 0; i < 3; ++i) {
      for (int j = 0; j <= i; ++j) triangle_entries_.push_back(entry_index(pattern_, F_(t, i), F_(t, j)));
    }
  }
  for (Patch& patch : patches_) {
    for (const int i : patch.vertex) {
      for (const int j : patch.vertex) {
        if (j <= i) patch.entries.push_back(entry_index(pattern_, i, j));
      }
    }
  }
}

void CreasePreservingSmoother::assemble(const Vector& trust, double stiffness, SparseMatrix& A) const {
  A = pattern_;
  double* value = A.valuePtr();
  for (int v = 0; v < A.cols(); ++v) value[A.outerIndexPtr()[v]] += corner_(v);
  for (int t = 0; t < F_.rows(); ++t) {
    for (int k = 0; k < kTriangleProducts; ++k) value[triangle_entries_[kTriangleProducts * t + k]] += area_(t) / 9.0;
  }
  for (const Patch& patch : patches_) {
    const PatchWeights sum = std::sqrt(stiffness / patch.area) * sum_jumps(patch, trust);
    const int* entry = patch.entries.data();
    for (Eigen::Index i = 0; i < sum.cols(); ++i) {
      for (Eigen::Index j = 0; j <= i; ++j) value[*entry++] += sum.col(i).dot(sum.col(j));
    }
  }
}

Vector CreasePreservingSmoother::measure_jumps(const TriangleFields& U) const {
  Vector result(static_cast<Eigen::Index>(edges_.size()));
#pragma omp parallel for schedule(static) if (result.size() > kWorthThreads)
  for (Eigen::Index e = 0; e < result.size(); ++e) {
    const Edge& edge = edges_[e];
    double squared = 0;
    for (Eigen::Index k = 0; k < U.cols(); ++k) {
      double jump = 0;
      for (int i = 0; i < 4; ++i) jump += edge.jump[i] * U(edge.vertex[i], k);
      squared += jump * jump;
    }
    result(e) = std::sqrt(squared) / edge.distance;
  }
  return result;
}

TriangleFields CreasePreservingSmoother::right_hand_side(const TriangleFields& g) const {
  TriangleFields result = TriangleFields::Zero(corner_.size(), g.cols());
  for (int t = 0; t < F_.rows(); ++t) {
    for (int i = 0; i < 3; ++i) result.row(F_(t, i)) += area_(t) / 3.0 * g.row(t);
  }
  return result;
}

TriangleFields CreasePreservingSmoother::mean_over_triangles(const TriangleFields& U, const TriangleFields& g) const {
  TriangleFields result = g;
  for (int t = 0; t < F_.rows(); ++t) {
    if (area_(t) > 0) result.row(t) = (U.row(F_(t, 0)) + U.row(F_(t, 1)) + U.row(F_(t, 2))) / 3.0;
  }
  return result;
}

Vector CreasePreservingSmoother::find_creases(const TriangleFields& g, Progress* progress, const Vector& start) const {
  const TriangleFields rhs = right_hand_side(g);
  const bool warm = start.size() > 0;
  Vector trust = warm ? start : Vector::Ones(static_cast<Eigen::Index>(edges_.size()));
  const int rounds = warm ? kWarmRounds : options_.rounds;
  for (int round = 1; round < rounds; ++round) {
    if (progress) progress->enter(static_cast<double>(round) / rounds, "smoothing the lines");
    const Vector jump = measure_jumps(system_->solve(trust, stiffness_, rhs));
    const double scale = options_.crease_jump * weighted_median(jump, edge_size_) + 1e-300;
    trust = ((1.0 + (jump.array() / scale).square()).square().inverse() + kLeastTrust).matrix();
  }
  return trust;
}

TriangleFields CreasePreservingSmoother::smooth_with(const Vector& creases, const TriangleFields& g,
                                                     double stretch) const {
  return mean_over_triangles(system_->solve(creases, stiffness_ * std::pow(stretch, 4), right_hand_side(g)), g);
}

}  // namespace reflines
