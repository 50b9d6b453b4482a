// Handles on lines that are followed while the mouse drags them: an approximation of the solve for their targets whose
// time hardly depends on the size of the mesh.
#pragma once

#include <memory>
#include <vector>

#include "reflines/line_handles.h"
#include "reflines/shape_optimizer.h"

namespace reflines {

// Moves the heights within the radii by smooth motions, bicubic splines with some ten knots a radius, which minimize
// the targets of LineHandles on a sample of the triangles. The changes asked for at the handles are raised until the
// lines pass through them, instead of weighing the values there: the motions bend no line at a point. What is kept from
// call to call is the factor of the window, so that a moved handle takes small back substitutions.
class HandleFollower {
 public:
  // Takes the optimizer of the region at the start, whose heights stay, and the handles' lines there, of the same
  // region; both outlive it. Throws InvalidInput where they are of another.
  HandleFollower(const ShapeOptimizer& start, const LineHandles& lines);
  ~HandleFollower();

  // Moves `optimizer`, another one of the same region, to where the lines meet the handles; with `keep_others` the
  // lines of the other families are kept as far as these allow. The result depends on the handles alone, up to the
  // solver's tolerance. Returns false, and changes nothing, where the ordinary solve is to be used: for cages, for few
  // vertices, for very different radii, and for handles on several pieces. Throws InvalidInput as LineHandles::build
  // does.
  bool follow(const std::vector<Handle>& handles, ShapeOptimizer& optimizer, bool keep_others = true);

 private:
  struct Window;
  bool prepare(const std::vector<Handle>& handles, const LineHandles::Places& places);

  const ShapeOptimizer& start_;
  const LineHandles& lines_;
  std::unique_ptr<Window> window_;  // of the last handles; null before
};

}  // namespace reflines
