#include "restoration/healed_flaws.h"

#include <algorithm>
#include <cmath>
#include <numbers>

#include "restoration/disk_mean.h"
#include "restoration/line_evenness.h"
#include "restoration/press_rules.h"
#include "restoration/soft_step.h"
#include "restoration/triangle_slopes.h"
#include "restoration/worse_place.h"
#include "solver/families.h"

namespace reflines {
namespace {

constexpr double kDegrees = 180.0 / std::numbers::pi;

double mean_of(const Vector& degrees, const Vector& weight) {
  return std::sqrt(weight.dot(degrees.cwiseAbs2()) / std::max(weight.sum(), 1e-300));
}

// Returns the squared deviations of heights z (#V) in each light, where its eye sees them: #F x lights, degrees^2.
Eigen::MatrixXd measure_squares(ControlledSurface& surface, const Vector& z, const Vector& course) {
  Eigen::MatrixXd result(surface.triangles().rows(), surface.optimizer().family_count());
  for (int k = 0; k < result.cols(); ++k)
    result.col(k) =
        surface.optimizer().sight(k).cwiseProduct((kDegrees * measure_offsets(surface, z, course, k)).cwiseAbs2());
  return result;
}

// Sums deviations (#F) up; `area` (#F) is that of the triangles.
HealedPlaces sum_up(const Vector& before, const Vector& after, const Vector& area) {
  Vector healed(area.size());
  for (Eigen::Index t = 0; t < area.size(); ++t) {
    const double gone = 1.0 - after(t) / std::max(before(t), 1e-300);
    healed(t) = soft_step(kRules.verdict.seen, before(t)) * soft_step(kRules.verdict.healed, gone);
  }
  const Vector weight = area.cwiseProduct(healed);
  return {{weight.sum() / area.sum(),
           before.maxCoeff(),
           after.maxCoeff(),
           mean_of(before, weight),
           mean_of(after, weight),
           {},
           {}},
          healed};
}

WorsePlace judge(ControlledSurface& surface, const Vector& before, const Vector& after, const Vector& course,
                 const DiskMean& around, const LightSet& judges) {
  const ShapeOptimizer& optimizer = surface.optimizer();
  const Triangles& F = surface.triangles();
  const Families lights = make_families(surface.positions(), F, optimizer.frame(), judges.line_directions, judges.eyes);
  const auto slopes = [&](const Vector& z) { return find_slopes(optimizer.xy(), F, z); };
  const PlaneVectors reference = slopes(course);
  return find_worse_place(lights, {slopes(before), reference, slopes(after), reference}, around, surface.positions(), F,
                          kWorsened);
}

}  // namespace

HealedPlaces measure_healed(ControlledSurface& surface, const Vector& before, const Vector& after, const Vector& course,
                            double length, const LightSet& judges) {
  ShapeOptimizer& optimizer = surface.optimizer();
  const Vector area = optimizer.area();
  const int lights = optimizer.family_count();
  Eigen::MatrixXd squares(area.size(), 2 * lights);
  squares << measure_squares(surface, before, course), measure_squares(surface, after, course);
  const DiskMean around(optimizer.centers(), area, kRules.verdict.place_radius * length);
  const Eigen::MatrixXd degrees = around.of_columns(squares).cwiseSqrt();
  const auto at_start = degrees.leftCols(lights), at_end = degrees.rightCols(lights);
  HealedPlaces result = sum_up(at_start.rowwise().maxCoeff(), at_end.rowwise().maxCoeff(), area);
  take_worse(at_start, at_end, 0, surface.positions(), surface.triangles(), kWorsened, result.flaws.worse);
  if (judges.exist()) result.flaws.worse_for_judges = judge(surface, before, after, course, around, judges);
  return result;
}

}  // namespace reflines
