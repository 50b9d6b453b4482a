// The press of Smooth for several panels that face each other over gaps: lines are smoothed across as inside.
#pragma once

#include <memory>
#include <vector>

#include "reflines/cage_optimizer.h"
#include "reflines/gap_continuation.h"
#include "reflines/panel_smoother.h"
#include "reflines/smooth_panel.h"
#include "reflines/types.h"

namespace reflines {

// The cage of a panel that is a subdivision surface, whose vertices move instead of the surface's.
struct JointCage {
  Cage cage;
  Positions V;          // #C x 3
  CageOptions options;  // of the border, what has Border::kFollow follows other panels and is clamped elsewhere
};

// One panel of several, as smooth_panel takes it. Its border vertices with Border::kFollow follow the other panels, and
// what lies beside but is no panel, over gaps; see continue_over_gap. `options.around` are the faces joined with it,
// which tell where its border is open, and the lengths of `gap` are in units of V.
struct JointPanel {
  Positions V;  // #V x 3
  Triangles F;  // #F x 3
  Vector3 view_direction, line_direction;
  SmoothPanelOptions options;
  Positions V_beside;  // #W x 3: what stays
  Triangles F_beside;  // #G x 3
  GapOptions gap;
  // True: border vertices with Border::kFollow that `options.around` has triangles at follow these, as in smooth_panel,
  // instead of `V_beside`.
  bool around_is_followed = false;
  // Or null. With a cage V, F, `V_beside` and what `options` say of vertices are not read, and the result's positions
  // are the cage's.
  std::shared_ptr<const JointCage> cage = nullptr;
};

class JointPress;

// Presses panels as one problem:
//  1. flaws of each panel are found on the panel and the continuation of the others, all of which moves along its view,
//     so that a dent across a gap is one dent;
//  2. both sides of a gap move alike: by the mean of what each found for it, so that the gap keeps its width and step;
//  3. a kink along a gap that is left so is none of a dent: all is found again after each side was turned by half of
//     it, and by all of it towards what stays;
//  4. what the moves turned at the gap is turned back, half by each side.
// Flaws are as long as those of a panel of the size of all that face each other, within 1.5 times their length on each
// alone; moves saturate at the limit. All sides take each step before any takes the next, so the order of the panels
// does not matter. A cage takes of its surface's move what it can, and as much as makes its lines more even; the meshes
// across follow its rim then. Where a panel would have a worse place than before, or a light would become worse, kinks
// are left (without 3 and 4), and so they are where a place would become half as bad as the worst one before; where a
// panel would still be worse, all are pressed with a border that is clamped towards the others, and their reports say
// so. A panel that faces no other is pressed as smooth_panel does.
class JointSmoother {
 public:
  // Throws InvalidInput as smooth_panel does. Keeps no reference to its arguments.
  explicit JointSmoother(std::vector<JointPanel> panels);
  ~JointSmoother();

  // Presses all panels, each by an amount; the progress is that of the first. Throws InvalidInput, SolverFailure,
  // Cancelled.
  std::vector<SmoothPanelResult> press(const std::vector<PressAmount>& amounts);

 private:
  std::vector<JointPanel> panels_;
  std::shared_ptr<JointPress> press_;  // null before the first press, and after one that was cancelled
};

}  // namespace reflines
