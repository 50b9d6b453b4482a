// The frame in which a surface is a height field: image plane x, y and height z along the view (paper, section 2.1).
#pragma once

#include "reflines/types.h"

namespace reflines {

// The orthonormal, right-handed axes x = a_perp, y = a_v (the projection of a into the image plane), z = v. The view
// direction points from the surface towards the viewer.
class ImagePlane {
 public:
  // Takes directions of any length. Throws InvalidInput where one is zero or not finite, or the two are parallel (to
  // 0.06 degrees).
  ImagePlane(const Vector3& view_direction, const Vector3& line_direction);

  const Vector3& x() const { return x_; }
  const Vector3& y() const { return y_; }
  const Vector3& z() const { return z_; }

  PlanePositions project(const Positions& V) const;  // xy, #V x 2
  Vector heights(const Positions& V) const;          // #V
  Vector3 to_frame(const Vector3& direction) const { return {direction.dot(x_), direction.dot(y_), direction.dot(z_)}; }

 private:
  Vector3 x_, y_, z_;
};

}  // namespace reflines
