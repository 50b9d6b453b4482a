#include "solver/border_curvature.h"

#include <algorithm>
#include <cmath>
#include <deque>

#include "reflection/element.h"
#include "solver/border_jets.h"

namespace reflines {
namespace {

constexpr double kReachEdges = 6.0;  // mean edges that the pull reaches at least
constexpr double kReachShare = 0.1;  // of the region's diagonal that it reaches at least

// The factor of the reach where third derivatives continue the second ones. With exact derivatives of a dent and
// ripples on 96 x 96 jittered cells, the rate of the curvature ends 3.7 and 2.0, 1.5 and 1.0, 1.1 and 1.0 beside that
// of the surroundings for 1, 1.5 and 2; with constant derivatives 4.2 and 2.3. With fitted ones and their range,
// 1, 1.25 and 1.5 move a clean bonnet by 8, 11 and 14 mm.
constexpr double kFlowReach = 1.5;

double measure_mean_edge(const HeightField& field) {
  double sum = 0;
  for (int t = 0; t < field.triangle_count(); ++t) {
    for (int i = 0; i < 3; ++i) sum += (field.xy.row(field.F(t, i)) - field.xy.row(field.F(t, (i + 1) % 3))).norm();
  }
  return sum / (3.0 * field.triangle_count());
}

// The nearest border vertex of each triangle (#T of the field), -1 beyond the reach, and its distance.
struct Nearest {
  std::vector<int> vertex;
  Vector distance;
};

Eigen::RowVector2d find_centre(const HeightField& field, int t) {
  return (field.xy.row(field.F(t, 0)) + field.xy.row(field.F(t, 1)) + field.xy.row(field.F(t, 2))) / 3;
}

// Hands the nearest border vertex on from triangle to triangle, which creases stop.
Nearest find_nearest(const HeightField& field, const std::map<int, BorderJet>& known, double reach) {
  Nearest nearest{std::vector<int>(field.triangle_count(), -1), Vector::Constant(field.triangle_count(), reach)};
  std::deque<int> open;
  const auto offer = [&](int t, int v) {
    const double distance = (find_centre(field, t) - field.xy.row(v)).norm();
    if (distance >= nearest.distance(t)) return;
    nearest.vertex[t] = v;
    nearest.distance(t) = distance;
    open.push_back(t);
  };
  for (const auto& [v, jet] : known) {
    for (int e = field.triangles_of_vertex.begin(v); e < field.triangles_of_vertex.end(v); ++e)
      offer(field.triangles_of_vertex.items[e], v);
  }
  while (!open.empty()) {
    const int t = open.front();
    open.pop_front();
    for (int i = 0; i < 3; ++i) {
      if (field.neighbors(t, i) >= 0) offer(field.neighbors(t, i), nearest.vertex[t]);
    }
  }
  return nearest;
}

}  // namespace

BorderCurvature continue_curvature(const Positions& V, const HeightField& field, const std::vector<Border>& border,
                                   const Surroundings& around, const ImagePlane& frame, const CreaseOptions& creases,
                                   int triangle_count, const std::vector<ReflectionFunction>& families) {
  const double edge = measure_mean_edge(field), reach = std::max(kReachEdges * edge, kReachShare * field.diagonal());
  const BorderJets jets = fit_border_jets(V, field, border, around, frame, creases, kFlowReach * reach);
  BorderCurvature result{{}, jets.unknown, jets.constant};
  if (jets.of_vertex.empty()) return result;
  const bool flow =
      std::any_of(jets.of_vertex.begin(), jets.of_vertex.end(), [](const auto& entry) { return entry.second.flows; });
  const Nearest nearest = find_nearest(field, jets.of_vertex, flow ? kFlowReach * reach : reach);
  for (const size_t k : {size_t{0}, families.size() - 1}) {
    Target target{PlaneVectors::Zero(triangle_count, 2), Vector::Zero(triangle_count), {}, static_cast<int>(k)};
    for (int t = 0; t < field.triangle_count(); ++t) {
      if (nearest.vertex[t] < 0) continue;
      const BorderJet& jet = jets.of_vertex.at(nearest.vertex[t]);
      const double distance = std::max(nearest.distance(t), 0.5 * edge), own = jet.flows ? kFlowReach * reach : reach;
      if (distance >= own) continue;
      const Vector5 u = jet.at((find_centre(field, t) - field.xy.row(nearest.vertex[t])).transpose());
      target.gradient.row(field.source[t]) = theta_gradient(families[k].derivatives(u(0), u(1), 1), u);
      target.weight(field.source[t]) = std::pow(own / distance - 1, 2);
    }
    result.targets.push_back(std::move(target));
  }
  return result;
}

}  // namespace reflines
