// The families of light lines of a region: how each is reflected to its eye, and how well that eye sees the region.
#pragma once

#include <vector>

#include "reflection/reflection_function.h"
#include "reflines/eyes.h"
#include "reflines/image_plane.h"
#include "reflines/types.h"

namespace reflines {

struct Families {
  std::vector<ReflectionFunction> lines;  // the last one crosses the first, along the view: see PieceProblem
  // #F of each but the last, 0 to 1: how well its eye sees the triangles; or none, where all are seen along the view.
  std::vector<Vector> sight;
};

// Returns the frame of heights along a view. Its y axis follows the eyes' frame_line, or the first of the line
// directions that is not parallel to the view: with eyes of their own they may be. Throws InvalidInput where there is
// no line direction, and, without eyes, where the first is parallel to the view.
ImagePlane choose_frame(const Vector3& view_direction, const std::vector<Vector3>& line_directions, const Eyes& eyes);

// Makes the families for a region V (#V x 3), F (#F x 3). Throws InvalidInput for eyes that do not fit, a family whose
// lines are parallel to its eye.
Families make_families(const Positions& V, const Triangles& F, const ImagePlane& frame,
                       const std::vector<Vector3>& line_directions, const Eyes& eyes);

// Returns whether there are eyes, and none sees the region.
bool see_nothing(const Families& families);

}  // namespace reflines
