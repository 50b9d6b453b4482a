// Measures the gap between the open border of a surface and what lies across, at one edge after the other.
#pragma once

#include <deque>
#include <optional>

#include "geometry/neighbor_sheets.h"
#include "geometry/open_border.h"
#include "inspection/lines_across.h"
#include "inspection/rim_curve.h"
#include "reflines/surroundings.h"

namespace reflines {

struct GapPlace {
  double gap = 0, flush = 0, kink = 0;  // see ShutMeasures
  LineJump lines;
  int sheet = -1;   // which of the sheets beside
  int source = -1;  // triangle of it
  double distance = 0;
};

class GapProbe {
 public:
  // Takes the surface V, F with the faces joined with it, and triangles that may lie beside it. `gap` is the widest.
  // `lines` may be null: they are not measured. Keeps references to the surface and the lines.
  GapProbe(const Positions& V, const Triangles& F, const Surroundings& around, const Positions& V_beside,
           const Triangles& F_beside, double gap, const LinesAcross* lines);

  const std::vector<BorderEdge>& edges() const { return border_.edges; }

  // Measures at the middle of an edge; nothing where none lies across. See check_shut_lines.
  std::optional<GapPlace> measure(const BorderEdge& edge) const;

 private:
  struct Stand;  // where it is measured
  std::optional<GapPlace> probe(const Stand& stand, int sheet) const;
  std::optional<GapPlace> compare(const Stand& stand, const RimFoot& foot) const;

  const Positions& V_;
  double gap_;
  const LinesAcross* lines_;
  OpenBorder border_;
  NeighborSheets own_, sheets_;
  std::optional<RimCurve> own_rim_;
  std::deque<RimCurve> rims_;  // of the sheets
};

}  // namespace reflines
