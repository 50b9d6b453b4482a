#include "inspection/reference_surface.h"

#include <algorithm>
#include <cmath>

#include "inspection/local_surface.h"
#include "restoration/adaptive_smoother.h"
#include "restoration/triangle_slopes.h"

namespace reflines {
namespace {

// Times that what smoothing takes away is smoothed again and given back (Tukey's twicing).
constexpr int kRounds = 4;

// Radius of the polynomials' disks, relative to the length: with smaller ones a half of a wide dent is seen, with
// larger ones the outlines of clean panels with coarse meshes deviate.
constexpr double kDisk = 1.5;

// Times what smoothing takes away that a flaw counts at most: smoothing leaves a part of wide flaws.
constexpr double kAtMost = 1.6;

constexpr double kFitting = 0.45;  // of the work, for the bar of its progress

Vector smooth_by_place(const HeightField& field, double length, Progress* progress) {
  AdaptiveSmoother smoother(field, length);
  const Vector once = smoother.adapt(field.z, progress);
  Vector result = once;
  for (int round = 1; round < kRounds; ++round) {
    throw_if_cancelled(progress);
    result = once + (result - smoother.smooth(result));
  }
  return result;
}

// Returns the part of `fitted` that `smoothed` tells, too: numbers of the same sign.
double agree(double smoothed, double fitted) {
  if (smoothed * fitted <= 0) return 0.0;
  return std::copysign(std::min(kAtMost * std::abs(smoothed), std::abs(fitted)), fitted);
}

}  // namespace

ReferenceSurface find_reference_surface(const HeightField& field, double length, Progress* progress) {
  const Vector smoothed = field.z - smooth_by_place(field, length, progress);
  if (progress) progress->enter(kFitting, "fitting the surface around each place");
  const Vector fitted = field.z - fit_local_surface(field, kDisk * length, progress);
  ReferenceSurface result{find_slopes(field.xy, field.F, field.z), smoothed.binaryExpr(fitted, &agree)};
  const PlaneVectors one = find_slopes(field.xy, field.F, smoothed), other = find_slopes(field.xy, field.F, fitted);
  for (Eigen::Index t = 0; t < one.rows(); ++t) {
    const double fraction = one.row(t).dot(other.row(t)) / std::max(one.row(t).squaredNorm(), 1e-300);
    result.slopes.row(t) -= std::clamp(fraction, 0.0, kAtMost) * one.row(t);
  }
  return result;
}

}  // namespace reflines
