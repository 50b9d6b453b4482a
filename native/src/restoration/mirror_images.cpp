#include "restoration/mirror_images.h"

#include <Eigen/Geometry>
#include <algorithm>
#include <cmath>
#include <complex>
#include <numbers>
#include <utility>

#include "base/parallel_failure.h"
#include "geometry/height_field.h"
#include "restoration/disk_mean.h"
#include "restoration/grid_cell.h"
#include "restoration/press_rules.h"
#include "restoration/smooth_difference.h"
#include "restoration/soft_step.h"

namespace reflines {
namespace {

constexpr double kSame = 1e-7;   // of the direction, and of the diagonal: far below kRules.symmetry.pair_tolerance
constexpr double kAlike = 1e-3;  // relative difference, and components of unit normals
constexpr double kLeastMoment = 1e-9;  // relative: a smaller one has no direction
constexpr int kSamples = 500;          // points by which a plane is tried
constexpr int kChunk = 1024;           // points for a thread

// The plane of the mean normal.
struct MeanFrame {
  explicit MeanFrame(const Vector3& normal) : first(normal.unitOrthogonal()), second(normal.cross(first)) {}

  PlanePositions project(const Positions& P) const {
    PlanePositions result(P.rows(), 2);
    result << P * first, P * second;
    return result;
  }

  Vector3 first, second;
};

// Lists unit normals of planes across which places q (#V x 2) may be symmetric: those of a mirror image's moments sum
// (x + iy)^p, whose argument is a multiple of the axis's angle, for p = 2 (the principal axes), 3 and 4 (those of a
// square).
std::vector<Vector2> list_normals(const PlanePositions& q) {
  std::vector<Vector2> result;
  const PlanePositions centred = q.rowwise() - q.colwise().mean();
  for (int p = 2; p <= 4; ++p) {
    std::complex<double> moment = 0;
    double size = 0;
    for (Eigen::Index v = 0; v < centred.rows(); ++v) {
      const std::complex<double> power = std::pow(std::complex<double>(centred(v, 0), centred(v, 1)), p);
      moment += power;
      size += std::abs(power);
    }
    if (std::abs(moment) <= kLeastMoment * size) continue;
    for (int k = 0; k < p; ++k) {
      const double angle = (std::arg(moment) + std::numbers::pi * k) / p;
      result.emplace_back(-std::sin(angle), std::cos(angle));
    }
  }
  return result;
}

// Lists the planes that may be of symmetry, each once: across a normal through the middle and through the mean.
std::vector<MirrorAcross> list_planes(const Positions& P, double diagonal, const Positions& axes,
                                      const MeanFrame& frame) {
  std::vector<Vector3> normals;
  for (Eigen::Index k = 0; k < axes.rows(); ++k) normals.emplace_back(axes.row(k).normalized());
  for (const Vector2& n : list_normals(frame.project(P)))
    normals.emplace_back(frame.first * n.x() + frame.second * n.y());
  std::vector<MirrorAcross> result;
  for (const Vector3& n : normals) {
    const Vector across = P * n;
    for (const double offset : {(across.minCoeff() + across.maxCoeff()) / 2, across.mean()}) {
      const auto is_same = [&](const MirrorAcross& plane) {
        const double turn = std::min((plane.normal - n).norm(), (plane.normal + n).norm());
        const double shift = std::abs(plane.offset - std::copysign(offset, offset * plane.normal.dot(n)));
        return turn < kSame && shift < kSame * diagonal;
      };
      if (std::none_of(result.begin(), result.end(), is_same)) result.push_back({n, offset});
    }
  }
  return result;
}

// Points in square cells of the image plane.
class PointGrid {
 public:
  PointGrid(const Positions& P, double cell) : P_(P), cell_(cell) {
    for (int v = 0; v < P.rows(); ++v) cells_[key(P.row(v))].push_back(v);
  }

  // Returns the point that is seen nearest to a place, -1 where there is none within a cell's size.
  int find_nearest(const Vector3& place) const {
    const auto [i, j] = key(place);
    int best = -1;
    double least = cell_ * cell_;
    for (int k = 0; k < 9; ++k) {
      const auto cell = cells_.find({i + k % 3 - 1, j + k / 3 - 1});
      if (cell == cells_.end()) continue;
      for (const int v : cell->second) {
        const double squared = (P_.row(v).transpose() - place).head<2>().squaredNorm();
        if (squared >= least) continue;
        best = v;
        least = squared;
      }
    }
    return best;
  }

 private:
  GridCell key(const Vector3& p) const { return find_grid_cell(p.head<2>(), cell_); }

