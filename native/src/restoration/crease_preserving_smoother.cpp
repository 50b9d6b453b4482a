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
  edges_ = list_edge_jumps(xy, F, edge_neighbors(F), area);
  edge_size_.resize(static_cast<Eigen::Index>(edges_.size()));
  for (size_t e = 0; e < edges_.size(); ++e)
    edge_size_(static_cast<Eigen::Index>(e)) = std::sqrt(edges_[e].length * edges_[e].distance);
  patches_ = gather_patches(edges_, xy, F, area);
  build_pattern(static_cast<int>(xy.rows()));
  system_ = std::make_unique<System>(*this, xy);
}

CreasePreservingSmoother::~CreasePreservingSmoother() = default;

void CreasePreservingSmoother::build_pattern(int vertex_count) {
  std::vector<Eigen::Triplet<double>> entries;
  const auto add = [&](int i, int j) { entries.emplace_back(std::max(i, j), std::min(i, j), 0.0); };
  for (int v = 0; v < vertex_count; ++v) add(v, v);
  for (int t = 0; t < F_.rows(); ++t) {
    for (int i = 0; i < 3; ++i) add(F_(t, i), F_(t, (i + 1) % 3));
  }
  for (const VertexPatch& patch : patches_) {
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
  for (const VertexPatch& patch : patches_) {
    std::vector<int>& entries_of_patch = patch_entries_.emplace_back();
    for (const int i : patch.vertex) {
      for (const int j : patch.vertex) {
        if (j <= i) entries_of_patch.push_back(entry_index(pattern_, i, j));
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
  for (size_t p = 0; p < patches_.size(); ++p) {
    const PatchWeights sum = std::sqrt(stiffness) * weigh_patch(patches_[p], edges_, trust);
    const int* entry = patch_entries_[p].data();
    for (Eigen::Index i = 0; i < sum.cols(); ++i) {
      for (Eigen::Index j = 0; j <= i; ++j) value[*entry++] += sum.col(i).dot(sum.col(j));
    }
  }
}

Vector CreasePreservingSmoother::measure_jumps(const TriangleFields& U) const {
  Vector result(static_cast<Eigen::Index>(edges_.size()));
#pragma omp parallel for schedule(static) if (result.size() > kWorthThreads)
  for (Eigen::Index e = 0; e < result.size(); ++e) {
    const EdgeJump& edge = edges_[e];
    double squared = 0;
    for (Eigen::Index k = 0; k < U.cols(); ++k) {
      double jump = 0;
      for (int i = 0; i < 4; ++i) jump += edge.weight[i] * U(edge.vertex[i], k);
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
