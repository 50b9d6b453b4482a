#include "restoration/mirror_evidence.h"

#include <Eigen/Geometry>
#include <algorithm>
#include <limits>

#include "restoration/designed_difference.h"
#include "restoration/disk_mean.h"
#include "restoration/mean_plane.h"
#include "restoration/press_rules.h"
#include "restoration/roughness.h"
#include "restoration/triangle_slopes.h"

namespace reflines {
namespace {

// Compares the halves of a surface over the plane of its mean normal, where it is as large as it is from every view.
// The view sees a length along the normal as one along the view by their angle's cosine, which differs from half to
// half where the view is not in the plane of symmetry.
class Halves {
 public:
  // `slope` (#V x 2) is that of the field at its vertices.
  Halves(const HeightField& field, const PlanePositions& slope, double diagonal, double length)
      : field_(field),
        xy_(MeanPlane(field).project(field).xy),
        roughness_(xy_, field.F),
        cosine_((1.0 + slope.rowwise().squaredNorm().array()).rsqrt()),
        diagonal_(diagonal),
        length_(length) {}

  // Returns the heights along the view (#V) to add to `points` so that images are alike, to each the more the rougher
  // it is for the difference; marks where they differ by design.
  Vector correct(const SeenPoints& points, MirrorImages& images) const {
    const Vector rise = find_rise(points, images);
    if ((rise.array() == 0).all()) return rise;
    const DiskMean mean = average_over(kRules.symmetry.roughness_radius);
    const Vector unbounded = roughness_.of(rise).cwiseAbs();
    const Vector typical = mean.of(unbounded.cwiseAbs2()).cwiseSqrt(), most = kRules.symmetry.roughest * typical;
    images.design =
        find_designed_differences(xy_, field_.F, rise, typical, kRules.symmetry.deepest * diagonal_, length_);
    const Vector spared = average_over(kRules.symmetry.averaged).of((!images.design).cast<double>().matrix());
    // Bounded as that of the heights is: else the peak of a dent would count in the difference only, and a quarter of
    // it would be taken for a bump of the other side.
    const Vector own = mean.of(unbounded.cwiseMin(most).cwiseAbs2());
    const Vector rough = roughness_.of(points.P.col(2)).cwiseAbs().cwiseMin(most);
    // With z = s + a here and s + b there, a - b the difference: E(|rough(z)|^2 - |rough(z')|^2) = |rough(a)|^2 -
    // |rough(b)|^2, so that the fraction is 1 where only this side has a flaw, 0 where only the other has, half where
    // both do.
    const Vector mirrored = rough(images.image).cwiseProduct(cosine_(images.image)).cwiseQuotient(cosine_);
    const Vector excess = mean.of(rough.cwiseAbs2() - mirrored.cwiseAbs2());
    Vector result = Vector::Zero(rise.size());
    for (Eigen::Index v = 0; v < rise.size(); ++v) {
      const double fraction = own(v) > 0 ? std::clamp(0.5 + 0.5 * excess(v) / own(v), 0.0, 1.0) : 0.5;
      if (!images.design(v)) result(v) = images.weight(v) * fraction * spared(v) * rise(v);
    }
    return result;
  }

 private:
  // Returns by how much images are higher than by design (#V): less where the difference is no more than partners lie
  // aside; averaged where they do, since vertices of slivers would turn them by what they differ in; and as around
  // where there is no partner, lest the place stand out.
  Vector find_rise(const SeenPoints& points, const MirrorImages& images) const {
    const Vector own = find_mirrored_rise(points, images) - images.kept, paired = images.paired.cast<double>();
    if ((own.array() == 0).all()) return own;
    const Vector mean = DiskMean(xy_, paired, kRules.symmetry.averaged * length_).of(own);
    const Eigen::ArrayXd inexact = images.aside.array() / (kRules.symmetry.exact * diagonal_);
    const Eigen::ArrayXd rise = mean.array() + paired.array() / (1.0 + inexact.square()) * (own - mean).array();
    const Eigen::ArrayXd squared = average_over(kRules.symmetry.averaged).of(rise.square().matrix());
    const Eigen::ArrayXd least = (kRules.symmetry.aside * images.aside.array()).square() + kLeast;
    return rise * squared / (squared + least);
  }

  static constexpr double kLeast = 1e-300;  // square of a length: no difference at all

  DiskMean average_over(double lengths) const { return {xy_, Vector::Ones(xy_.rows()), lengths * length_}; }

  const HeightField& field_;
  PlanePositions xy_;  // #V x 2, over the mean plane
  Roughness roughness_;
  Vector cosine_;  // #V: of the angle between normal and view
  double diagonal_, length_;
};

// Returns the least altitude of the triangles around each point (#V).
Vector find_least_altitudes(const Positions& P, const Triangles& F) {
  Vector result = Vector::Constant(P.rows(), std::numeric_limits<double>::infinity());
  for (Eigen::Index t = 0; t < F.rows(); ++t) {
    const Vector3 a = P.row(F(t, 1)) - P.row(F(t, 0)), b = P.row(F(t, 2)) - P.row(F(t, 1));
    const double longest = std::max({a.norm(), b.norm(), (a + b).norm()});
    const double altitude = longest > 0 ? a.cross(b).norm() / longest : 0.0;
    for (int i = 0; i < 3; ++i) result(F(t, i)) = std::min(result(F(t, i)), altitude);
  }
  return result.array().isInf().select(0.0, result);  // of no triangle
}

}  // namespace

SeenPoints see_vertices(const HeightField& field, double diagonal) {
  const int count = field.vertex_count();
  SeenPoints result{Positions(count, 3), find_vertex_gradients(field.xy, field.F, field.z), {}};
  result.P << field.xy, field.z;
  const Vector tolerance = kRules.symmetry.pair_altitude * find_least_altitudes(result.P, field.F);
  result.tolerance = tolerance.cwiseMax(kRules.symmetry.pair_tolerance * diagonal);
  return result;
}

MirrorEvidence find_mirror_evidence(const HeightField& field, const Vector& z, double diagonal, double length,
                                    const Positions& axes) {
  const Vector3 mean = MeanPlane(field).normal();
  SeenPoints points = see_vertices(field, diagonal);
  MirrorEvidence result{Vector::Zero(field.vertex_count()), find_mirror_images(points, diagonal, length, axes, mean)};
  if (result.images.empty()) return result;
  const Halves halves(field, points.slope, diagonal, length);
  points.P.col(2) = z;
  points.slope = find_vertex_gradients(field.xy, field.F, z);
  // Keeps what halves differ by smoothly, and takes them for the less alike, the more that is.
  const auto keep_design = [&](MirrorImages& images, const Vector& paired) {
    images.kept = find_kept_difference(points, images, mean, diagonal, length);
    const Eigen::ArrayXd unlike = images.kept.array() / (kRules.symmetry.design_height * diagonal);
    images.weight = paired.array() / (1.0 + unlike.square()).square();
  };
  std::vector<Vector> paired;
  for (MirrorImages& images : result.images) {
    paired.push_back(images.weight);
    keep_design(images, paired.back());
    const Vector change = halves.correct(points, images);
    result.correction += change;
    points.P.col(2) += change;
  }
  for (size_t k = 0; k < paired.size(); ++k) keep_design(result.images[k], paired[k]);
  return result;
}

}  // namespace reflines
