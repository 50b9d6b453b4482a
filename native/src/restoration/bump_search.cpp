#include "restoration/bump_search.h"

#include <Eigen/Cholesky>
#include <Eigen/LU>
#include <algorithm>
#include <cmath>
#include <deque>
#include <map>
#include <numbers>
#include <utility>

#include "base/parallel_failure.h"
#include "reflection/weighted_median.h"
#include "restoration/grid_cell.h"
#include "restoration/press_rules.h"
#include "restoration/soft_step.h"

namespace reflines {
namespace {

constexpr int kSpare = 4;                            // times most_samples, in a cell of the index
constexpr double kSearching = 0.2, kRefining = 0.3;  // of a press, for the bar of its progress

// The samples in square cells, for disks of one size.
class DiskIndex {
 public:
  DiskIndex(const HessianSamples& samples, double cell) : samples_(samples), cell_(cell) {
    const int stride = choose_stride(samples, cell);
    for (int t = 0; t < samples.area.size(); t += stride)
      cells_[find_grid_cell(samples.center.row(t), cell)].push_back(t);
  }

  // Samples within `radius` of p, ascending by cell; at most about kRules.bump.most_samples, picked at random.
  std::vector<int> gather(const Vector2& p, double radius) const {
    std::vector<int> found;
    for_each_near(cells_, find_grid_cell(p, cell_), 1, [&](int t) {
      if ((samples_.center.row(t).transpose() - p).squaredNorm() < radius * radius) found.push_back(t);
    });
    thin_out(found, kRules.bump.most_samples);
    return found;
  }

 private:
  // Leaves a disk, which is smaller than a cell, several times the samples that are picked of it.
  static int choose_stride(const HessianSamples& samples, double cell) {
    const double in_cell = static_cast<double>(samples.area.size()) * cell * cell / samples.area.sum();
    return std::max(1, static_cast<int>(in_cell / (kSpare * kRules.bump.most_samples)));
  }

  const HessianSamples& samples_;
  double cell_;
  GridCells cells_;
};

// The surface in one disk around the centre, in radii. A column is a number of all samples, so that loops over them are
// vectorized: the search was 85 % of a press on 10,000 vertices with a small matrix product a sample.
struct Disk {
  using Columns3 = Eigen::Array<double, Eigen::Dynamic, 3>;

  explicit Disk(Eigen::Index count) : x(count), y(count), area(count), bump(count, 3), surface(count, 3) {}

