#include "geometry/sight.h"

#include <Eigen/Geometry>

#include "base/smoothstep.h"
#include "geometry/view_visibility.h"

namespace reflines {
namespace {

// The cosine of the angle between normal and eye from which on a triangle is seen, and seen well.
constexpr double kGrazing = 0.2, kFacing = 0.35;

constexpr double kClearance = 1e-6;  // relative to the diagonal: what is no further in front of a place hides nothing

double find_diagonal(const Positions& V, const Triangles& F) {
  Eigen::AlignedBox3d box;
  for (const int v : F.reshaped()) box.extend(V.row(v).transpose());
  return box.diagonal().norm();
}

}  // namespace

Vector weigh_sight(const Positions& V, const Triangles& F, const std::vector<int>& triangles, const Vector3& eye) {
  const ViewVisibility visibility(V, F, eye);
  const double clearance = kClearance * find_diagonal(V, F);
  const int count = static_cast<int>(triangles.size());
  Vector weight(count);
#pragma omp parallel for schedule(dynamic, 256)
  for (int k = 0; k < count; ++k) {
    weight(k) = smoothstep(kGrazing, kFacing, visibility.facing(triangles[k]));
    if (weight(k) > 0 && visibility.is_hidden(triangles[k], clearance)) weight(k) = 0;
  }
  return weight;
}

}  // namespace reflines
