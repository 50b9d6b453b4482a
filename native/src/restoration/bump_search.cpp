#include "restoration/bump_search.h"

#include <Eigen/Cholesky>
#include <algorithm>
#include <cmath>
#include <map>
#include <numbers>
#include <utility>

#include "reflection/weighted_median.h"
#include "restoration/grid_cell.h"

namespace reflines {
namespace {

constexpr double kExplained = 0.4;
constexpr double kWorthRefining = 0.7;                // of that, before centre and radius are refined
constexpr double kReach = 2.5;                        // radii: the disk whose surface is looked at
constexpr double kCore = 1.2;                         // radii: where a bump has most of its Hessian
constexpr double kOverlap = 1.5;                      // radii: bumps closer than this are one
constexpr int kLeastSamples = 24;                     // three numbers each against nine of the background
constexpr int kMostSamples = 400;                     // more only cost time
constexpr double kScaleStep = 1.41;                   // between the radii tried; the fit is refined to 10 % from there
constexpr double kSeedSpacing = 0.6;                  // radii
constexpr int kRounds = 5;                            // of reweighting
constexpr double kOutlier = 3.0;                      // medians of the misfit
constexpr double kInliers = 0.5, kCoreInliers = 0.7;  // of the area: else the disk is no good surface with a bump

using Rows3 = Eigen::Matrix<double, Eigen::Dynamic, 3>;

// The samples in square cells, for disks of one size.
class DiskIndex {
 public:
  DiskIndex(const HessianSamples& samples, double cell) : samples_(samples), cell_(cell) {
    for (int t = 0; t < samples.area.size(); ++t) cells_[key(samples.center.row(t))].push_back(t);
  }

  // Samples within `reach` of p, ascending by cell; at most about kMostSamples, evenly picked.
  std::vector<int> gather(const Vector2& p, double reach) const {
    std::vector<int> found;
    const auto [i, j] = key(p);
    for (int di = -1; di <= 1; ++di) {
      for (int dj = -1; dj <= 1; ++dj) {
        const auto cell = cells_.find({i + di, j + dj});
        if (cell == cells_.end()) continue;
        for (const int t : cell->second) {
          if ((samples_.center.row(t).transpose() - p).squaredNorm() < reach * reach) found.push_back(t);
        }
      }
    }
    const size_t stride = found.size() / kMostSamples + 1;
    if (stride > 1) {
      size_t kept = 0;
      for (size_t k = 0; k < found.size(); k += stride) found[kept++] = found[k];
      found.resize(kept);
    }
    return found;
  }

