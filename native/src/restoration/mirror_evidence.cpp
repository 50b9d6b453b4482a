#include "restoration/mirror_evidence.h"

#include <Eigen/Cholesky>
#include <algorithm>
#include <cmath>
#include <complex>
#include <map>
#include <numbers>
#include <utility>
#include <vector>

#include "base/parallel_failure.h"
#include "base/smoothstep.h"
#include "geometry/cage_symmetry.h"
#include "restoration/designed_difference.h"
#include "restoration/disk_mean.h"
#include "restoration/grid_cell.h"
#include "restoration/press_rules.h"
#include "restoration/vertex_gradients.h"

namespace reflines {
namespace {

constexpr double kSameLine = 1e-7;  // of the direction, and of the diagonal: far below kRules.symmetry.pair_tolerance
constexpr double kLeastMoment = 1e-9;  // relative: a smaller one has no direction

// Planes across which the vertices may be symmetric: those of a mirror image's moments sum (x + iy)^p, whose argument
// is a multiple of the axis's angle, for p = 2 (the principal axes), 3 and 4 (those of a square), and across `axes`.
std::vector<Vector2> list_normals(const PlanePositions& xy, const PlanePositions& axes) {
  std::vector<Vector2> result;
  for (Eigen::Index k = 0; k < axes.rows(); ++k) {
    if (axes.row(k).norm() >= kRules.symmetry.least_axis) result.push_back(axes.row(k).normalized());
  }
  const PlanePositions centred = xy.rowwise() - xy.colwise().mean();
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

// A line n . p = offset in the image plane.
struct Line {
  Vector2 normal;
  double offset;

  Vector2 mirror(const Vector2& p) const { return p - 2.0 * (normal.dot(p) - offset) * normal; }
};

// The vertices in each other's places across a plane.
struct Images {
  Line line;
  IndexVector partner;  // #V, itself where there is none
  double weight;        // 0 to 1: how surely the panel is symmetric
  double difference;    // of partners' heights, root mean square
};

// Finds the images across a line.
Images pair_across(const PlanePositions& xy, const Vector& z, double diagonal, const Line& line) {
  Positions flat(xy.rows(), 3);
  flat << xy, Vector::Zero(xy.rows());
  const Vector2 point = line.offset * line.normal;
  const MirrorPlane plane{Vector3(point.x(), point.y(), 0), Vector3(line.normal.x(), line.normal.y(), 0)};
  IndexVector partner = mirror_pairs(flat, plane, kRules.symmetry.pair_tolerance * diagonal);
  double found = 0, squared = 0;
  for (Eigen::Index v = 0; v < partner.size(); ++v) {
    if (partner(v) < 0) {
      partner(v) = static_cast<int>(v);
      continue;
    }
    const double difference = std::abs(z(v) - z(partner(v)));
    found += difference < kRules.symmetry.deepest * diagonal;
    squared += difference * difference;
  }
  const double share = found / static_cast<double>(partner.size());
  return {line, std::move(partner), smoothstep(kRules.symmetry.unpaired, kRules.symmetry.paired, share), squared};
}

// The distance of each height from a quadratic least-squares fit of the vertices within two edges: an operator that
// vanishes for quadratic surfaces on any mesh. The umbrella operator, applied twice, does not: where the diagonals of
// quads change sides, a dent of 4 mm was less rough than the clean surface beside it, and its mirror image got a
// quarter of it.
class Roughness {
 public:
  Roughness(const PlanePositions& xy, const Triangles& F) : xy_(xy), neighbors_(xy.rows()) {
    for (Eigen::Index t = 0; t < F.rows(); ++t) {
      for (int i = 0; i < 3; ++i) {
        neighbors_[F(t, i)].push_back(F(t, (i + 1) % 3));
        neighbors_[F(t, (i + 1) % 3)].push_back(F(t, i));
      }
    }
  }

  Vector of(const Vector& z) const {
    Vector result(z.size());
    run_parallel(static_cast<int>(z.size()), 256, [&](int v) { result(v) = at(v, z); });
    return result;
  }

 private:
  static constexpr int kLeastNeighbours = 8;  // six coefficients, and something that they do not explain

  std::vector<int> two_rings(int v) const {
    std::vector<int> result;
    for (const int near : neighbors_[v]) {
      result.push_back(near);
      result.insert(result.end(), neighbors_[near].begin(), neighbors_[near].end());
    }
    std::sort(result.begin(), result.end());
    result.erase(std::unique(result.begin(), result.end()), result.end());
    result.erase(std::remove(result.begin(), result.end(), v), result.end());
    return result;
  }

  double at(int v, const Vector& z) const {
    const std::vector<int> ring = two_rings(v);
    if (static_cast<int>(ring.size()) < kLeastNeighbours) return 0.0;
    double size = 0;
    for (const int k : ring) size = std::max(size, (xy_.row(k) - xy_.row(v)).norm());
    Eigen::Matrix<double, 6, 6> A = Eigen::Matrix<double, 6, 6>::Zero();
    Eigen::Matrix<double, 6, 1> b = Eigen::Matrix<double, 6, 1>::Zero();
    for (const int k : ring) {
      const Vector2 p = (xy_.row(k) - xy_.row(v)).transpose() / size;
      const Eigen::Matrix<double, 6, 1> row{1.0, p.x(), p.y(), p.x() * p.x(), p.x() * p.y(), p.y() * p.y()};
      A += row * row.transpose();
      b += (z(k) - z(v)) * row;
    }
    A.diagonal().array() += 1e-9 * A.trace();
    return -A.ldlt().solve(b)(0);
  }

  const PlanePositions& xy_;
  std::vector<std::vector<int>> neighbors_;
};

// Lists the lines that may be of symmetry, each once: across a normal through the middle and through the mean.
std::vector<Line> list_lines(const PlanePositions& xy, double diagonal, const PlanePositions& axes) {
  std::vector<Line> result;
  for (const Vector2& n : list_normals(xy, axes)) {
    const Vector across = xy * n;
    for (const double offset : {(across.minCoeff() + across.maxCoeff()) / 2, across.mean()}) {
      const auto is_same = [&](const Line& line) {
        const double turn = std::min((line.normal - n).norm(), (line.normal + n).norm());
        const double shift = std::abs(line.offset - std::copysign(offset, offset * line.normal.dot(n)));
        return turn < kSameLine && shift < kSameLine * diagonal;
      };
      if (std::none_of(result.begin(), result.end(), is_same)) result.push_back({n, offset});
    }
  }
  return result;
}

// Finds the images across all lines of symmetry, the nearest to a symmetry first: an order that a turned or scaled
// panel keeps.
std::vector<Images> find_images(const PlanePositions& xy, const Vector& z, double diagonal,
                                const PlanePositions& axes) {
  std::vector<Images> result;
  for (const Line& line : list_lines(xy, diagonal, axes)) {
    Images images = pair_across(xy, z, diagonal, line);
    const auto is_same = [&](const Images& other) { return other.partner == images.partner; };
    if (images.weight > 0 && std::none_of(result.begin(), result.end(), is_same)) result.push_back(std::move(images));
  }
  std::stable_sort(result.begin(), result.end(),
                   [](const Images& a, const Images& b) { return a.difference < b.difference; });
  return result;
}

// The heights of the mirrored surface at the vertices.
struct MirroredHeights {
  IndexVector image;  // #V: the vertex that is nearest to the mirrored place of each, itself where none is near
  Vector z;           // #V
};

// Vertices in square cells.
class VertexGrid {
 public:
  VertexGrid(const PlanePositions& xy, double cell) : xy_(xy), cell_(cell) {
    for (int v = 0; v < xy.rows(); ++v) cells_[find_grid_cell(xy.row(v), cell)].push_back(v);
  }

  // Returns the vertex nearest to a place, -1 where there is none within a cell's size.
  int find_nearest(const Vector2& place) const {
    const auto [i, j] = find_grid_cell(place, cell_);
    int best = -1;
    double least = cell_ * cell_;
    for (int k = 0; k < 9; ++k) {
      const auto cell = cells_.find({i + k % 3 - 1, j + k / 3 - 1});
      if (cell == cells_.end()) continue;
      for (const int v : cell->second) {
        const double squared = (xy_.row(v).transpose() - place).squaredNorm();
        if (squared >= least) continue;
        best = v;
        least = squared;
      }
    }
    return best;
  }

 private:
  const PlanePositions& xy_;
  double cell_;
  std::map<std::pair<int, int>, std::vector<int>> cells_;
};

// Lists the vertices beside a line that have no partner across it.
std::vector<int> list_alone(const PlanePositions& xy, double tolerance, const Images& images) {
  std::vector<int> result;
  for (int v = 0; v < xy.rows(); ++v) {
    const bool beside = (images.line.mirror(xy.row(v)) - xy.row(v).transpose()).norm() > tolerance;
    if (beside && images.partner(v) == v) result.push_back(v);
  }
  return result;
}

// Mirrors heights z (#V). A dent along the normal has moved its vertices aside, off the places of their partners: there
// the mirrored surface is its nearest vertex's tangent plane. Without it the skirt of a dent was taken out, where the
// partners were near enough, and the edge left around its core was kept as design: of dents in a cylinder that slopes
// by 11 and 17 degrees there 0.99 and 0.51 stayed.
MirroredHeights mirror_heights(const PlanePositions& xy, const Vector& z, const Triangles& F, double diagonal,
                               const Images& images) {
  MirroredHeights result{images.partner, z(images.partner)};
  const std::vector<int> alone = list_alone(xy, kRules.symmetry.pair_tolerance * diagonal, images);
  if (alone.empty()) return result;
  const VertexGrid grid(xy, kRules.symmetry.deepest * diagonal);
  const PlanePositions gradient = find_vertex_gradients(xy, F, z);
  for (const int v : alone) {
    const Vector2 place = images.line.mirror(xy.row(v));
    const int near = grid.find_nearest(place);
    if (near < 0) continue;
    result.image(v) = near;
    result.z(v) = z(near) + gradient.row(near).dot(place - xy.row(near).transpose());
  }
  return result;
}

// Returns the heights (#V) to add so that images are equally high, each the more the rougher it is for the difference;
// marks in `design` (#V) where they differ by design.
Vector correct_halves(const PlanePositions& xy, const Vector& z, const Triangles& F, const Roughness& roughness,
                      double diagonal, double length, const Images& images, Mask& design) {
  const MirroredHeights mirrored = mirror_heights(xy, z, F, diagonal, images);
  const Vector difference = z - mirrored.z;
  if ((difference.array() == 0).all()) return Vector::Zero(z.size());
  const DiskMean mean(xy, Vector::Ones(z.size()), kRules.symmetry.roughness_radius * length);
  const Vector unbounded = roughness.of(difference).cwiseAbs();
  const Vector most = kRules.symmetry.roughest * mean.of(unbounded.cwiseAbs2()).cwiseSqrt();
  const Mask own_design = find_designed_differences(xy, F, difference, most / kRules.symmetry.roughest,
                                                    kRules.symmetry.deepest * diagonal, length);
  const Vector spared =
      DiskMean(xy, Vector::Ones(z.size()), kRules.symmetry.taper * length).of((!own_design).cast<double>().matrix());
  // Bounded as that of the heights is: else the peak of a dent would count in the difference only, and a quarter of it
  // would be taken for a bump of the other side.
  const Vector own = mean.of(unbounded.cwiseMin(most).cwiseAbs2());
  const Vector rough = roughness.of(z).cwiseAbs().cwiseMin(most).cwiseAbs2();
  // With z = s + a here and s + b there, a - b the difference: E(|rough(z)|^2 - |rough(z')|^2) = |rough(a)|^2 -
  // |rough(b)|^2, so that the share is 1 where only this side has a flaw, 0 where only the other has, half where both
  // do.
  const Vector excess = mean.of(rough - rough(mirrored.image).eval());
  Vector result = Vector::Zero(z.size());
  for (Eigen::Index v = 0; v < z.size(); ++v) {
    const double share = own(v) > 0 ? std::clamp(0.5 + 0.5 * excess(v) / own(v), 0.0, 1.0) : 0.5;
    if (!own_design(v)) result(v) = -images.weight * share * spared(v) * difference(v);
  }
  design = design || own_design;
  return result;
}

// Returns the images as partners of heights z (#V): none where differences are deeper than flaws are.
std::vector<MirrorPartners> pair_alike(std::vector<Images> found, const Vector& z, double diagonal) {
  std::vector<MirrorPartners> result;
  for (Images& images : found) {
    for (Eigen::Index v = 0; v < z.size(); ++v) {
      const double difference = std::abs(z(v) - z(images.partner(v)));
      if (difference >= kRules.symmetry.deepest * diagonal) images.partner(v) = static_cast<int>(v);
    }
    result.push_back({std::move(images.partner), images.weight});
  }
  return result;
}

}  // namespace

std::vector<MirrorPartners> find_mirror_partners(const PlanePositions& xy, const Vector& z, double diagonal,
                                                 const PlanePositions& axes) {
  return pair_alike(find_images(xy, z, diagonal, axes), z, diagonal);
}

MirrorEvidence find_mirror_evidence(const PlanePositions& xy, const Vector& z, const Triangles& F, double diagonal,
                                    double length, const PlanePositions& axes) {
  MirrorEvidence result{
      .correction = Vector::Zero(z.size()), .design = Mask::Constant(z.size(), false), .partners = {}};
  std::vector<Images> found = find_images(xy, z, diagonal, axes);
  if (found.empty()) return result;
  result.vertices = static_cast<int>(z.size());
  const Roughness roughness(xy, F);
  for (const Images& images : found)
    result.correction +=
        correct_halves(xy, z + result.correction, F, roughness, diagonal, length, images, result.design);
  result.partners = pair_alike(std::move(found), z, diagonal);
  return result;
}

}  // namespace reflines
