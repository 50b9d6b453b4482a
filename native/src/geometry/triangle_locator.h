// Point location in a plane triangle mesh by a uniform grid of bins.
#pragma once

#include <vector>

#include "geometry/mesh.h"
#include "reflines/types.h"

namespace reflines {

struct Location {
  int triangle = -1;                      // -1: outside the mesh
  Vector3 barycentric = Vector3::Zero();  // of the triangle's corners
};

class TriangleLocator {
 public:
  // Takes xy (#V x 2) and F (#F x 3), counter-clockwise triangles, by reference. Builds in O(#F); a query takes O(1) on
  // sane meshes. Bins hold at most 64 #F entries on any mesh, and only triangles that extend into them.
  TriangleLocator(const PlanePositions& xy, const Triangles& F);

  // Returns the triangle of smallest index that contains `point`, its border included (to 1e-12 of barycentric
  // rounding).
  Location locate(const Vector2& point) const;

 private:
  Vector3 barycentric(int t, const Vector2& point) const;
  int bin(const Vector2& point) const;
  template <class Take>
  void for_each_row(int t, const Take& take) const;
  double count_entries() const;

  const PlanePositions& xy_;
  const Triangles& F_;
  Vector2 low_, extent_, cell_;
  int columns_ = 1, rows_ = 1;
  Incidence triangles_of_bin_;
};

}  // namespace reflines
