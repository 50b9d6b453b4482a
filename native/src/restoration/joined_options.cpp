#include "restoration/joined_options.h"

#include <algorithm>

namespace reflines {
namespace {

template <typename Values>
Values append(const Values& values, Eigen::Index count, typename Values::Scalar filling) {
  Values result = Values::Constant(values.size() + count, filling);
  result.head(values.size()) = values;
  return result;
}

}  // namespace

ShapeOptions leave_surroundings(const ShapeOptions& shape) {
  ShapeOptions result = shape;
  for (Border& border : result.border) {
    if (continues_lines(border)) border = Border::kClamped;
  }
  result.around = {};
  return result;
}

ShapeOptions clamp_followed(ShapeOptions shape) {
  std::replace(shape.border.begin(), shape.border.end(), Border::kFollow, Border::kClamped);
  return shape;
}

ShapeOptions join_shape(const ShapeOptions& shape, const Mask& region_free, const JoinedMesh& joined,
                        Eigen::Index region_triangles, BesideRegion how) {
  const Eigen::Index beside = joined.V.rows() - region_free.size();
  ShapeOptions result = shape;
  result.border.clear();
  result.around = {};
  result.held = append(Mask(!region_free), beside, how == BesideRegion::kStays);
  if (shape.partner.size() > 0) result.partner = append(shape.partner, beside, -1);
  if (shape.face_of_triangle.size() > 0) {
    const int next = shape.face_of_triangle.maxCoeff() + 1;
    result.face_of_triangle = append(shape.face_of_triangle, joined.F.rows() - region_triangles, 0);
    for (Eigen::Index t = region_triangles; t < joined.F.rows(); ++t)
      result.face_of_triangle(t) = next + static_cast<int>(t - region_triangles);
  }
  return result;
}

SmoothPanelOptions join_options(const SmoothPanelOptions& options, double length, const IndexVector& partner) {
  SmoothPanelOptions result = options;
  result.length = length;
  result.partner = partner;
  return result;
}

PressAmount join_amount(const PressAmount& amount, double limit, Eigen::Index beside) {
  PressAmount result = amount;
  result.limit = limit;
  if (amount.limit_range.exists()) {
    result.limit_range = {append(amount.limit_range.lowest, beside, -1.0),
                          append(amount.limit_range.highest, beside, 1.0)};
  }
  return result;
}

PressAmount begin_after(const PressAmount& amount, const Vector& move) {
  PressAmount result = amount;
  result.strength = 1;
  if (move.isZero(0)) return result;
  const Vector fraction = move / amount.limit;
  if (!result.limit_range.exists()) result.limit_range = MoveLimit::within(1, static_cast<int>(move.size()));
  result.limit_range.lowest = (result.limit_range.lowest - fraction).cwiseMax(-1).cwiseMin(0);
  result.limit_range.highest = (result.limit_range.highest - fraction).cwiseMin(1).cwiseMax(0);
  return result;
}

}  // namespace reflines
