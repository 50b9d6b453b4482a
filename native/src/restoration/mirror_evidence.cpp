#include "restoration/mirror_evidence.h"

#include <algorithm>

#include "restoration/designed_difference.h"
#include "restoration/disk_mean.h"
#include "restoration/mean_plane.h"
#include "restoration/press_rules.h"
#include "restoration/roughness.h"
#include "restoration/vertex_gradients.h"

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
  // it is for the difference; marks in `design` (#V) where they differ by design.
  Vector correct(const SeenPoints& points, const MirrorImages& images, Mask& design) const {
    const Vector rise = find_mirrored_rise(points, images);
    if ((rise.array() == 0).all()) return rise;
    const DiskMean mean = average_over(kRules.symmetry.roughness_radius);
    const Vector unbounded = roughness_.of(rise).cwiseAbs();
    const Vector typical = mean.of(unbounded.cwiseAbs2()).cwiseSqrt(), most = kRules.symmetry.roughest * typical;
    const Mask own_design =
        find_designed_differences(xy_, field_.F, rise, typical, kRules.symmetry.deepest * diagonal_, length_);
    const Vector spared = average_over(kRules.symmetry.taper).of((!own_design).cast<double>().matrix());
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
      if (!own_design(v)) result(v) = images.weight * fraction * spared(v) * rise(v);
    }
    design = design || own_design;
    return result;
  }

 private:
  DiskMean average_over(double lengths) const { return {xy_, Vector::Ones(xy_.rows()), lengths * length_}; }

  const HeightField& field_;
  PlanePositions xy_;  // #V x 2, over the mean plane
  Roughness roughness_;
  Vector cosine_;  // #V: of the angle between normal and view
  double diagonal_, length_;
};

}  // namespace

SeenPoints see_vertices(const HeightField& field) {
  SeenPoints result{Positions(field.vertex_count(), 3), find_vertex_gradients(field.xy, field.F, field.z)};
  result.P << field.xy, field.z;
  return result;
}

MirrorEvidence find_mirror_evidence(const HeightField& field, const Vector& z, double diagonal, double length,
                                    const Positions& axes) {
  SeenPoints points = see_vertices(field);
  MirrorEvidence result{Vector::Zero(field.vertex_count()), Mask::Constant(field.vertex_count(), false),
                        find_mirror_images(points, diagonal, axes, MeanPlane(field).normal())};
  if (result.images.empty()) return result;
  const Halves halves(field, points.slope, diagonal, length);
  points.P.col(2) = z;
  points.slope = find_vertex_gradients(field.xy, field.F, z);
  for (const MirrorImages& images : result.images) {
    const Vector change = halves.correct(points, images, result.design);
    result.correction += change;
    points.P.col(2) += change;
  }
  return result;
}

}  // namespace reflines
