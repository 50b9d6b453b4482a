// Reads theta of a region's lines between its vertices.
#pragma once

#include <vector>

#include "geometry/triangle_locator.h"
#include "reflines/region_field.h"
#include "reflines/types.h"

namespace reflines {

// Returns theta at `point` of the triangle that contains it, relative to `reference` and within pi of it.
double evaluate_theta_near(const RegionField& field, const Location& at, const Vector2& point, double reference);

// Finds the triangles in which single lines can be read: those of height-field pieces that are no features.
class LineReader {
 public:
  explicit LineReader(const RegionField& field);  // keeps a reference to `field`

  // Returns where a point lies; triangle (of the region) -1 where no line can be read.
  Location locate(const Vector2& point) const;

 private:
  std::vector<int> number_;  // in the region of each triangle of smooth_
  Triangles smooth_;         // the locator's
  TriangleLocator locator_;
};

}  // namespace reflines
