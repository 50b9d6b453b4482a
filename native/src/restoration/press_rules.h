// The rules of a press: every number that decides what is a flaw, what is design, and what is reported, with its unit.
//
// Numbers without a unit are fractions. "Lengths" are the length of flaws of SmoothPanelOptions, "diagonals" that of
// the panel's bounds. "Soft" is a threshold across which a decision goes from none to all, see soft_step.h. The trials
// behind the numbers stand in the page of trials beside the benchmark report.
#pragma once

namespace reflines {

// Rules of the smoothing by place: how far it goes; see adaptive_smoother.h.
struct ScaleRules {
  double presmoothed_edges = 2.5;  // longest edges: all is smoothed so far, lest noise of the vertices hide the surface
  double presmoothed_length = 1.0;      // lengths: that is no more than this
  double shortest = 0.42;               // lengths: smoothing before dents are looked for
  double ladder[3] = {0.84, 1.4, 2.1};  // lengths: smoothing by place after that
  double flaw_slope = 0.04;             // slope of a flaw: curvature that varies by more, over a wave, is design
  double across_one = 0.95;             // taken from that where curvature varies across one direction only: a line
  double tensor_radius = 0.35;          // smoothing lengths: of the structure tensor that tells such directions
  double typical = 3.0;                 // times the variation around a place that counts as flawed, too
  double around = 3.0;                  // lengths: of "around a place"
  double even = 0.46;                   // geometric over arithmetic mean of squares there, soft
  double nothing = 0.05;                // of a flaw's variation: what counts as none in the geometric mean
  double spread = 0.8;                  // variance across a line's direction over the disk's: a line or waves, soft
  double waves = 0.28;                  // of such waves that counts as flaws: more bends clean flutes
  double slope_weight = 0.5;            // lengths: weight of slopes beside heights where flaws are kept out
  double design_slope_weight = 7.0;     // lengths: likewise on design, whose thin triangles would turn far
};

// Rules of dents and bumps: what is taken for one; see bump_search.h and bump_removal.h.
struct BumpRules {
  double smallest_radius = 0.25;  // lengths: narrower ones are facets of the mesh
  double largest_radius = 0.63;   // lengths: wider ones are curves of a design
  double largest_on_piece = 0.1;  // diagonals of a piece, one of several: wider ones are its shape, soft
  double least_height = 8e-4;     // lengths: flatter ones are not seen, soft
  double steepest = 0.05;         // height over radius: steeper ones are scoops and knobs
  double explained = 0.43;        // of the surface's variance that the fit explains, soft
  double worth_refining = 0.29;   // likewise, before centre and radius are refined
  double gain_radius = 2.0;       // radii: around a bump that PressRules::gain is measured
  int rounds = 2;                 // of finding and removing
  // The fit of one candidate.
  double disk = 2.5;          // radii: of the surface that is looked at
  double rim = 0.7;           // radii: from where on samples tell of a direction
  double overlap = 1.5;       // radii: bumps closer than this are one
  int least_samples = 24;     // three numbers each against nine of the background
  int most_samples = 200;     // more only cost time
  double radius_step = 1.41;  // between the radii tried, which are refined to 10 %
  double seed_spacing = 0.6;  // radii
  int reweightings = 3;       // of the robust fit
  double outlier = 3.0;       // medians of the misfit
};

// Rules of symmetry: what differs between two halves is a flaw, or design; see mirror_images.h, mirror_evidence.h and
// designed_difference.h.
struct SymmetryRules {
  double pair_tolerance = 1e-4;    // diagonals that a vertex lies aside from its partner's image, or
  double pair_altitude = 0.3;      // of the least altitude of its triangles
  double exact = 3e-5;             // diagonals: where partners lie further aside, what they differ by is averaged
  double aside = 3.0;              // times how far aside they lie there: lower differences tell nothing
  double deepest = 3e-3;           // diagonals: a difference of height that may be a flaw
  double paired_in_all = 0.35;     // of all vertices: from there on a plane is one of symmetry, soft
  double paired = 0.68;            // of the vertices within a length: likewise there, soft
  double smooth = 2.0;             // lengths: over which differences are smooth, and so design:
  double explained = 0.81;         // of their squares that a quadratic explains, soft
  double design_height = 3e-4;     // diagonals: by smooth ones of that halves are hardly alike
  double roughness_radius = 0.56;  // lengths: over which roughness is compared
  double roughest = 2.0;           // root mean squares of the difference: roughness counts up to that, as of fillets
  double design_slope = 0.045;     // slope from which on a difference is design: that of a steep dent
  double averaged = 0.28;  // lengths: over which differences and their slopes are averaged, lest noise decide, and
                           // corrections rise from nothing beside those that are design
  double skirt = 0.05;     // of a difference's steep part: where the region of a designed difference ends
  double floor = 2.0;      // medians of the whole: likewise
  double held_difference = 1e-5;  // diagonals: lower ones are none; with more among what stays halves may move apart
};

// Rules of the border; see held_border.h and tangent_match.h.
struct BorderRules {
  double less_even = 0.05;     // degrees above the unevenness of a clamped press, which is then taken, if it is also
                               // `VerdictRules::worse` times that
  double most_added = 2.0;     // clamped moves: bound of what Curvature and Flow add
  int slope_rings = 2;         // of triangles on each side that tell a border's slope
  int slope_averages = 2;      // passes along the border, which take the noise out of slopes
  double turned_before = 2.0;  // lengths over which tangents are turned before a press, which finds nothing in that
  double turned_after = 1.0;   // likewise after it, lest a neighbour's flaws spread
};

// Rules of gaps; see joint_smoother.h.
struct JointRules {
  double across = 2.0;      // widest gaps within which the other side is looked for
  double kink_worse = 0.5;  // of the worst place before: with a place that got worse and is more, kinks are left
  int turns_after = 2;      // after a press: four only move the worst place
  double widened = 1.5;     // lengths: flaws of a panel that a gap cuts are as long as those of the whole
  double touching = 0.1;    // of the border's edges: parts of a region that are no further apart touch
  int most_parts = 32;      // of a region, each of which is pressed as a panel
};

// Rules of cages, which have few unknowns.
struct CageRules {
  double proximity = 1e4;  // see PressRules: each unknown lifts much surface and drifts less
};

// Rules of the verdict and of what is reported of a result; see healed_flaws.h and line_evenness.h.
struct VerdictRules {
  int retries = 3;             // each with the triangles held that turned too far before
  double worse = 1.01;         // times what it was at the start: not worse to the eye
  double even = 0.97;          // times its unevenness at the start: from here to `worse` on, places that get worse stay
  int rounds = 3;              // of finding such places for a set, each after those before stay
  double sooner = 0.3;         // of `raised` from one round to the next
  double raised = 0.3;         // rise of its mean square, over that before, with which a place stays: from all to none
  double even_radius = 0.5;    // lengths: of such a place
  double longer_waves = 0.32;  // degrees, root mean square: waves that are worth a word
  double place_radius = 0.35;  // lengths: a flaw is one place, the mesh's facets are none
  double seen = 0.4;           // degrees that lines deviate: flaws that are shown and reported, soft
  double healed = 0.52;        // of that which went, soft
  double saturating = 0.6;     // of the limit: moves from here on are less, and come to it without an edge
};

struct PressRules {
  ScaleRules scale;
  BumpRules bump;
  SymmetryRules symmetry;
  BorderRules border;
  JointRules joint;
  CageRules cage;
  VerdictRules verdict;
  double visible = 0.3;    // degrees that lines deviate, or tangents turn: less is not seen; see even_places.h,
                           // region_result.h and joint_press.h
  double gain = 0.19;      // of unevenness that goes with a bump, or with a cage's move: less is not worth it, soft;
                           // see bump_removal.h and restoration.h
  double proximity = 1e6;  // stiffness that holds a mesh to the smoothed heights, relative to that of the lines; see
                           // press_setup.h
};

inline constexpr PressRules kRules;

}  // namespace reflines