  Eigen::ArrayXd x, y, area;
  Columns3 bump, surface;  // Hessians: the bump's at height 1; the surface's
};

struct Fit {
  double height, explained;
  Eigen::Matrix3d background;  // rows: the factors of 1, x and y; columns: components of the Hessian
};

// Returns true where samples far from the centre are in all eight half quadrants.
bool covers_all_directions(const Disk& disk) {
  bool octant[8] = {};
  for (Eigen::Index k = 0; k < disk.x.size(); ++k) {
    const double x = disk.x(k), y = disk.y(k);
    if (x * x + y * y >= kRules.bump.rim * kRules.bump.rim)
      octant[4 * (x < 0) + 2 * (y < 0) + (std::abs(x) < std::abs(y))] = true;
  }
  return std::all_of(octant, octant + 8, [](bool seen) { return seen; });
}

// Returns the weight of a sample, in radii from the centre: it falls to 0 at the rim, so that a fit does not jump where
// samples enter the disk.
double taper(double x, double y) {
  return std::max(1.0 - (x * x + y * y) / (kRules.bump.disk * kRules.bump.disk), 0.0);
}

// Returns the mean slope of the samples around p.
Vector2 read_slope(const HessianSamples& samples, const std::vector<int>& members, const Vector2& p, double radius) {
  Vector2 sum = Vector2::Zero();
  double weights = 0;
  for (const int t : members) {
    const Vector2 offset = (samples.center.row(t).transpose() - p) / radius;
    const double weight = samples.area(t) * taper(offset.x(), offset.y());
    sum += weight * samples.slope.row(t).transpose();
    weights += weight;
  }
  return sum / std::max(weights, 1e-300);
}

// Reads the samples around the centre of a bump in its tangent plane.
Disk read_disk(const HessianSamples& samples, const std::vector<int>& members, const Bump& bump) {
  Disk disk(static_cast<Eigen::Index>(members.size()));
  const Eigen::Matrix3d to_tangent = substitute(bump.map.stretch.inverse());
  for (Eigen::Index k = 0; k < disk.x.size(); ++k) {
    const int t = members[k];
    const Vector2 offset = bump.offset(samples.center.row(t)) / bump.radius;
    disk.x(k) = offset.x();
    disk.y(k) = offset.y();
    disk.area(k) = samples.area(t) * taper(disk.x(k), disk.y(k));
    disk.surface.row(k) = samples.hessian.row(t) * to_tangent;
  }
  const Eigen::ArrayXd e = (-disk.x.square() - disk.y.square()).exp() / (bump.radius * bump.radius);
  disk.bump.col(0) = (4 * disk.x.square() - 2) * e;
  disk.bump.col(1) = (std::numbers::sqrt2 * 4) * disk.x * disk.y * e;
  disk.bump.col(2) = (4 * disk.y.square() - 2) * e;
  return disk;
}

// Sums over samples (#S), with weights, of a Hessian times 1, x and y (rows).
Eigen::Matrix3d moments(const Disk& disk, const Disk::Columns3& weighted) {
  Eigen::Matrix3d result;
  for (int c = 0; c < 3; ++c)
    result.col(c) << weighted.col(c).sum(), (weighted.col(c) * disk.x).sum(), (weighted.col(c) * disk.y).sum();
  return result;
}

Eigen::Matrix3d background_matrix(const Disk& disk, const Eigen::ArrayXd& weight) {
  const Eigen::ArrayXd wx = weight * disk.x, wy = weight * disk.y;
  const double x = wx.sum(), y = wy.sum(), xy = (wx * disk.y).sum();
  Eigen::Matrix3d result;
  result << weight.sum(), x, y, x, (wx * disk.x).sum(), xy, y, xy, (wy * disk.y).sum();
  return result + 1e-12 * result.trace() * Eigen::Matrix3d::Identity();
}

// Fits background and bump by weighted least squares, with the background eliminated: <b, s> without it is <b, s> -
// m(b) . N^-1 m(s), m being the moments and N the background's matrix.
Fit fit_bump(const Disk& disk, const Eigen::ArrayXd& weight) {
  const Eigen::LDLT<Eigen::Matrix3d> solve(background_matrix(disk, weight));
  const Disk::Columns3 weighted_bump = disk.bump.colwise() * weight, weighted_surface = disk.surface.colwise() * weight;
  const Eigen::Matrix3d of_bump = moments(disk, weighted_bump), of_surface = moments(disk, weighted_surface);
  const Eigen::Matrix3d below_bump = solve.solve(of_bump), below_surface = solve.solve(of_surface);
  const double own = (weighted_bump * disk.bump).sum() - of_bump.cwiseProduct(below_bump).sum();
  const double common = (weighted_bump * disk.surface).sum() - of_bump.cwiseProduct(below_surface).sum();
  const double all = (weighted_surface * disk.surface).sum() - of_surface.cwiseProduct(below_surface).sum();
  const double height = common / std::max(own, 1e-300);
  return {height, height * common / std::max(all, 1e-300), below_surface - height * below_bump};
}

// Returns the squared distance of each sample (#S) from the fit.
Eigen::ArrayXd squared_misfit(const Disk& disk, const Fit& fit) {
  Eigen::ArrayXd result = Eigen::ArrayXd::Zero(disk.x.size());
  for (int c = 0; c < 3; ++c) {
    const Eigen::Vector3d b = fit.background.col(c);
    result += (disk.surface.col(c) - fit.height * disk.bump.col(c) - b(0) - b(1) * disk.x - b(2) * disk.y).square();
  }
  return result;
}

// Returns the plain fit, or the robust one where that explains more, so that a feature which crosses the disk's rim
// does not count. It explains the less, the more of the disk it leaves out.
Fit measure_bump(const Disk& disk) {
  const Fit plain = fit_bump(disk, disk.area);
  Fit robust = plain;
  Eigen::ArrayXd weight;
  for (int round = 0; round < kRules.bump.reweightings; ++round) {
    const Eigen::ArrayXd misfit = squared_misfit(disk, robust);
    const double scale = kRules.bump.outlier * kRules.bump.outlier * weighted_median(misfit, disk.area) + 1e-300;
    weight = disk.area / (1.0 + misfit / scale).square();
    robust = fit_bump(disk, weight);
  }
  robust.explained *= std::sqrt(weight.sum() / disk.area.sum());
  return robust.explained > plain.explained ? robust : plain;
}

// Fits a bump at p; its `explained` is 0 where the disk cannot be judged.
Bump measure_at(const HessianSamples& samples, const DiskIndex& index, const Vector2& p, double radius) {
  const std::vector<int> members = index.gather(p, kRules.bump.disk * radius);
  Bump result{p, radius, 0.0, 0.0, 0.0};
  if (static_cast<int>(members.size()) < kRules.bump.least_samples) return result;
  result.map = samples.plane.map_to_tangent(read_slope(samples, members, p, radius));
  const Disk disk = read_disk(samples, members, result);
  if (!covers_all_directions(disk)) return result;
  const Fit found = measure_bump(disk);
  result.height = found.height;
  result.explained = found.explained;
  return result;
}

// Lists the neighbours whose values give a quadratic polynomial in three variables: a step along each, forth and back,
// and along each two.
std::vector<Vector3> list_probes() {
  std::vector<Vector3> result;
  for (int c = 0; c < 3; ++c) {
    result.emplace_back(Vector3::Unit(c));
    result.emplace_back(-Vector3::Unit(c));
  }
  for (int c = 0; c < 3; ++c) result.emplace_back(Vector3::Unit(c) + Vector3::Unit((c + 1) % 3));
  return result;
}

// Returns where the polynomial through the values in the middle and at its neighbours (see list_probes) is largest,
// within a unit cube; 0 where it has no top.
Vector3 find_top(const Bump& middle, const std::vector<Bump>& found) {
  Vector3 gradient;
  Eigen::Matrix3d hessian;
  const double f = middle.explained;
  for (int c = 0; c < 3; ++c) {
    const double above = found[2 * c].explained, below = found[2 * c + 1].explained;
    gradient(c) = (above - below) / 2.0;
    hessian(c, c) = above + below - 2.0 * f;
  }
  for (int c = 0; c < 3; ++c) {
    const int d = (c + 1) % 3;
    hessian(c, d) = hessian(d, c) = found[6 + c].explained - found[2 * c].explained - found[2 * d].explained + f;
  }
  const Eigen::LLT<Eigen::Matrix3d> solve(-hessian);
  if (solve.info() != Eigen::Success) return Vector3::Zero();
  return solve.solve(gradient).cwiseMax(-1.0).cwiseMin(1.0);
}

// Searches for the centre and radius that explain most, by Newton's method with finite differences whose step shrinks,
// so that what is found does not depend on where the search began.
Bump refine(const HessianSamples& samples, const DiskIndex& index, double length, Bump best) {
  static const std::vector<Vector3> kProbes = list_probes();
  std::vector<Bump> found(kProbes.size());
  for (double step = 0.3; step > 1e-3;) {
    const Bump middle = best;
    const Eigen::Matrix2d from_tangent = middle.map.stretch.inverse();
    const auto measure = [&](const Vector3& steps) {
      const Vector2 center = middle.center + step * middle.radius * (from_tangent * steps.head<2>());
      const double radius = std::clamp(middle.radius * std::pow(1.0 + step / 2, steps.z()),
                                       kRules.bump.smallest_radius * length, kRules.bump.largest_radius * length);
      return measure_at(samples, index, center, radius);
    };
    ParallelFailure failure;
#pragma omp parallel for schedule(dynamic)
    for (size_t i = 0; i < kProbes.size(); ++i) failure.run([&] { found[i] = measure(kProbes[i]); });
    failure.rethrow();
    found.push_back(measure(find_top(middle, found)));
    for (const Bump& bump : found) {
      if (bump.explained > best.explained) best = bump;
    }
    found.pop_back();
    const double moved = std::max(middle.offset(best.center).cwiseAbs().maxCoeff() / middle.radius,
                                  2.0 * std::abs(std::log(best.radius / middle.radius)));
    step = std::clamp(2.0 * moved, step / 3.0, std::min(2.0 * step, 0.3));
  }
  return best;
}

// Keeps one seed a cell of a grid, the first of each.
PlanePositions thin(const PlanePositions& seeds, double spacing) {
  std::map<GridCell, int> first;
  for (int s = 0; s < seeds.rows(); ++s) {
    first.try_emplace(find_grid_cell(seeds.row(s), spacing), s);
  }
  PlanePositions result(static_cast<Eigen::Index>(first.size()), 2);
  Eigen::Index row = 0;
  for (const auto& [cell, seed] : first) result.row(row++) = seeds.row(seed);
  return result;
}

// Keeps the places whose disks overlap that of one of the bumps; all where there are none.
PlanePositions overlapping(const PlanePositions& places, double radius, const std::vector<Bump>& bumps) {
  if (bumps.empty()) return places;
  PlanePositions result(places.rows(), 2);
  Eigen::Index count = 0;
  for (Eigen::Index k = 0; k < places.rows(); ++k) {
    const Vector2 p = places.row(k);
    const auto overlaps = [&](const Bump& bump) {
      return (p - bump.center).norm() < kRules.bump.disk * (radius + bump.radius);
    };
    if (std::any_of(bumps.begin(), bumps.end(), overlaps)) result.row(count++) = p;
  }
  return result.topRows(count);
}

bool is_seen(const Bump& bump, double length) {
  return bump.depth() > begin_of_soft_step(kRules.bump.least_height * length) &&
         bump.radius >= 0.999 * (kRules.bump.smallest_radius * length) &&
         bump.radius <= 1.001 * (kRules.bump.largest_radius * length);
}

// Returns how surely a bump is a flaw, 0 to 1.
double weigh(const Bump& bump, double length) {
  const double steepness = std::max(1.0, bump.depth() / (kRules.bump.steepest * bump.radius));
  return soft_step(kRules.bump.explained * steepness, bump.explained) *
         soft_step(kRules.bump.least_height * length, bump.depth());
}

bool is_apart(const Bump& bump, const std::vector<Bump>& others) {
  return std::none_of(others.begin(), others.end(), [&](const Bump& other) {
    return other.offset(bump.center).norm() < kRules.bump.overlap * std::max(bump.radius, other.radius);
  });
}

// A bump and the index of the disks of its size.
struct Candidate {
  Bump bump;
  const DiskIndex* index;
};

// Returns the bumps of one radius, at a grid of places, that are worth refining.
std::vector<Candidate> search_places(const HessianSamples& samples, const DiskIndex& index,
                                     const PlanePositions& places, double radius, double length,
                                     const Progress* progress) {
  std::vector<Bump> measured(places.rows());
  ParallelFailure failure;
#pragma omp parallel for schedule(dynamic, 64)
  for (Eigen::Index k = 0; k < places.rows(); ++k) {
    failure.run([&] {
      if (!progress || !progress->cancelled()) measured[k] = measure_at(samples, index, places.row(k), radius);
    });
  }
  failure.rethrow();
  std::vector<Candidate> result;
  for (const Bump& bump : measured) {
    if (bump.explained > kRules.bump.worth_refining && is_seen(bump, length)) result.push_back({bump, &index});
  }
  return result;
}

}  // namespace

std::vector<Bump> find_bumps(const HessianSamples& samples, const PlanePositions& seeds,
                             const std::vector<Bump>& removed, double length, Progress* progress) {
  if (progress) progress->enter(kSearching, "looking for dents");
  std::deque<DiskIndex> indexes;
  std::vector<Candidate> candidates;
  const double largest = kRules.bump.largest_radius * length;
  for (double radius = kRules.bump.smallest_radius * length; radius < 1.01 * largest;
       radius *= kRules.bump.radius_step) {
    indexes.emplace_back(samples, 1.5 * kRules.bump.disk * radius);  // refined radii are up to 1.3 times larger
    const PlanePositions places = overlapping(thin(seeds, kRules.bump.seed_spacing * radius), radius, removed);
    const std::vector<Candidate> found = search_places(samples, indexes.back(), places, radius, length, progress);
    candidates.insert(candidates.end(), found.begin(), found.end());
  }
  std::stable_sort(candidates.begin(), candidates.end(),
                   [](const Candidate& a, const Candidate& b) { return a.bump.explained > b.bump.explained; });
  std::vector<Bump> found, result;
  for (const Candidate& candidate : candidates) {
    if (progress) progress->enter(kRefining, "looking for dents");
    if (!is_apart(candidate.bump, found)) continue;
    Bump best = refine(samples, *candidate.index, length, candidate.bump);
    if (best.explained < begin_of_soft_step(kRules.bump.explained)) continue;
    if (!is_seen(best, length) || !is_apart(best, found)) continue;
    best.weight = weigh(best, length);
    found.push_back(best);
    if (best.weight > 0) result.push_back(best);
  }
  return result;
}

}  // namespace reflines
