#include "restoration/faired_border.h"

#include <string>

#include "geometry/mesh.h"
#include "reflines/errors.h"
#include "restoration/controlled_surface.h"
#include "restoration/held_border.h"
#include "restoration/joined_mesh.h"
#include "restoration/restoration.h"

namespace reflines {
namespace {

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

// Tells that the whole border was held, after the sentence that comes first; see SmoothPanelReport::messages.
void tell_held(SmoothPanelReport& report) {
  const bool has_first = !report.applied || report.limited > 0 || report.largest_control_move == 0;
  report.messages.insert(report.messages.begin() + has_first,
                         "There are no faces beside the region by which its border could be faired: it was held.");
}

void tell_partly_held(Eigen::Index count, SmoothPanelReport& report) {
  report.messages.push_back("At " + std::to_string(count) + (count == 1 ? " vertex" : " vertices") +
                            " of the border there are no faces beside the region by which it could be faired: it was "
                            "held there.");
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
  const Mask movable = region.optimizer().free();
  const Mask wanted = movable && options.fair_border && find_border_vertices(F, static_cast<int>(V.rows()));
  if (!wanted.any()) return press_held_border(V, F, view, families, shape, options);
  const JoinedMesh joined = join_surroundings(V, F, shape.around, kFairReach * judge.report().length);
  const ShapeOptions joined_shape = join_shape(own, movable, joined, F.rows());
  MeshSurface surface(joined.V, joined.F, view, families, joined_shape);
  const Mask held = wanted && !surface.optimizer().free().head(V.rows());
  if (held.count() == wanted.count()) {
    SmoothPanelResult result = press_held_border(V, F, view, families, shape, options);
    tell_held(result.report);
    return result;
  }
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
  SmoothPanelResult result = judge.judge_move(move.head(V.rows()), press.report(), press.limited().head(V.rows()),
                                              press.held_triangles().head(F.rows()));
  if (held.any()) tell_partly_held(held.count(), result.report);
  return result;
}

}  // namespace reflines
