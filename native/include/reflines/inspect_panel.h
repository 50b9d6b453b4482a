// Inspects a panel as somebody does who walks around it: how even its lines are in many lights and from many views, and
// where its worst places are.
#pragma once

#include <memory>
#include <vector>

#include "reflines/progress.h"
#include "reflines/smooth_panel.h"
#include "reflines/types.h"

namespace reflines {

struct InspectOptions {
  double length = 0.0;       // size of the flaws, in units of V; 0: kAutomaticLength times the diagonal and flaw_size
  double flaw_size = 1.0;    // see length; above 0
  double noise_floor = 0.1;  // degrees: places that deviate by less are no spots
  int most_spots = 100;
  bool keep_maps = false;  // see PanelInspection::maps
  // #views x #lights, or nothing for all: the pairs of a view and a light that are looked at.
  Eigen::Array<bool, Eigen::Dynamic, Eigen::Dynamic> pairs;
  // These surfaces, #B x 3 each, or none, may hide the panel from a view, as its own triangles may.
  Positions blocker_vertices;
  Triangles blockers;
  std::shared_ptr<Progress> progress;  // or none
};

// A connected place whose lines deviate by more than the noise floor.
struct WorstSpot {
  Vector3 place;               // on the panel, where the lines deviate most
  double size = 0.0;           // diameter of a disk with the area where they deviate by half of that or more
  double degrees = 0.0;        // deviation there in the light and view that show it best
  double height = 0.0;         // of the flaw over the reference surface along its normal: negative of a dent
  int view = 0, light = 0;     // those that show it best
  int front_light = 0;         // the one that shows it best from the first view
  std::vector<int> triangles;  // those that deviate by half of that or more, ascending
};

// The deviation of lines is how far they are from the course that they would have without flaws: degrees of theta, root
// mean square over a disk of a third of the length.
struct PanelInspection {
  double length = 0.0;      // the one used
  Eigen::MatrixXd degrees;  // #views x #lights: deviation, root mean square over the area that is seen
  Vector seen;              // #views: fraction of the panel's area that is seen and not at a grazing angle
  Vector deviation;         // #F: of each triangle in the light and view in which that is most; 0 where nothing is seen
  IndexVector view, light;  // #F: those
  Vector height;            // #V: of the surface over the reference one along the first view; 0 where that is not known
  // #F x #views #lights, those of a view beside each other, or nothing: as `deviation`, of each light and view alone.
  Eigen::MatrixXf maps;
  double mean = 0.0;             // of `degrees`
  int worst_view = 0;            // with the largest mean of its lights
  int worst_light = 0;           // with the largest mean over its views
  std::vector<WorstSpot> spots;  // the worst first
};

// Inspects the panel V (#V x 3), F (#F x 3) from `views` (#views x 3, directions from the surface to the viewer, of
// which the first is that along which the panel is a height field) in light lines of the directions `lines` (#lights x
// 3). Nothing is solved, and nothing is moved: flaws are what two estimates of the reference surface agree on, see
// inspection/reference_surface.h. Triangles that are hidden from a view, turned away from it or seen at a grazing angle
// have no weight there. On clean panels, with character lines and fillets, no place deviates by 0.08 degrees. Throws
// InvalidInput, SolverFailure, Cancelled; keeps no reference to its arguments.
PanelInspection inspect_panel(const Positions& V, const Triangles& F, const Positions& views, const Positions& lines,
                              const InspectOptions& options = {});

// The views and lights of a walk around a panel.
struct WalkAround {
  Positions views;  // 5 x 3, unit: the view given, and from its left, its right, above and below
  Positions lines;  // 8 x 3, unit: the light given, and the same turned about the view by multiples of 22.5 degrees
};

// Turns a view by 25 degrees to each side, or by half of the angle between light and view where that is less, so that
// no light is parallel to a view. `up` is the direction that is up in the picture; the lines' own where it is none.
// Throws InvalidInput where light and view are parallel.
WalkAround walk_around(const Vector3& view_direction, const Vector3& line_direction, const Vector3& up);

}  // namespace reflines
