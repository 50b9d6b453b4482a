#include "restoration/bump_removal.h"

#include <algorithm>
#include <cmath>
#include <numbers>
#include <vector>

#include "base/smoothstep.h"
#include "restoration/centroids.h"

namespace reflines {
namespace {

// Bounds relative to the length. A bump narrower than the smallest is no wider than the mesh's own facets; one wider
// than the largest is as long as the curves of a design. One flatter than the least is not seen.
constexpr double kSmallestRadius = 0.25, kLargestRadius = 0.63;
constexpr double kLeastHeight = 7e-4;

// Height over radius. A dent of 1.3 per mille of the diagonal, 5 % of it wide, is as steep, and of its lines four
// degrees are off. Of 0.024, 0.05 and 0.08, on analytic panels: of ripples beside a scoop of 0.6 % of the diagonal
// 0.24, 0.24 and 1.1 is left (1.2 with a bound of the height alone), and of dents of 1.8 per mille 0.9, 0.14 and 0.14.
// A scoop of 0.3 % and a row of knobs are as steep as such dents, and nothing tells them from these: clean ones are
// harmed by 0.5 and 0.8 degrees from 0.05 on.
constexpr double kSteepness = 0.05;

// The largest radius relative to the diagonal of the piece that a bump is on, one of several that were selected
// together. A bump of 0.18 diagonals was the bow of a lamp on the bonnet of a car, selected whole: without the pull to
// the start it went by 3 per mille of the car's diagonal. On a piece alone the length gives 0.045.
constexpr double kLargestShare = 0.09;
constexpr double kTooWide = 1.2;  // times that: from where on it is none at all

// Share of the variation of curvature around a bump, within so many radii, that has to go with it: from none of the
// bump to all.
constexpr double kLeastGain = 0.1, kWholeGain = 0.35, kAround = 2.0;

constexpr double kCounts = 0.5;  // least weight of a bump that is reported

constexpr int kRounds = 3;

double square(double x) { return x * x; }

Vector largest_radii(const HeightField& field) {
  const Vector diagonal = field.piece_diagonals();
  Vector result(field.triangle_count());
  for (int t = 0; t < result.size(); ++t) result(t) = kLargestShare * diagonal(field.piece[t]);
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

// Returns the Hessian of a bump at a place, in the components of CurvatureVariation.
Eigen::RowVector3d differentiate(const Bump& bump, const Vector2& place) {
  const Vector2 p = (place - bump.center) / bump.radius;
  const double factor = bump.height * std::exp(-p.squaredNorm()) / (bump.radius * bump.radius);
  return factor *
         Eigen::RowVector3d(4 * p.x() * p.x() - 2, std::numbers::sqrt2 * 4 * p.x() * p.y(), 4 * p.y() * p.y() - 2);
}

// The variation of curvature with and without bumps.
class BumpGain {
 public:
  BumpGain(const CurvatureVariation& variation, const PlanePositions& centers, const TriangleFields& hessian)
      : variation_(variation), centers_(centers), hessian_(hessian) {}

  // Returns the share of the variation around a bump that goes with it; below 0 where it grows.
  double of(const Bump& bump) const {
    double sum = 0, weights = 0;
    const auto without = [&](int t) -> Eigen::RowVector3d {
      return hessian_.row(t) - differentiate(bump, centers_.row(t));
    };
    for (int t = 0; t < hessian_.rows(); ++t) {
      const double squared = (centers_.row(t).transpose() - bump.center).squaredNorm();
      if (squared >= square(kAround * bump.radius)) continue;
      const double weight = variation_.field().area(t) * (1.0 - squared / square(kAround * bump.radius));
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
  return bump.weight * smoothstep(kTooWide, 1.0, bump.radius / largest_radius) *
         smoothstep(kLeastGain, kWholeGain, gain);
}

Vector evaluate(const Bump& bump, const PlanePositions& xy) {
  const auto squared = (xy.rowwise() - bump.center.transpose()).rowwise().squaredNorm();
  return bump.height * (-squared.array() / (bump.radius * bump.radius)).exp();
}

}  // namespace

BumpRemoval remove_bumps(const CurvatureVariation& variation, const Vector& z, double length,
                         const std::function<Vector(const Vector&)>& smooth, Progress* progress) {
  const HeightField& field = variation.field();
  const BumpSearchOptions options{kSmallestRadius * length, kLargestRadius * length, kLeastHeight * length, kSteepness};
  const PlanePositions seeds = free_vertices(field), centers = find_centroids(field.xy, field.F);
  const Vector largest = largest_radii(field);
  BumpRemoval result{z, 0};
  std::vector<Bump> removed;
  for (int round = 0; round < kRounds && (round == 0 || !removed.empty()); ++round) {
    const HessianSamples samples{centers, field.area, variation.read_hessians(smooth(result.heights))};
    const std::vector<Bump> found = find_bumps(samples, seeds, removed, options, progress);
    removed.clear();
    const BumpGain gain(variation, centers, samples.hessian);
    for (const Bump& bump : found) {
      const double weight = weigh(bump, largest(find_nearest(centers, bump.center)), gain.of(bump));
      if (weight == 0) continue;
      removed.push_back(bump);
      result.heights -= weight * evaluate(bump, field.xy);
      result.count += weight > kCounts;
    }
  }
  return result;
}

}  // namespace reflines
