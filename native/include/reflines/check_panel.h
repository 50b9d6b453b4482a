// Measures a changed panel as somebody does who has to sign for it: gap, angle and curvature along its borders and
// creases, against pass marks, and its distance from the surface that it was.
#pragma once

#include <string>
#include <vector>

#include "reflines/crease_options.h"
#include "reflines/types.h"

namespace reflines {

enum class SeamKind : signed char {
  kBorder,  // an edge between a triangle of the region and one outside, or one of another sheet near it
  kCrease,  // a crease within the region
  kOpen,    // an edge of the region with nothing, or several triangles, on its other side, which cannot be judged
};

struct CheckOptions {
  CreaseOptions creases;  // which edges within the region are creases, of the surface before
  // The largest distance of another sheet from an edge where the region's own ends, as a fraction of the edge's length,
  // at which it counts as the neighbour.
  double neighbor_distance = 0.1;
  double gap = 2e-5;        // pass marks: in units of V, 0.02 mm where that is a metre;
  double angle = 0.1;       // degrees;
  double curvature = 5.0;   // percent;
  double deviation = -1.0;  // largest distance from the surface before, units of V; negative: none
};

// The differences of the two sides of each edge (#E). They are measured at its middle, between cubics fitted to the
// vertices of each side alone, and so vanish on smooth surfaces however coarse the mesh is.
struct SeamMeasures {
  Vector gap;        // units of V
  Vector angle;      // between the normals, degrees
  Vector curvature;  // of the normal curvatures across the edge, percent of the larger, or of their root mean square
                     // over all seams before where that is more
};

// Says how a value of a seam changed. It is worse where it no longer is within the mark or has grown by more than the
// mark, and better the other way round. A crease is there by design: any change beyond the mark is for the worse.
enum class Change : signed char { kBetter, kUnchanged, kWorse };

// One line of the table: the largest value before and after, its mark, and where it is after.
struct CheckRow {
  std::string name;
  std::string unit;  // "length" (that of V), "degrees", "percent"
  double before = 0, after = 0;
  double mark = -1;  // negative: none
  bool passes = true;
  Vector3 place = Vector3::Zero();     // of the largest value; of a line that is worse that of the largest growth
  Change change = Change::kUnchanged;  // worse where the largest value is, or more seams are worse than better
  int better = 0, worse = 0;           // seams that are
};

struct PanelCheck {
  Edges edges;                 // #E x 2, vertices
  std::vector<SeamKind> kind;  // #E
  SeamMeasures before, after;
  Mask passes;                 // #E: a border within the marks; a crease that changed by no more than they are
  std::vector<Change> change;  // #E: worse where any of its values is, else better where one is
  Vector deviation;            // #V: distance of each vertex of the region from the surface before; 0 for others
  double largest_deviation = 0, deviation_95 = 0;  // the second is not exceeded by 95 % of the region's vertices
  std::vector<CheckRow> rows;  // border: gap, angle, curvature; crease: angle, curvature; deviation, deviation 95 %

  bool all_pass() const;
};

// Compares the surfaces `before` and `after` (#V x 3 each) of triangles F (#F x 3), of which those of `region` (#F)
// were changed; the others are their neighbours, and the more of them there are (three rings), the better the other
// side's curvature is known. Throws InvalidInput: other sizes, no triangle in the region, coordinates that are not
// finite, edges of the region with more than two triangles, marks that are negative or not finite.
PanelCheck check_panel(const Positions& before, const Positions& after, const Triangles& F, const Mask& region,
                       const CheckOptions& options = {});

}  // namespace reflines
