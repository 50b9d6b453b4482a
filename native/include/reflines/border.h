// The condition at the border of a region.
#pragma once

namespace reflines {

// The condition at the border of a region; of a subdivision surface it is meant on the limit surface.
enum class Border : signed char {
  kFree = 0,     // border vertices move like any other
  kFixed = 1,    // positions stay
  kClamped = 2,  // positions and tangents stay: of a mesh, border vertices and those one edge away
  // The condition kClamped, with lines that run on from the surroundings: see ShapeOptions::around. Of a cage it is
  // kClamped, which keeps the curvature across it where the region ends inside a regular surface.
  kCurvature = 3,
  // The condition kCurvature, where the curvature also changes across the border at the rate of the surroundings (G3).
  // It is kCurvature at vertices whose surroundings do not tell that rate. The surroundings of a cage's surface are the
  // rest of that surface.
  kFlow = 4,
  // Positions stay, and tangents become those of the faces beside the region, which stay, too: of a press of Smooth,
  // see SmoothPanelOptions::around and GapContinuation. For other solves it is kFixed, of a cage kClamped.
  kFollow = 5,
};

// Returns whether tangents stay as they are at a border, too.
constexpr bool keeps_tangents(Border border) { return border >= Border::kClamped && border != Border::kFollow; }

// Returns whether lines run on over a border from the surroundings.
constexpr bool continues_lines(Border border) { return border == Border::kCurvature || border == Border::kFlow; }

}  // namespace reflines