 private:
  std::pair<int, int> key(const Vector2& p) const { return find_grid_cell(p, cell_); }
  const HessianSamples& samples_;
  double cell_;
  std::map<std::pair<int, int>, std::vector<int>> cells_;
};

// The surface in one disk, in units of the radius.
struct Disk {
  Rows3 background, bump, surface;  // rows: 1, x, y; the bump's Hessian at height 1; the surface's
  Vector area, radius;
};

bool covers_all_directions(const Disk& disk) {
  bool octant[8] = {};
  for (int k = 0; k < disk.radius.size(); ++k) {
    if (disk.radius(k) < 0.7) continue;
    const double turn = std::atan2(disk.background(k, 2), disk.background(k, 1)) / (2 * std::numbers::pi) + 0.5;
    octant[std::min(7, static_cast<int>(8 * turn))] = true;
  }
  return std::all_of(octant, octant + 8, [](bool seen) { return seen; });
}

Disk read_disk(const HessianSamples& samples, const std::vector<int>& members, const Vector2& p, double radius) {
  const auto n = static_cast<Eigen::Index>(members.size());
  Disk disk{Rows3(n, 3), Rows3(n, 3), Rows3(n, 3), Vector(n), Vector(n)};
  for (Eigen::Index k = 0; k < n; ++k) {
    const Vector2 q = (samples.center.row(members[k]).transpose() - p) / radius;
    const double e = std::exp(-q.squaredNorm()) / (radius * radius);
    disk.background.row(k) << 1.0, q.x(), q.y();
    disk.bump.row(k) << (4 * q.x() * q.x() - 2) * e, std::numbers::sqrt2 * 4 * q.x() * q.y() * e,
        (4 * q.y() * q.y() - 2) * e;
    disk.surface.row(k) = samples.hessian.row(members[k]);
    disk.area(k) = samples.area(members[k]);
    disk.radius(k) = q.norm();
  }
  return disk;
}

// Fits background and bump by weighted least squares; `misfit` gets that of each sample.
Bump fit_bump(const Disk& disk, const Vector& weight, Vector& misfit) {
  const Eigen::Matrix3d normal = disk.background.transpose() * weight.asDiagonal() * disk.background;
  const Eigen::LDLT<Eigen::Matrix3d> solve(normal + 1e-12 * normal.trace() * Eigen::Matrix3d::Identity());
  const Rows3 bump =
      disk.bump - disk.background * solve.solve(disk.background.transpose() * weight.asDiagonal() * disk.bump);
  const Rows3 surface =
      disk.surface - disk.background * solve.solve(disk.background.transpose() * weight.asDiagonal() * disk.surface);
  const double own = weight.dot(bump.rowwise().squaredNorm());
  const double height = weight.dot(bump.cwiseProduct(surface).rowwise().sum()) / std::max(own, 1e-300);
  misfit = (surface - height * bump).rowwise().norm();
  const double all = weight.dot(surface.rowwise().squaredNorm());
  return {{}, 0.0, height, height * height * own / std::max(all, 1e-300)};
}

// Returns the plain fit, or the robust one where that explains more of a disk that is good surface for the most part: a
// feature that crosses the disk's rim then does not count.
Bump measure_bump(const Disk& disk) {
  Vector misfit, weight = disk.area;
  const Bump plain = fit_bump(disk, weight, misfit);
  Bump robust = plain;
  for (int round = 0; round < kRounds; ++round) {
    const double scale = kOutlier * weighted_median(misfit, disk.area) + 1e-300;
    weight = disk.area.array() / (1.0 + (misfit.array() / scale).square()).square();
    robust = fit_bump(disk, weight, misfit);
  }
  const Vector core = (disk.radius.array() < kCore).cast<double>();
  const bool good =
      weight.sum() >= kInliers * disk.area.sum() && weight.dot(core) >= kCoreInliers * disk.area.dot(core);
  return good && robust.explained > plain.explained ? robust : plain;
}

// Fits a bump at p; its `explained` is 0 where the disk cannot be judged.
Bump measure_at(const HessianSamples& samples, const DiskIndex& index, const Vector2& p, double radius) {
  const std::vector<int> members = index.gather(p, kReach * radius);
  Bump result{p, radius, 0.0, 0.0};
  if (static_cast<int>(members.size()) < kLeastSamples) return result;
  const Disk disk = read_disk(samples, members, p, radius);
  if (!covers_all_directions(disk)) return result;
  const Bump found = measure_bump(disk);
  result.height = found.height;
  result.explained = found.explained;
  return result;
}

// Searches the neighbouring centres and radii for the best, twice with a halved step.
Bump refine(const HessianSamples& samples, const DiskIndex& index, const BumpSearchOptions& options, Bump best) {
  for (const double step : {0.3, 0.15}) {
    const Bump from = best;
    for (int i = 0; i < 27; ++i) {
      const Vector2 p = from.center + step * from.radius * Vector2(i % 3 - 1, i / 3 % 3 - 1);
      const double radius = std::clamp(from.radius * std::pow(1.0 + step / 2, i / 9 - 1), options.smallest_radius,
                                       options.largest_radius);
      const Bump other = measure_at(samples, index, p, radius);
      if (other.explained > best.explained) best = other;
    }
  }
  return best;
}

// Keeps one seed a cell of a grid, the first of each.
PlanePositions thin(const PlanePositions& seeds, double spacing) {
  std::map<std::pair<int, int>, int> first;
  for (int s = 0; s < seeds.rows(); ++s) {
    first.try_emplace(find_grid_cell(seeds.row(s), spacing), s);
  }
  PlanePositions result(static_cast<Eigen::Index>(first.size()), 2);
  Eigen::Index row = 0;
  for (const auto& [cell, seed] : first) result.row(row++) = seeds.row(seed);
  return result;
}

bool is_flaw(const Bump& bump, const BumpSearchOptions& options) {
  const double height = std::abs(bump.height);
  return height >= options.least_height && height <= options.greatest_height &&
         bump.radius >= 0.999 * options.smallest_radius && bump.radius <= 1.001 * options.largest_radius;
}

bool is_apart(const Bump& bump, const std::vector<Bump>& others) {
  return std::none_of(others.begin(), others.end(), [&](const Bump& other) {
    return (bump.center - other.center).norm() < kOverlap * std::max(bump.radius, other.radius);
  });
}

}  // namespace

std::vector<Bump> find_bumps(const HessianSamples& samples, const PlanePositions& seeds,
                             const BumpSearchOptions& options, Progress* progress) {
  struct Candidate {
    Bump bump;
    size_t scale;
  };
  std::vector<DiskIndex> indexes;
  std::vector<Candidate> candidates;
  for (double radius = options.smallest_radius; radius < 1.01 * options.largest_radius; radius *= kScaleStep) {
    indexes.emplace_back(samples, 1.5 * kReach * radius);  // refined radii are up to 1.3 times larger
    const DiskIndex& index = indexes.back();
    const PlanePositions places = thin(seeds, kSeedSpacing * radius);
    std::vector<Bump> found(places.rows());
#pragma omp parallel for schedule(dynamic, 64)
    for (Eigen::Index k = 0; k < places.rows(); ++k) {
      if (progress && progress->cancelled()) continue;
      found[k] = measure_at(samples, index, places.row(k), radius);
    }
    if (progress) progress->enter(0.5, "looking for dents");
    for (const Bump& bump : found) {
      if (bump.explained > kWorthRefining * kExplained && is_flaw(bump, options))
        candidates.push_back({bump, indexes.size() - 1});
    }
  }
  std::stable_sort(candidates.begin(), candidates.end(),
                   [](const Candidate& a, const Candidate& b) { return a.bump.explained > b.bump.explained; });
  std::vector<Bump> result;
  for (const Candidate& candidate : candidates) {
    if (!is_apart(candidate.bump, result)) continue;
    const Bump best = refine(samples, indexes[candidate.scale], options, candidate.bump);
    if (best.explained >= kExplained && is_flaw(best, options) && is_apart(best, result)) result.push_back(best);
  }
  return result;
}

}  // namespace reflines
