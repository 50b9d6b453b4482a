#include "restoration/joined_options.h"

namespace reflines {
namespace {

template <typename Values>
Values append(const Values& values, Eigen::Index count, typename Values::Scalar filling) {
  Values result = Values::Constant(values.size() + count, filling);
  result.head(values.size()) = values;
  return result;
}

}  // namespace

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
  if (amount.limit_share.exists()) {
    result.limit_share = {append(amount.limit_share.lowest, beside, -1.0),
                          append(amount.limit_share.highest, beside, 1.0)};
  }
  return result;
}

}  // namespace reflines
