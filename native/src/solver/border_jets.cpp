#include "solver/border_jets.h"

#include <Eigen/Geometry>
#include <algorithm>
#include <cmath>
#include <limits>

#include "base/sort_unique.h"
#include "geometry/crease.h"

namespace reflines {
namespace {

constexpr int kRings = 3;     // of the surroundings that a fit takes in
constexpr int kAverages = 2;  // passes along the border, which take the noise out of the fits

// The ratio of the squares of the second derivatives to those of their standard error above which they are known, both
// averaged along the border in so many passes: neighbours' fits have points in common, so that noise alone often
// exceeds its own error.
constexpr double kEvidence = 8.0;
constexpr int kEvidencePasses = 8;

// The change of the second derivatives by the third ones' error, relative to themselves, that is small enough.
constexpr double kHarmless = 0.1;

// The region and its surroundings over the image plane, in the coordinates of the region's height field.
struct Beside {
  PlanePositions xy;  // of the region's vertices, then of the surroundings' own
  Vector z;
  int region_count = 0;  // triangles of the region, which are the first of F
  Triangles F;           // of the surroundings those that face the viewer
  Triangles neighbors;   // across edges
  EdgeMask crease;
  Incidence triangles_of_vertex;
};

// Returns the region's triangles, and those of the surroundings that face the viewer.
Triangles join_visible(const Positions& all, const Triangles& region, const Triangles& around, const Vector3& view) {
  Triangles joined(region.rows() + around.rows(), 3);
  joined.topRows(region.rows()) = region;
  Eigen::Index count = region.rows();
  for (int t = 0; t < around.rows(); ++t) {
    const Vector3 n = area_normal(all, around, t);
    if (n.dot(view) > kSilhouette * n.norm()) joined.row(count++) = around.row(t);
  }
  joined.conservativeResize(count, 3);
  return joined;
}

Beside place_surroundings(const Positions& V, const HeightField& field, const Surroundings& around,
                          const ImagePlane& frame, const CreaseOptions& creases) {
  Positions all(V.rows() + around.V.rows(), 3);
  all << V, around.V;
  Beside beside;
  beside.xy = frame.project(all);
  beside.z = frame.heights(all);
  const int known = field.F(0, 0);  // of no face a vertex may lie anywhere
  const Eigen::RowVector2d shift = field.xy.row(known) - beside.xy.row(known);
  beside.xy.rowwise() += shift;
  beside.z.array() += field.z(known) - beside.z(known);
  beside.region_count = field.triangle_count();
  beside.F = join_visible(all, field.F, around.F, frame.z());
  beside.neighbors = edge_neighbors(beside.F);
  beside.crease = crease_edges(all, beside.F, beside.neighbors, creases);
  beside.triangles_of_vertex = vertex_triangles(beside.F, static_cast<int>(all.rows()));
  return beside;
}

bool has_any(const Triangles& F, int t, const std::vector<int>& vertices) {
  return std::any_of(vertices.begin(), vertices.end(), [&](int v) { return (F.row(t).array() == v).any(); });
}

// Adds the triangles of the surroundings that touch one of the vertices and are joined with the reached ones by edges.
// Returns false where a crease lies between.
bool take_ring(const Beside& beside, const std::vector<int>& vertices, std::vector<int>& reached) {
  for (size_t k = 0; k < reached.size(); ++k) {
    for (int i = 0; i < 3; ++i) {
      const int t = beside.neighbors(reached[k], i);
      if (t < beside.region_count || !has_any(beside.F, t, vertices)) continue;
      if (beside.crease(reached[k], i)) return false;
      if (std::find(reached.begin(), reached.end(), t) == reached.end()) reached.push_back(t);
    }
  }
  return true;
}

// Returns the vertices of the surroundings within kRings rings of a vertex, itself among them; none where a crease lies
// between them, beside which too few would remain for a fit.
std::vector<int> gather_rings(const Beside& beside, int v) {
  std::vector<int> found = {v}, reached;
  const Incidence& around = beside.triangles_of_vertex;
  for (int e = around.begin(v); e < around.end(v) && around.items[e] < beside.region_count; ++e)
    reached.push_back(around.items[e]);
  for (int ring = 0; ring < kRings; ++ring) {
    if (!take_ring(beside, found, reached)) return {};
    for (const int t : reached) {
      if (t >= beside.region_count) found.insert(found.end(), {beside.F(t, 0), beside.F(t, 1), beside.F(t, 2)});
    }
    sort_unique(found);
  }
  return found;
}

HeightFit fit_beside(const Beside& beside, int v) {
  const std::vector<int> vertices = gather_rings(beside, v);
  if (vertices.size() < 2) return {};
  const PlanePositions points = beside.xy(vertices, Eigen::all).rowwise() - beside.xy.row(v);
  return fit_heights(points, beside.z(vertices));
}

// Returns whether a vertex touches the surroundings.
bool has_neighbor(const Beside& beside, int v) {
  const Incidence& around = beside.triangles_of_vertex;  // ascending
  return around.end(v) > around.begin(v) && around.items[around.end(v) - 1] >= beside.region_count;
}

using Jets = std::map<int, BorderJet>;

BorderJets fit_border(const Beside& beside, const HeightField& field, const std::vector<Border>& border) {
  BorderJets result;
  for (int v = 0; v < field.vertex_count(); ++v) {
    const bool used = field.role[v] != VertexRole::kUnused;
    if (!used || !continues_lines(border[v]) || !has_neighbor(beside, v)) continue;
    const HeightFit fit = fit_beside(beside, v);
    result.unknown += fit.degree == 0;
    if (fit.degree == 0) continue;
    const bool flows = border[v] == Border::kFlow && std::isfinite(fit.third_error);
    result.of_vertex[v] = {
        (Vector5() << fit.slope, fit.second).finished(), fit.third, fit.second_error, fit.third_error, 0, flows};
  }
  return result;
}

// Lists the vertices with a jet that an edge of the surroundings joins with v.
std::vector<int> list_beside(const Beside& beside, const Jets& jets, int v) {
  std::vector<int> near;
  for (int e = beside.triangles_of_vertex.begin(v); e < beside.triangles_of_vertex.end(v); ++e) {
    const int t = beside.triangles_of_vertex.items[e];
    for (int i = 0; i < 3 && t >= beside.region_count; ++i) near.push_back(beside.F(t, i));
  }
  sort_unique(near);
  near.erase(std::remove_if(near.begin(), near.end(), [&](int w) { return w == v || jets.count(w) == 0; }), near.end());
  return near;
}

double squared_norm(const Vector4& third) { return third.cwiseAbs2().dot(Vector4(1, 3, 3, 1)); }

double squared_norm(const Vector5& u) { return u.tail<3>().cwiseAbs2().dot(Vector3(1, 2, 1)); }

// Sets the ranges of the jets, by the second derivatives of the whole border, which may vanish at one place.
void set_ranges(Jets& jets) {
  double second = 0;
  for (const auto& [v, jet] : jets) second += squared_norm(jet.u) / static_cast<double>(jets.size());
  for (auto& [v, jet] : jets) {
    const double third = squared_norm(jet.third);
    jet.range = third > 0 ? std::sqrt(second / third) : std::numeric_limits<double>::infinity();
  }
}

// Tells whether third derivatives are known at a vertex, by those of its neighbours that have some, too: at one alone
// they may vanish, or seem to be exact. Estimates with the error e of a tensor T have the expected square T^2 + e^2:
// they are nearer to T than zeros are where e^2 is below half of their square.
bool knows_third(const Jets& jets, const std::vector<int>& near, int v, double range) {
  double error = 0, third = 0, second = 0;
  const auto add = [&](const BorderJet& jet) {
    error += jet.third_error * jet.third_error;
    third += squared_norm(jet.third);
    second += squared_norm(jet.u);
  };
  add(jets.at(v));
  for (const int other : near) {
    if (jets.at(other).flows) add(jets.at(other));
  }
  return 2 * error <= third || error * range * range <= kHarmless * kHarmless * second;
}

// Removes the jets whose second derivatives are not known; returns how many.
int remove_unknown(const Beside& beside, Jets& jets) {
  std::map<int, Vector2> squares;  // of error and derivatives
  for (const auto& [v, jet] : jets) squares[v] = {jet.second_error * jet.second_error, squared_norm(jet.u)};
  for (int pass = 0; pass < kEvidencePasses; ++pass) {
    std::map<int, Vector2> means = squares;
    for (auto& [v, mean] : means) {
      const std::vector<int> near = list_beside(beside, jets, v);
      for (const int other : near) mean += squares[other];
      mean /= 1.0 + static_cast<double>(near.size());
    }
    squares.swap(means);
  }
  int count = 0;
  for (const auto& [v, mean] : squares) {
    if (kEvidence * mean(0) > mean(1)) count += static_cast<int>(jets.erase(v));
  }
  return count;
}

void choose_flowing(const Beside& beside, double range, Jets& jets) {
  std::vector<int> unsure;
  for (const auto& [v, jet] : jets) {
    if (jet.flows && !knows_third(jets, list_beside(beside, jets, v), v, range)) unsure.push_back(v);
  }
  for (const int v : unsure) jets[v].flows = false;
}

// Averages the second and third derivatives of vertices that an edge of the surroundings joins. Third ones that are not
// known count as zeros, so that one vertex in many that seems to know them does not stand out.
Jets average_along(const Beside& beside, const Jets& own) {
  Jets result = own;
  for (auto& [v, jet] : result) {
    int count = 1;
    for (const int other : list_beside(beside, own, v)) {
      const BorderJet& near = own.at(other);
      jet.u.tail<3>() += near.u.tail<3>();
      ++count;
      if (near.flows) jet.third += near.third;
    }
    jet.u.tail<3>() /= count;
    jet.third /= count;
  }
  return result;
}

}  // namespace

Vector5 BorderJet::at(const Vector2& place) const {
  if (!flows) return u;
  // The place tends to the range from inside, and leaves the polynomial like the fifth power of the distance. Without
  // a range, a clean bonnet whose surroundings begin to bend down beside the region moves five times as far.
  const double far = place.squaredNorm() / (range * range), fraction = std::pow(1 + far * far, -0.25);
  const double x = fraction * place.x(), y = fraction * place.y();
  const Vector3 turned(third(0) * x + third(1) * y, third(1) * x + third(2) * y, third(2) * x + third(3) * y);
  const Vector3 middle = u.tail<3>() + 0.5 * turned;
  Vector5 result = u;
  result.head<2>() += Vector2(middle(0) * x + middle(1) * y, middle(1) * x + middle(2) * y);
  result.tail<3>() += turned;
  return result;
}

BorderJets fit_border_jets(const Positions& V, const HeightField& field, const std::vector<Border>& border,
                           const Surroundings& around, const ImagePlane& frame, const CreaseOptions& creases,
                           double range) {
  const Beside beside = place_surroundings(V, field, around, frame, creases);
  BorderJets result = fit_border(beside, field, border);
  result.unknown += remove_unknown(beside, result.of_vertex);
  choose_flowing(beside, range, result.of_vertex);
  for (const auto& [v, jet] : result.of_vertex) result.constant += border[v] == Border::kFlow && !jet.flows;
  for (int pass = 0; pass < kAverages; ++pass) result.of_vertex = average_along(beside, result.of_vertex);
  set_ranges(result.of_vertex);
  return result;
}

}  // namespace reflines
