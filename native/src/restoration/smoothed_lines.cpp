#include "restoration/smoothed_lines.h"

#include <algorithm>
#include <iterator>
#include <vector>

#include "restoration/flaw_weight.h"
#include "restoration/length_choice.h"

namespace reflines {
namespace {

// Lengths, relative to that of the flaws, up to which the lines are smoothed; see share_lengths. The first two, three,
// four and five of these leave 0.41, 0.39, 0.39, 0.39 of noise on four panels and 0.23, 0.20, 0.18, 0.18 of the flaws
// of a bonnet with ripples and wide dents; three and four cost 5 and 10 % of a press. Not taken: 16, by which clean
// designs of flutes and waves, which eight times the length takes away as well, are harmed by 1.6 instead of 0.2
// degrees (0.39 instead of 0.67 of a door's long waves would be left). The creases of all are those of the first: with
// creases found anew twice as much was left of ripples round a scoop, whose own bends went. Below a cage the first is
// taken everywhere: with all of them a clean door moved by 0.8 mm instead of 0.4.
constexpr double kStretches[] = {1.0, 2.0, 4.0, 8.0};

// Returns the changes (#F x m each) that smoothing makes to fields up to the length of flaws times kStretches, or times
// the first alone.
std::vector<TriangleFields> smooth_further(const CreasePreservingSmoother& smoother, const Vector& creases,
                                           const TriangleFields& fields, bool first_alone) {
  std::vector<TriangleFields> result;
  for (const double stretch : kStretches) {
    result.push_back(smoother.smooth_with(creases, fields, stretch) - fields);
    if (first_alone) break;
  }
  return result;
}

// Returns the weights as flaws (#F x #lengths that can be chosen) of these changes.
Eigen::MatrixXd weigh_changes(const ShapeOptimizer& optimizer, const std::vector<TriangleFields>& changes,
                              double length) {
  Eigen::MatrixXd result(optimizer.triangle_count(), std::max<Eigen::Index>(1, std::ssize(changes) - 1));
  for (Eigen::Index k = 0; k < result.cols(); ++k)
    result.col(k) = flaw_weight(changes[k], optimizer.centers(), optimizer.area(), length);
  return result;
}

}  // namespace

TriangleFields smooth_lines(ControlledSurface& surface, const CreasePreservingSmoother& smoother, const Vector& creases,
                            const TriangleFields& fields, double length) {
  const ShapeOptimizer& optimizer = surface.optimizer();
  const std::vector<TriangleFields> changes =
      smooth_further(smoother, creases, fields, !surface.controls_every_vertex());
  const Eigen::MatrixXd weight = weigh_changes(optimizer, changes, length);
  const Eigen::MatrixXd share = share_lengths(changes, weight, optimizer.centers(), optimizer.area(), length);
  TriangleFields result = fields;
  for (Eigen::Index k = 0; k < share.cols(); ++k)
    result += weight.col(k).cwiseProduct(share.col(k)).asDiagonal() * changes[k];
  return result;
}

}  // namespace reflines
