// The plane of a region's mean normal, over which a surface that is seen obliquely is as large as it is.
#pragma once

#include "geometry/height_field.h"
#include "reflines/types.h"

namespace reflines {

// The linear map of a plane to the tangent plane of a surface above it, and the distance along the normal that a unit
// of height makes.
struct TangentMap {
  Eigen::Matrix2d stretch = Eigen::Matrix2d::Identity();
  double lift = 1.0;
};

// Maps a place p of the image plane to S p, S = (I + g g^T)^(1/2), and a height z to c (z - g.p), c = (1 + g^2)^(-1/2),
// for the mean slope g. A plane of that slope keeps its lengths, and a vertex that moves along the view its place. The
// mean slope is that of the border's curve alone, by Stokes' theorem, so that flaws do not turn it.
//
// In the image plane, flaws that are seen at an angle are narrower and steeper than they are. Of a dent in a dome seen
// at 60 degrees 0.84 stayed there; over this plane 0.07, as from above.
class MeanPlane {
 public:
  explicit MeanPlane(const HeightField& field);

  // Returns the field over this plane.
  HeightField project(HeightField field) const;

  // Returns heights over this plane of those along the view (#V), at places `xy` over this plane (#V x 2).
  Vector project_heights(const Vector& z, const PlanePositions& xy) const;

  // Returns the change of heights along the view that changes those over this plane by so much.
  Vector change_along_view(const Vector& change) const { return change / lift_; }

  const Vector2& slope() const { return slope_; }  // of the plane over the image plane
  Vector3 normal() const { return lift_ * Vector3(-slope_.x(), -slope_.y(), 1.0); }

  Vector change_over_plane(const Vector& along_view) const { return along_view * lift_; }  // the inverse

  // Returns the map to the tangent plane where the surface has this slope over this plane.
  TangentMap map_to_tangent(const Vector2& slope) const;

 private:
  Vector2 slope_;  // g
  Eigen::Matrix2d stretch_;
  double lift_;
};

// Returns the map to the tangent plane of a surface that has this slope over a plane, whose points move across that
// plane.
TangentMap find_tangent_map(const Vector2& slope);

// Returns the matrix that turns Hessians (f_xx, sqrt(2) f_xy, f_yy), as rows from the left, into those of f(A q).
Eigen::Matrix3d substitute(const Eigen::Matrix2d& A);

}  // namespace reflines
