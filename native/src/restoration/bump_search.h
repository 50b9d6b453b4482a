// Search for shallow round bumps and dents in a surface: a matched filter in the Hessian of the heights, over positions
// and sizes (blob detection in scale space, Lindeberg 1998), with a robust local background (IRLS regression).
#pragma once

#include <cmath>
#include <vector>

#include "reflines/progress.h"
#include "reflines/types.h"
#include "restoration/mean_plane.h"
#include "restoration/triangle_fields.h"

namespace reflines {

// height * exp(-|S (p - center)|^2 / radius^2) over a plane, which S maps to the surface's tangent plane at the centre:
// a dent that is as wide in all directions of the surface.
struct Bump {
  Vector2 center;
  double radius, height;
  double explained;  // fraction of the Hessian's variance around it that the bump explains, beyond a linear background
  double weight;     // 0 to 1: how surely it is a flaw
  TangentMap map = {};

  double depth() const { return map.lift * std::abs(height); }
  Vector2 offset(const Vector2& place) const { return map.stretch * (place - center); }
};

// The Hessians of the heights over a plane, a row a triangle.
struct HessianSamples {
  PlanePositions center;   // #T x 2
  Vector area;             // #T, > 0
  TriangleFields hessian;  // #T x 3: f_xx, sqrt(2) f_xy, f_yy
  PlaneVectors slope;      // #T x 2
  const MeanPlane& plane;
};

// Bumps around which the surface is good: within 2.5 radii a bump and a background that is linear in the Hessian
// explain it, by a soft fraction of its variance (BumpRules::explained) times the root of the fraction of samples that
// are no outliers. Ridges, fillets and scoops are no bumps: their Hessian goes on beyond the disk. Planted dents come
// to 0.4 to 0.9 where a disk of their size is free of strong features. Of a bump that is n times as steep as the rules
// say, n times that fraction has to be explained, for what a design has pressed into a panel is steep, and has a floor,
// a rim or a direction of its own; where it is not, the bump is design, and so is what overlaps it. `seeds` (#S x 2):
// where a bump may be centred; `length`: the size of flaws. Of bumps that overlap the best is taken. Where `removed`
// has bumps that an earlier search found, only disks that these overlap are looked at: the surface of the others is as
// it was. Deterministic; throws Cancelled.
std::vector<Bump> find_bumps(const HessianSamples& samples, const PlanePositions& seeds,
                             const std::vector<Bump>& removed, double length, Progress* progress);

}  // namespace reflines