  const Positions& P_;
  double cell_;
  GridCells cells_;
};

// The mirrored tangent plane at a point's image, beside the point.
struct MirroredPlace {
  double rise = 0;     // of that plane at the point, along the view
  double aside = 0;    // how far from the point the view sees the image
  double allowed = 0;  // how far aside a flaw of that rise goes along the mirror image of the view, or the normal
  bool seen = false;   // the mirrored surface faces the view
};

MirroredPlace mirror_place(const SeenPoints& points, const MirrorAcross& plane, int v, int image) {
  const Vector3 off = plane.of_point(points.P.row(image)) - points.P.row(v).transpose();
  const Vector3 normal = plane.of_direction({-points.slope(image, 0), -points.slope(image, 1), 1.0});
  if (normal.z() < kSilhouette * normal.norm()) return {};
  const double rise = normal.dot(off) / normal.z();
  const Vector2 by_view = normal.z() * plane.of_direction(Vector3::UnitZ()).head<2>();
  const Vector2 by_normal = normal.z() / normal.squaredNorm() * normal.head<2>();
  const double slip = std::sqrt(std::max(by_view.squaredNorm(), by_normal.squaredNorm()));
  return {rise, off.head<2>().norm(), std::abs(rise) * slip, true};
}

// Finds the images of every `stride`th point, and returns the norm of the rises at those that are paired.
double find_images(const SeenPoints& points, const PointGrid& grid, double diagonal, int stride, MirrorImages& images) {
  const int count = static_cast<int>(points.P.rows());
  images.image = IndexVector::LinSpaced(count, 0, count - 1);
  images.paired = Mask::Constant(count, false);
  images.aside = points.tolerance;
  Vector rise = Vector::Zero(count);
  run_parallel((count + stride - 1) / stride, kChunk, [&](int k) {
    const int v = k * stride, near = grid.find_nearest(images.plane.of_point(points.P.row(v)));
    if (near < 0) return;
    const MirroredPlace place = mirror_place(points, images.plane, v, near);
    if (!place.seen) return;
    images.image(v) = near;
    images.aside(v) = std::max(place.aside - place.allowed, 0.0);
    images.paired(v) =
        std::abs(place.rise) < kRules.symmetry.deepest * diagonal && images.aside(v) <= points.tolerance(v);
    if (images.paired(v)) rise(v) = place.rise;
  });
  return rise.norm();
}

// Finds how surely the surface is symmetric around each place q (#V x 2), and how far aside images lie there.
void weigh_around(const PlanePositions& q, double length, MirrorImages& images) {
  const Vector paired = images.paired.cast<double>();
  const double whole = soft_step(kRules.symmetry.paired_in_all, paired.mean());
  images.weight = DiskMean(q, Vector::Ones(q.rows()), length).of(paired).unaryExpr([&](double fraction) {
    return whole * soft_step(kRules.symmetry.paired, fraction);
  });
  images.aside = DiskMean(q, paired, length).of(images.aside);
}

// Returns true where two planes have the same images for the most part: they are one plane but for flaws, which do not
// turn those across axes, the first to be tried.
bool are_alike(const MirrorImages& one, const MirrorImages& other) {
  return 2 * (one.image.array() == other.image.array()).count() > one.image.size();
}

using Found = std::pair<double, MirrorImages>;  // with how far the halves differ

// Sorts images by how far halves differ; those that differ alike, as across both diagonals of a square that is
// symmetric across its middle, by their normals over `axes`, lest the last digit decide.
void sort_images(std::vector<Found>& found, const Positions& axes) {
  std::stable_sort(found.begin(), found.end(), [](const Found& a, const Found& b) { return a.first < b.first; });
  const auto normal = [&](const Found& each) -> Vector {
    const Vector result = axes * each.second.plane.normal;
    for (const double component : result) {
      if (std::abs(component) > kAlike) return std::copysign(1.0, component) * result;
    }
    return result;
  };
  const auto is_before = [&](const Found& a, const Found& b) {
    const Vector one = normal(a), other = normal(b);
    for (Eigen::Index k = 0; k < one.size(); ++k) {
      if (std::abs(one(k) - other(k)) > kAlike) return one(k) < other(k);
    }
    return false;
  };
  for (auto begin = found.begin(); begin != found.end();) {
    const double most = begin->first * (1.0 + kAlike);
    const auto end = std::find_if(begin, found.end(), [&](const Found& each) { return each.first > most; });
    std::stable_sort(begin, end, is_before);
    begin = end;
  }
}

}  // namespace

std::vector<MirrorImages> find_mirror_images(const SeenPoints& points, double diagonal, double length,
                                             const Positions& axes, const Vector3& mean) {
  const MeanFrame frame(mean);
  const PlanePositions q = frame.project(points.P);
  const PointGrid grid(points.P, kRules.symmetry.deepest * diagonal);
  const int count = static_cast<int>(points.P.rows()), stride = std::max(1, count / kSamples);
  std::vector<Found> found;
  for (const MirrorAcross& plane : list_planes(points.P, diagonal, axes, frame)) {
    MirrorImages images{.plane = plane};
    find_images(points, grid, diagonal, stride, images);
    const double sampled = static_cast<double>(images.paired.count() * stride) / count;
    if (sampled < begin_of_soft_step(kRules.symmetry.paired_in_all))
      continue;  // no weight: the other points need not be looked at
    const double difference = find_images(points, grid, diagonal, 1, images);
    const auto is_same = [&](const auto& other) { return are_alike(images, other.second); };
    if (std::any_of(found.begin(), found.end(), is_same)) continue;
    weigh_around(q, length, images);
    if (images.weight.maxCoeff() == 0) continue;
    images.kept = Vector::Zero(count);
    images.design = Mask::Constant(count, false);
    found.emplace_back(difference, std::move(images));
  }
  sort_images(found, axes);
  std::vector<MirrorImages> result;
  for (auto& [difference, images] : found) result.push_back(std::move(images));
  return result;
}

Vector find_kept_difference(const SeenPoints& points, const MirrorImages& images, const Vector3& mean, double diagonal,
                            double length) {
  return find_smooth_difference(MeanFrame(mean).project(points.P), find_mirrored_rise(points, images), images.paired,
                                length, kRules.symmetry.held_difference * diagonal);
}

Vector find_mirrored_rise(const SeenPoints& points, const MirrorImages& images) {
  Vector result = Vector::Zero(images.image.size());
  for (int v = 0; v < result.size(); ++v) {
    if (images.image(v) != v || images.paired(v))
      result(v) = mirror_place(points, images.plane, v, images.image(v)).rise;
  }
  return result;
}

}  // namespace reflines
