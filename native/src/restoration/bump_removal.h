// Takes round dents and bumps out of a height field.
#pragma once

#include <vector>

#include "geometry/height_field.h"
#include "geometry/stencil.h"
#include "reflines/progress.h"
#include "reflines/types.h"
#include "restoration/bump_search.h"
#include "restoration/crease_preserving_smoother.h"

namespace reflines {

class BumpRemoval {
 public:
  // Keeps copies of what it needs. Bumps are looked for up to the size of `length`.
  BumpRemoval(const HeightField& field, double length);

  // Takes bumps (see bump_search.h) out of the field's heights, raised by `move` (#V): out of all, then where these
  // were, since of dents that overlap the second is seen when the first is gone. They are looked for in the Hessians,
  // smoothed so far that the noise of the mesh does not hide them. Adds to the move, that of held vertices, too, and
  // returns the number of bumps. Adds to `sure` (#V) what the move gets by bumps that are no shape of the piece of the
  // surface that they are on, each by the share that it explains. `progress` may be null; throws Cancelled.
  int remove_all(Vector& move, Vector& sure, Progress* progress) const;

 private:
  TriangleFields read_hessians(const Vector& z, Progress* progress) const;
  void remove(const std::vector<Bump>& bumps, Vector& move, Vector& sure) const;
  bool is_wide(const Bump& bump) const;

  PlanePositions xy_, seeds_;  // #V x 2; the free vertices
  Vector z_;                   // #V
  double length_;
  Stencils stencils_;
  CreasePreservingSmoother smoother_;
  PlanePositions centers_;  // #T x 2
  Vector area_;             // #T
  Vector largest_radius_;   // #T: of a bump that is no shape of the piece that it is on
};

}  // namespace reflines
