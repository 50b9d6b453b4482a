#include "reflection/scalar_gradient.h"

namespace reflines {

Vector2 linear_gradient(const PlanePositions& xy, const Eigen::RowVector3i& corners, double db, double dc) {
  const Vector2 a = xy.row(corners(0));
  const Vector2 ab = xy.row(corners(1)).transpose() - a, ac = xy.row(corners(2)).transpose() - a;
  const double twice_area = ab.x() * ac.y() - ab.y() * ac.x();
  return Vector2(db * ac.y() - dc * ab.y(), dc * ab.x() - db * ac.x()) / twice_area;
}

}  // namespace reflines
