// Tells which triangles of a surface are seen from a direction.
#pragma once

#include <utility>

#include "geometry/mesh.h"
#include "reflines/types.h"

namespace reflines {

// A set of triangles as it is seen from afar, in cells across the view.
class ViewVisibility {
 public:
  // Takes V (#V x 3) and F (#F x 3), the latter by reference; `view` is a unit direction from the surface to the
  // viewer.
  ViewVisibility(const Positions& V, const Triangles& F, const Vector3& view);

  // Returns true where another triangle, more than `clearance` in front of triangle t, hides its middle; its neighbours
  // do not.
  bool is_hidden(int t, double clearance) const;

  // Returns the cosine of the angle between the triangle's normal and the view.
  double facing(int t) const;

 private:
  void list_triangles();
  bool covers(int t, const Vector3& point) const;
  bool touches(int t, int other) const;
  std::pair<int, int> cell_of(const Vector2& point) const;

  const Triangles& F_;
  Positions seen_;  // #V x 3: place across the view, and height towards the viewer
  Vector2 low_ = Vector2::Zero();
  double cell_ = 1.0;
  int columns_ = 1, rows_ = 1;
  Incidence triangles_of_cell_;
};

}  // namespace reflines
