// One press of Smooth with all its automatic rules: flaws are healed, the design stays.
#pragma once

#include <memory>
#include <vector>

#include "reflines/cage_optimizer.h"
#include "reflines/light_set.h"
#include "reflines/move_limit.h"
#include "reflines/note.h"
#include "reflines/progress.h"
#include "reflines/report.h"
#include "reflines/shape_optimizer.h"
#include "reflines/types.h"

namespace reflines {

// Length of flaws relative to the diagonal: all that is finer than a given length goes, design too, and dents, which
// are wider, are looked for by themselves.
inline constexpr double kAutomaticLength = 1.0 / 14.0;

// Limit relative to the length: dents of 6 per mille of the length are taken out whole, and no design is moved by more
// than an artist may overlook.
inline constexpr double kAutomaticLimit = 1.0 / 20.0;

// Lengths from the region that a press with a faired border takes in.
inline constexpr double kFairMargin = 2.0;

enum class Lights {
  kCrossed,  // the light lines given, and the same turned by 90 degrees in the image plane
  kSingle,   // those given only
};

struct SmoothPanelOptions {
  std::vector<Border> border;    // #V, or empty: clamped everywhere
  Mask held;                     // #V, or empty: vertices that stay
  IndexVector partner;           // #V, or empty: mirror images, which move alike; see ShapeOptions. Of a cage not read
  Surroundings around;           // or none; see ShapeOptions
  IndexVector face_of_triangle;  // #F or empty; see ShapeOptions
  // #V or empty: border vertices that move as inner ones do, to where `around` tells that the border should run,
  // instead of being held. A border that is held keeps its flaws, and the lines beside it run into them. Where there
  // are no faces beside it that can be used it is held all the same, and the report says so. Not for cages.
  Mask fair_border;
  // The widest gap, in units of V, across which parts of the region that no edge joins are smoothed as one (see
  // JointSmoother); 0: a tenth of the border's edges, so parts that touch. Not for cages.
  double parts_gap = 0.0;
  // True: where the region faces another panel or part that moves with it, the flush, which is the step between both
  // rims, is made even first. Of a shut line without corners it becomes straight from one end to the other, and the
  // same all around one that is closed, as far as moves along the view, within the limit, can. Each side makes half.
  bool even_flush = false;
  Lights lights = Lights::kCrossed;
  // Or none: it takes the place of the light lines given and of `lights`. Which flaws are found does not depend on it.
  LightSet set;
  LightSet judges;         // or none: lights with eyes that take no part; see HealedFlaws::worse_for_judges
  double length = 0.0;     // size of the flaws, in units of V; 0: kAutomaticLength times the diagonal and flaw_size
  double flaw_size = 1.0;  // see length; above 0
  double strength = 1.0;   // fraction of the move that is made, 0 to 1
  double limit = 0.0;      // no vertex moves further along the view, in units of V; 0: kAutomaticLimit times the length
  // Fractions of the limit for each vertex (#V, of a cage its own): the lowest moves -1 to 0, the highest 0 to 1.
  // Empty: -1 and 1 everywhere.
  MoveLimit limit_range;
  bool symmetric = true;               // what one of two halves that are alike otherwise has is a flaw
  std::shared_ptr<Progress> progress;  // or none
};

// The place where lines got worse by most in one of the lights: by at least kWorsened, and off their course by kWorst
// or more.
struct WorsePlace {
  int light = -1;                    // or -1: there is none
  double before = 0.0, after = 0.0;  // degrees that lines deviate there in that light, see HealedFlaws
  Vector3 place = Vector3::Zero();   // on the surface at the start
};

// Degrees by which lines get worse, and are then off their course, before a press tells of it.
inline constexpr double kWorsened = 0.1, kWorst = 0.3;

// Tells what a press healed. The deviation of lines is how far they are from the course that they would have without
// flaws: degrees of theta, root mean square over a disk of a third of the length, in the light in which that is most.
struct HealedFlaws {
  double area = 0.0;  // fraction of the region's area where lines deviated visibly and most of that went
  double worst_before = 0.0, worst_after = 0.0;  // deviation of the worst place of the region
  double mean_before = 0.0, mean_after = 0.0;    // likewise, root mean square over the healed area
  WorsePlace worse;
  WorsePlace worse_for_judges;  // likewise, among SmoothPanelOptions::judges
};

// Counts the work of a press, whose time these are: that of its smoother and of its solves together.
struct PressWork {
  int factorizations = 0;
  int solves = 0;  // with a factor, of one column

