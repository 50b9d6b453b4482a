#include "inspection/rim_curve.h"

#include <algorithm>
#include <cmath>
#include <utility>

namespace reflines {
namespace {

constexpr double kCorner = 0.87;  // cosine of 30 degrees, by which a rim turns at most at a vertex that is no corner
constexpr int kSteps = 40;        // of the golden section, each of which leaves 0.62 of the interval
constexpr int kSeveral = -2;

void link(std::vector<int>& step, int from, int to) { step[from] = step[from] == -1 ? to : kSeveral; }

}  // namespace

RimPiece::RimPiece(const Vector3& first, const Vector3& second, const std::optional<Vector3>& before,
                   const std::optional<Vector3>& after) {
  const double length = std::max((second - first).norm(), 1e-300);
  const auto add = [&](const Vector3& point, double knot) {
    points_[count_] = point;
    knots_[count_++] = knot;
  };
  add(first, 0);
  add(second, 1);
  if (before) add(*before, -(first - *before).norm() / length);
  if (after) add(*after, 1 + (*after - second).norm() / length);
}

Vector3 RimPiece::at(double fraction) const {
  Vector3 result = Vector3::Zero();
  for (int i = 0; i < count_; ++i) {
    double weight = 1;
    for (int j = 0; j < count_; ++j) {
      if (j != i) weight *= (fraction - knots_[j]) / (knots_[i] - knots_[j]);
    }
    result += weight * points_[i];
  }
  return result;
}

double RimPiece::find_nearest(const Vector3& point) const {
  const double golden = 0.5 * (std::sqrt(5.0) - 1);
  const auto distance = [&](double fraction) { return (at(fraction) - point).squaredNorm(); };
  double low = 0, high = 1, left = 1 - golden, right = golden, at_left = distance(left), at_right = distance(right);
  for (int k = 0; k < kSteps; ++k) {
    if (at_left < at_right) {
      high = right;
      right = left;
      at_right = at_left;
      left = high - golden * (high - low);
      at_left = distance(left);
    } else {
      low = left;
      left = right;
      at_left = at_right;
      right = low + golden * (high - low);
      at_right = distance(right);
    }
  }
  return 0.5 * (low + high);
}

RimCurve::RimCurve(const Positions& V, const Triangles& F, const Triangles& neighbors, const std::vector<int>& chosen)
    : V_(V), next_(V.rows(), -1), last_(V.rows(), -1) {
  std::vector<Eigen::RowVector3i> edges;
  for (const int t : chosen) {
    for (int i = 0; i < 3; ++i) {
      if (neighbors(t, i) >= 0) continue;
      const int a = F(t, (i + 1) % 3), b = F(t, (i + 2) % 3);
      edges.emplace_back(a, b, b);
      triangles_.push_back(t);
      link(next_, a, b);
      link(last_, b, a);
    }
  }
  edges_.resize(static_cast<Eigen::Index>(edges.size()), 3);
  for (size_t k = 0; k < edges.size(); ++k) edges_.row(static_cast<Eigen::Index>(k)) = edges[k];
  tree_.emplace(V_, edges_);
}

// Returns the vertex that follows on `at`, where the rim has no corner there.
std::optional<Vector3> RimCurve::beyond(int from, int at, const std::vector<int>& step) const {
  const int next = step[at];
  if (next < 0) return std::nullopt;
  const Vector3 here = V_.row(at) - V_.row(from), there = V_.row(next) - V_.row(at);
  if (here.dot(there) < kCorner * here.norm() * there.norm() || there.norm() == 0) return std::nullopt;
  return V_.row(next).transpose();
}

RimPiece RimCurve::piece(int first, int second) const {
  return {V_.row(first), V_.row(second), beyond(second, first, last_), beyond(first, second, next_)};
}

std::optional<RimFoot> RimCurve::find(const Vector3& point, double within) const {
  const NearestPoint nearest = tree_->find(point, within);
  if (nearest.triangle < 0) return std::nullopt;
  const int first = edges_(nearest.triangle, 0), second = edges_(nearest.triangle, 1);
  std::vector<std::pair<int, int>> tried = {{first, second}};  // and those beside it: curves cross over a vertex
  if (last_[first] >= 0) tried.emplace_back(last_[first], first);
  if (next_[second] >= 0) tried.emplace_back(second, next_[second]);
  RimFoot best;
  for (const auto& [a, b] : tried) {
    const RimPiece own = piece(a, b);
    const double fraction = own.find_nearest(point), step = 1e-3;
    const Vector3 place = own.at(fraction);
    const double distance = (place - point).norm();
    if (distance >= best.distance) continue;
    best = {place, (own.at(fraction + step) - own.at(fraction - step)).normalized(), distance,
            triangles_[nearest.triangle]};
  }
  return best;
}

}  // namespace reflines
