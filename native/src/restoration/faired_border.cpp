#include "restoration/faired_border.h"

#include <cmath>

#include "geometry/mesh.h"
#include "reflines/errors.h"
#include "restoration/controlled_surface.h"
#include "restoration/restoration.h"

namespace reflines {
namespace {

// Lengths from the region that the press takes in. Of 1, 2 and 3.5, with flaws that run across the borders of three
// hoods, 0.37 of ripples and 0.44 of noise are left in the region with each, and 0.63 of dents.
constexpr double kReach = 2.0;

// A region (its vertices and triangles first) joined with the triangles beside it.
struct JoinedMesh {
  Positions V;
  Triangles F;
};

std::vector<int> find_border_vertices(const Triangles& F, int vertex_count) {
  const Triangles neighbors = edge_neighbors(F);
  Mask on_border = Mask::Constant(vertex_count, false);
  for (int t = 0; t < F.rows(); ++t) {
    for (int i = 0; i < 3; ++i) {
      if (neighbors(t, i) >= 0) continue;
      on_border(F(t, (i + 1) % 3)) = on_border(F(t, (i + 2) % 3)) = true;
    }
  }
  std::vector<int> result;
  for (int v = 0; v < vertex_count; ++v) {
    if (on_border(v)) result.push_back(v);
  }
  return result;
}

// Finds the vertices (#S) that lie within `reach` of some of the points. The box sorts most of the others out.
Mask find_near(const Positions& vertices, const Positions& points, double reach) {
  const Eigen::RowVector3d low = points.colwise().minCoeff().array() - reach,
                           high = points.colwise().maxCoeff().array() + reach;
  Mask near = Mask::Constant(vertices.rows(), false);
  for (Eigen::Index v = 0; v < vertices.rows(); ++v) {
    const Eigen::RowVector3d p = vertices.row(v);
    if ((p.array() < low.array()).any() || (p.array() > high.array()).any()) continue;
    for (Eigen::Index k = 0; k < points.rows() && !near(v); ++k)
      near(v) = (points.row(k) - p).squaredNorm() < reach * reach;
  }
  return near;
}

// Joins the region with the triangles around it that have a vertex within `reach` of its border. Vertices beside it
// that are in none of them are left out, so that the mesh has no others.
JoinedMesh join_surroundings(const Positions& V, const Triangles& F, const Surroundings& around, double reach) {
  const auto own = static_cast<int>(V.rows());
  const Mask near = find_near(around.V, V(find_border_vertices(F, own), Eigen::all), reach);
  std::vector<int> number(near.size(), -1), beside;
  std::vector<Eigen::RowVector3i> taken;
  const auto is_near = [&](int v) { return v < own || near(v - own); };
  const auto renumber = [&](int v) {
    if (v < own) return v;
    int& result = number[v - own];
    if (result < 0) {
      result = own + static_cast<int>(beside.size());
      beside.push_back(v - own);
    }
    return result;
  };
  for (const auto& triangle : around.F.rowwise()) {
    if (!is_near(triangle(0)) && !is_near(triangle(1)) && !is_near(triangle(2))) continue;
    taken.emplace_back(renumber(triangle(0)), renumber(triangle(1)), renumber(triangle(2)));
  }
  JoinedMesh joined{V, F};
  joined.V.conservativeResize(own + static_cast<Eigen::Index>(beside.size()), Eigen::NoChange);
  joined.V.bottomRows(beside.size()) = around.V(beside, Eigen::all);
  joined.F.conservativeResize(F.rows() + static_cast<Eigen::Index>(taken.size()), Eigen::NoChange);
  for (size_t t = 0; t < taken.size(); ++t) joined.F.row(F.rows() + static_cast<Eigen::Index>(t)) = taken[t];
  return joined;
}

template <typename Values>
Values append(const Values& values, Eigen::Index count, typename Values::Scalar filling) {
  Values result = Values::Constant(values.size() + count, filling);
  result.head(values.size()) = values;
  return result;
}

// Returns the border with the vertices free that are to be faired.
std::vector<Border> free_border(const ShapeOptions& shape, const Mask& faired) {
  std::vector<Border> result = shape.border;
  if (result.empty()) result.assign(faired.size(), Border::kClamped);
  for (Eigen::Index v = 0; v < faired.size(); ++v) {
    if (faired(v)) result[v] = Border::kFree;
  }
  return result;
}

// Returns the options for the joined mesh: what the region holds stays, and the mesh ends clamped.
ShapeOptions join_shape(const ShapeOptions& shape, const Mask& region_free, const JoinedMesh& joined,
                        Eigen::Index region_triangles) {
  const Eigen::Index beside = joined.V.rows() - region_free.size();
  ShapeOptions result = shape;
  result.border.clear();
  result.around = {};
  result.held = append(Mask(!region_free), beside, false);
  if (shape.partner.size() > 0) result.partner = append(shape.partner, beside, -1);
  if (shape.face_of_triangle.size() > 0) {
    const int next = shape.face_of_triangle.maxCoeff() + 1;
    result.face_of_triangle = append(shape.face_of_triangle, joined.F.rows() - region_triangles, 0);
    for (Eigen::Index t = region_triangles; t < joined.F.rows(); ++t)
      result.face_of_triangle(t) = next + static_cast<int>(t - region_triangles);
  }
  return result;
}

SmoothPanelOptions join_options(const SmoothPanelOptions& options, const SmoothPanelReport& used, Eigen::Index beside,
                                const IndexVector& partner) {
  SmoothPanelOptions result = options;
  result.length = used.length;
  result.limit = used.limit;
  result.partner = partner;
  if (options.limit_share.exists()) {
    result.limit_share = {append(options.limit_share.lowest, beside, -1.0),
                          append(options.limit_share.highest, beside, 1.0)};
  }
  return result;
}

SmoothPanelResult press_held(const Positions& V, const Triangles& F, const Vector3& view,
                             const std::vector<Vector3>& families, const ShapeOptions& shape,
                             const SmoothPanelOptions& options) {
  MeshSurface surface(V, F, view, families, shape);
  SmoothPanelResult result = Restoration(surface, options).run();
  result.report.messages.insert(result.report.messages.begin(),
                                "There are no faces beside the region by which its border could be faired: it was "
                                "held.");
  return result;
}

}  // namespace

SmoothPanelResult press_faired_border(const Positions& V, const Triangles& F, const Vector3& view,
                                      const std::vector<Vector3>& families, const ShapeOptions& shape,
                                      const SmoothPanelOptions& options) {
  ShapeOptions own = shape;
  own.border = free_border(shape, options.fair_border);
  own.around = {};
  MeshSurface region(V, F, view, families, own);
  Restoration judge(region, options);
  const JoinedMesh joined = join_surroundings(V, F, shape.around, kReach * judge.report().length);
  if (joined.F.rows() == F.rows()) return press_held(V, F, view, families, shape, options);
  const ShapeOptions joined_shape = join_shape(own, region.optimizer().free(), joined, F.rows());
  MeshSurface surface(joined.V, joined.F, view, families, joined_shape);
  const Eigen::Index beside = joined.V.rows() - V.rows();
  const SmoothPanelOptions joined_options = join_options(options, judge.report(), beside, joined_shape.partner);
  Restoration press(surface, joined_options);
  Vector move = press.find_move();
  move.tail(beside).setZero();
  if (press.turns_faces(move)) {
    throw SolverFailure(
        "Faces at the border would have turned by more than 45 degrees, so nothing was changed; hold the border, or "
        "give a smaller limit.");
  }
  return judge.judge_move(move.head(V.rows()), press.report(), press.limited().head(V.rows()));
}

}  // namespace reflines
