#include "solver/border_curvature.h"

#include <algorithm>
#include <cmath>
#include <deque>

#include "geometry/crease.h"
#include "reflection/element.h"
#include "reflection/strong_features.h"
#include "solver/border_jets.h"

namespace reflines {
namespace {

constexpr double kRangeEdges = 6.0;     // mean edges that the pull reaches at least
constexpr double kRangeFraction = 0.1;  // of the region's diagonal that it reaches at least

// The factor of the range where third derivatives continue the second ones: with more the rate of the curvature across
// comes nearer, and a clean bonnet moves further.
constexpr double kFlowRange = 1.5;

double measure_mean_edge(const HeightField& field) {
  double sum = 0;
  for (int t = 0; t < field.triangle_count(); ++t) {
    for (int i = 0; i < 3; ++i) sum += (field.xy.row(field.F(t, i)) - field.xy.row(field.F(t, (i + 1) % 3))).norm();
  }
  return sum / (3.0 * field.triangle_count());
}

// The nearest border vertex of each triangle (#T of the field), -1 beyond the range, and its distance.
struct Nearest {
  std::vector<int> vertex;
  Vector distance;
};

Eigen::RowVector2d find_centre(const HeightField& field, int t) {
  return (field.xy.row(field.F(t, 0)) + field.xy.row(field.F(t, 1)) + field.xy.row(field.F(t, 2))) / 3;
}

// Hands the nearest border vertex on from triangle to triangle, which creases and strong bends stop: triangles without
// response (#F). `joined`: see find_joined.
Nearest find_nearest(const HeightField& field, const Triangles& joined, const Vector& response,
                     const std::map<int, BorderJet>& known, double range) {
  Nearest nearest{std::vector<int>(field.triangle_count(), -1), Vector::Constant(field.triangle_count(), range)};
  std::deque<int> open;
  const auto offer = [&](int t, int v) {
    const double distance = (find_centre(field, t) - field.xy.row(v)).norm();
    if (distance >= nearest.distance(t) || response(field.source[t]) <= 0) return;
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
      if (joined(t, i) >= 0) offer(joined(t, i), nearest.vertex[t]);
    }
  }
  return nearest;
}

// Returns the triangles across edges (#T x 3 of the field), which creases cut also where none are held.
Triangles find_joined(const Positions& V, const HeightField& field, const CreaseOptions& creases) {
  return crease_edges(V, field.F, field.neighbors, creases).select(-1, field.neighbors);
}

// Returns the response (#F) to the lines of all families.
Vector find_response(const std::vector<StartLines>& start) {
  Vector result = Vector::Ones(start.front().gradient.rows());
  for (const StartLines& lines : start) result = result.cwiseMin(measure_response(lines.gradient, lines.strong));
  return result;
}

// The pull of jets on the triangles around them.
struct Pull {
  const HeightField& field;
  const BorderJets& jets;
  Nearest nearest;
  Vector response;  // #F
  double edge, range;
};

Target make_target(const Pull& pull, const ReflectionFunction& lines, double strong, int family) {
  const HeightField& field = pull.field;
  const Eigen::Index count = pull.response.size();
  Target target{PlaneVectors::Zero(count, 2), Vector::Zero(count), {}, family};
  for (int t = 0; t < field.triangle_count(); ++t) {
    const int v = pull.nearest.vertex[t];
    if (v < 0) continue;
    const BorderJet& jet = pull.jets.of_vertex.at(v);
    const double distance = std::max(pull.nearest.distance(t), 0.5 * pull.edge);
    const double own = jet.flows ? kFlowRange * pull.range : pull.range;
    if (distance >= own) continue;
    const Vector5 u = jet.at((find_centre(field, t) - field.xy.row(v)).transpose());
    target.gradient.row(field.source[t]) = theta_gradient(lines.derivatives(u(0), u(1), 1), u);
    target.weight(field.source[t]) = std::pow(own / distance - 1, 2);
  }
  const Vector fits = pull.response.cwiseProduct(measure_response(target.gradient, strong));
  target.weight = target.weight.cwiseProduct(fits);
  return target;
}

// Counts the vertices with a jet beside which no triangle is pulled.
int count_strong(const Pull& pull, const std::vector<Target>& targets) {
  int count = 0;
  for (const auto& [v, jet] : pull.jets.of_vertex) {
    bool pulled = false;
    for (int e = pull.field.triangles_of_vertex.begin(v); e < pull.field.triangles_of_vertex.end(v); ++e) {
      const int t = pull.field.source[pull.field.triangles_of_vertex.items[e]];
      for (const Target& target : targets) pulled = pulled || target.weight(t) > 0;
    }
    count += !pulled;
  }
  return count;
}

}  // namespace

BorderCurvature continue_curvature(const Positions& V, const HeightField& field, const std::vector<Border>& border,
                                   const Surroundings& around, const ImagePlane& frame, const CreaseOptions& creases,
                                   const std::vector<StartLines>& start,
                                   const std::vector<ReflectionFunction>& families) {
  const double edge = measure_mean_edge(field), range = std::max(kRangeEdges * edge, kRangeFraction * field.diagonal());
  CreaseOptions found = creases;
  if (found.rule == CreaseRule::kNone) found.rule = CreaseRule::kAutomatic;
  const BorderJets jets = fit_border_jets(V, field, border, around, frame, found, kFlowRange * range);
  BorderCurvature result{{}, jets.unknown, 0, jets.constant};
  if (jets.of_vertex.empty()) return result;
  const bool flow =
      std::any_of(jets.of_vertex.begin(), jets.of_vertex.end(), [](const auto& entry) { return entry.second.flows; });
  const Vector response = find_response(start);
  const Triangles joined = find_joined(V, field, found);
  const Pull pull{
      field,    jets, find_nearest(field, joined, response, jets.of_vertex, flow ? kFlowRange * range : range),
      response, edge, range};
  result.targets.push_back(make_target(pull, families.front(), start.front().strong, 0));
  result.targets.push_back(
      make_target(pull, families.back(), start.back().strong, static_cast<int>(families.size()) - 1));
  result.strong = count_strong(pull, result.targets);
  const auto pulls = [](const Target& target) { return target.weight.maxCoeff() > 0; };
  if (std::none_of(result.targets.begin(), result.targets.end(), pulls)) result.targets.clear();
  return result;
}

}  // namespace reflines
