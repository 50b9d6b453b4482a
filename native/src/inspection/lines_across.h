// Compares how reflection lines run on from one surface to another at one place.
#pragma once

#include <vector>

#include "geometry/sheet_fit.h"
#include "reflection/reflection_function.h"
#include "reflines/image_plane.h"

namespace reflines {

struct LineJump {
  double angle = 0;   // degrees by which lines turn; 0 where they are sparse
  double offset = 0;  // by which they jump, percent of their spacing
};

// Compares the lines of a light and of the one that crosses it.
class LinesAcross {
 public:
  // Takes directions as smooth_panel does; `spacing` are radians of theta from line to line, and where they are further
  // apart than `sparse` they count as sparse. Throws InvalidInput where the directions are parallel.
  LinesAcross(const Vector3& view_direction, const Vector3& line_direction, double spacing, double sparse);

  // Returns the larger jump of both lights; none where a surface is seen edge on. Both are fits over the same plane.
  LineJump compare(const SheetPoint& own, const SheetPoint& other) const;

 private:
  Vector2 gradient(const ReflectionFunction& light, const SheetPoint& point) const;

  ImagePlane frame_;
  std::vector<ReflectionFunction> lights_;
  double spacing_, sparse_;
};

}  // namespace reflines
