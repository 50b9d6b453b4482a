// Measures the shut lines of a panel: gap and flush towards what lies beside it, and how lines run on across.
#pragma once

#include <vector>

#include "reflines/check_panel.h"
#include "reflines/types.h"

namespace reflines {

struct ShutLineOptions {
  double gap = 0.0;  // the widest that counts as a shut line, in units of V; 0: kAutomaticGap times the diagonal
  // Directions of the lines as smooth_panel takes them; both lights, crossed ones too, are measured. A view of zero
  // length: lines are not.
  Vector3 view_direction = Vector3::Zero(), line_direction = Vector3::Zero();
  double spacing = 0.1;  // of the lines: radians of theta from one to the next
  // Pass marks.
  double uneven = 5e-4;      // largest less smallest gap, units of V: half a millimetre where that is a metre
  double flush = 5e-4;       // largest step, up or down, likewise
  double kink = 0.3;         // degrees
  double line_angle = 5.0;   // degrees
  double line_offset = 2.0;  // percent of the spacing
};

// The triangles beside a panel that are not of its mesh.
struct BesidePanel {
  Positions V;        // #W x 3
  Triangles F;        // #G x 3
  IndexVector label;  // #G: of the object that each triangle is of; empty: all are 0
};

// The measures at the middle of each edge (#E). Both surfaces are fitted, each to its own vertices, and continued to
// the middle of the gap, so that what is one smooth surface that a gap cuts has neither step nor kink.
struct ShutMeasures {
  Vector gap;          // distance of the rims along the surface, units of V
  Vector flush;        // by how much the other side is higher, units of V
  Vector kink;         // angle between the normals, degrees
  Vector line_angle;   // by which lines turn, degrees: of both lights the larger; 0 where they are sparse
  Vector line_offset;  // by which lines jump, percent of their spacing
};

struct ShutLine {
  int label = 0;           // of what lies beside; -1: other faces of the panel's own mesh
  std::vector<int> edges;  // numbers in ShutLines::edges
  double length = 0;
  std::vector<CheckRow> rows;  // smallest gap, largest gap, uneven gap, lowest flush, highest flush, kink, line angle,
                               // line offset; the last two where lines are measured
};

struct ShutLines {
  double gap = 0;  // the widest that was looked for
  Edges edges;     // #E x 2, vertices: the edges of the border that lie at a gap
  ShutMeasures before, after;
  Mask passes;                 // #E: within the marks
  std::vector<Change> change;  // #E
  std::vector<ShutLine> list;  // in the order of their first edges
};

// Finds the shut lines of the region (#F) of the mesh F (#F x 3) with vertices `after` (#V x 3), and measures them
// there and with the vertices `before`. A shut line is a row of border edges without a corner that lie across a gap
// from one surface: one that faces the same way within 30 degrees, lies neither over nor under the region, begins
// within the widest gap, and is no higher or lower than that. It may be of `beside`, or of the same mesh: faces beside
// the region, or parts of it that are not joined, of which the first one counts. Edges beyond the end of the other rim
// belong to none. Throws InvalidInput as check_panel does.
ShutLines check_shut_lines(const Positions& before, const Positions& after, const Triangles& F, const Mask& region,
                           const BesidePanel& beside, const ShutLineOptions& options = {});

}  // namespace reflines
