#include "restoration/bump_removal.h"

#include <algorithm>
#include <cmath>
#include <numbers>
#include <vector>

#include "geometry/centroids.h"
#include "restoration/press_rules.h"
#include "restoration/soft_step.h"
#include "restoration/triangle_slopes.h"

namespace reflines {
namespace {

double square(double x) { return x * x; }

Vector largest_radii(const HeightField& field) {
  const Vector diagonal = field.piece_diagonals();
  Vector result(field.triangle_count());
  for (int t = 0; t < result.size(); ++t) result(t) = kRules.bump.largest_on_piece * diagonal(field.piece[t]);
  return result;
}

PlanePositions free_vertices(const HeightField& field) {
  PlanePositions result(field.vertex_count(), 2);
  Eigen::Index count = 0;
  for (int v = 0; v < field.vertex_count(); ++v) {
    if (field.role[v] == VertexRole::kFree) result.row(count++) = field.xy.row(v);
  }
  return result.topRows(count);
}

Eigen::Index find_nearest(const PlanePositions& centers, const Vector2& place) {
  Eigen::Index nearest = 0;
  (centers.rowwise() - place.transpose()).rowwise().squaredNorm().minCoeff(&nearest);
  return nearest;
}

// Returns the Hessian of a bump at a place of its tangent plane, in the components of CurvatureVariation.
Eigen::RowVector3d differentiate(const Bump& bump, const Vector2& place) {
  const Vector2 p = place / bump.radius;
  const double factor = bump.height * std::exp(-p.squaredNorm()) / (bump.radius * bump.radius);
  return factor *
         Eigen::RowVector3d(4 * p.x() * p.x() - 2, std::numbers::sqrt2 * 4 * p.x() * p.y(), 4 * p.y() * p.y() - 2);
}

// The variation of curvature with and without bumps.
class BumpGain {
 public:
  BumpGain(const CurvatureVariation& variation, const PlanePositions& centers, const TriangleFields& hessian)
      : variation_(variation), centers_(centers), hessian_(hessian) {}

  // Returns the fraction of the variation around a bump that goes with it; below 0 where it grows.
  double of(const Bump& bump) const {
    double sum = 0, weights = 0;
    const Eigen::Matrix3d from_tangent = substitute(bump.map.stretch);
    const auto without = [&](int t) -> Eigen::RowVector3d {
      return hessian_.row(t) - differentiate(bump, bump.offset(centers_.row(t))) * from_tangent;
    };
    for (int t = 0; t < hessian_.rows(); ++t) {
      const double squared = bump.offset(centers_.row(t)).squaredNorm();
      if (squared >= square(kRules.bump.gain_radius * bump.radius)) continue;
      const double weight =
          variation_.field().area(t) * (1.0 - squared / square(kRules.bump.gain_radius * bump.radius));
      const double before = variation_.read_variation(t, [&](int k) { return hessian_.row(k); });
      sum += weight * std::log(std::max(variation_.read_variation(t, without), kLeast) / std::max(before, kLeast));
      weights += weight;
    }
    return 1.0 - std::exp(sum / std::max(weights, kLeast));
  }

 private:
  static constexpr double kLeast = 1e-300;
  const CurvatureVariation& variation_;
  const PlanePositions& centers_;
  const TriangleFields& hessian_;
};

// Returns how much of a bump is to go, 0 to 1: none where it is wide for the piece of the surface that it is on, of
// which it is a shape, nor where the surface around it is hardly smoother without it.
double weigh(const Bump& bump, double largest_radius, double gain) {
  return bump.weight * (1.0 - soft_step(largest_radius, bump.radius)) * soft_step(kRules.gain, gain);
}

Vector evaluate(const Bump& bump, const PlanePositions& xy) {
  const auto squared =
      ((xy.rowwise() - bump.center.transpose()) * bump.map.stretch.transpose()).rowwise().squaredNorm();
  return bump.height * (-squared.array() / (bump.radius * bump.radius)).exp();
}

}  // namespace

BumpRemoval remove_bumps(const CurvatureVariation& variation, const MeanPlane& plane, const Vector& z, double length,
                         const std::function<Vector(const Vector&)>& smooth, Progress* progress) {
  const HeightField& field = variation.field();
  const PlanePositions seeds = free_vertices(field), centers = find_centroids(field.xy, field.F);
  const PlaneVectors slope = find_slopes(field.xy, field.F, z);
  const Vector largest = largest_radii(field);
  BumpRemoval result{z, 0};
  std::vector<Bump> removed;
  for (int round = 0; round < kRules.bump.rounds && (round == 0 || !removed.empty()); ++round) {
    const HessianSamples samples{centers, field.area, variation.read_hessians(smooth(result.heights)), slope, plane};
    const std::vector<Bump> found = find_bumps(samples, seeds, removed, length, progress);
    removed.clear();
    const BumpGain gain(variation, centers, samples.hessian);
    for (const Bump& bump : found) {
      const double weight = weigh(bump, largest(find_nearest(centers, bump.center)), gain.of(bump));
      if (weight == 0) continue;
      removed.push_back(bump);
      result.heights -= weight * evaluate(bump, field.xy);
      result.count += weight > 0.5;
    }
  }
  return result;
}

}  // namespace reflines