  void operator+=(const PressWork& other) {
    factorizations += other.factorizations;
    solves += other.solves;
  }
};

struct SmoothPanelReport {
  Report solve;                       // of the last solve
  PressWork work;                     // of this press alone, and of all solves
  double length = 0.0, limit = 0.0;   // those used
  double largest_move = 0.0;          // of the surface along the view, in units of V
  double largest_control_move = 0.0;  // of the vertices: for a cage more than its surface moves
  int limited = 0;                    // vertices that the limit holds back
  int bumps = 0;                      // round dents and bumps that were taken away
  int mirrored = 0;                   // vertices that their mirror images tell of; 0: no part of the panel is symmetric
  int held_faces = 0;                 // faces that would have turned by more than 45 degrees and were held instead
  bool longer_waves = false;          // that may be flaws, too, were left; see Restoration::find_longer_waves
  std::vector<LineScore> score_before, score_after;         // one for each family of lights, at `length`
  std::vector<double> unevenness_before, unevenness_after;  // degrees, one for each family of lights
  std::vector<double> seen;  // likewise: fraction of the region's area that its eye sees; 1 along the view
  HealedFlaws healed;        // of a press that was not applied nothing: the worst place after it is that before
  Vector line_deviation;  // #F, or of a cage #faces: how far the field of the light given is from its smoothed self in
                          // the result, radians / length
  Vector verdict;  // #F or #faces: 1 where flaws were healed, -1 where the surface counts as design and was kept, 0
                   // where there was nothing to heal; between them by degree
  Region region;   // of the shape at the start
  double flush_before = 0.0, flush_after = 0.0;  // by which it is uneven at most, in units of V; of even_flush alone
  bool applied = true;                           // false: some light would have become worse, and nothing was moved
  std::vector<Note> notes;  // the most important first: why nothing was moved, or else what the limit holds back
};

struct SmoothPanelResult {
  Positions
      positions;  // #V x 3, of the cage where there is one; vertices that did not move carry the bits they came with
  SmoothPanelReport report;
};

// Takes flaws out of a panel V (#V x 3), F (#F x 3) seen along `view_direction` under `line_direction`:
//  1. round dents and bumps with good surface around them are flaws (restoration/bump_removal.h);
//  2. so is what one half has and the other has not, where they are alike otherwise (restoration/mirror_evidence.h);
//  3. the rest is smoothed up to a length that differs by place: none where curvature varies as a design's does
//     (restoration/adaptive_smoother.h); and the shape with the lines of that surface is solved for, within the limit.
// Each of these is a weight that varies with the surface, so that a small change of the input has a small effect. A
// result that turns triangles by more than 45 degrees is solved for again with these held. Unevenness is how far lines
// are from those of the same surface smoothed up to the lengths found for the start, degrees of theta, root mean square
// over what the light's eye sees of the region. Where it would rise in a light, the places of a mesh at which it does
// stay as they are (restoration/even_places.h); where it still rises by more than 1 %, nothing is applied. Throws
// InvalidInput, SolverFailure, Cancelled; keeps no reference to its arguments.
SmoothPanelResult smooth_panel(const Positions& V, const Triangles& F, const Vector3& view_direction,
                               const Vector3& line_direction, const SmoothPanelOptions& options = {});

// Takes flaws out of a subdivision surface with the cage V (#V x 3): they are looked for in the surface, and the cage's
// vertices move. `cage_options` say what is held; the options' border and held are not read. The limit holds for the
// cage's vertices and so for the surface, which lies in their convex hull.
SmoothPanelResult smooth_cage_panel(const Cage& cage, const Positions& V, const Vector3& view_direction,
                                    const Vector3& line_direction, const CageOptions& cage_options,
                                    const SmoothPanelOptions& options = {});

}  // namespace reflines
