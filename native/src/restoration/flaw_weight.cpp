#include "restoration/flaw_weight.h"

#include <algorithm>
#include <cmath>

#include "reflection/weighted_median.h"
#include "restoration/disk_mean.h"

namespace reflines {
namespace {

// Radians over the length. Changes up to this are taken for flaws wherever they are. Dents of 0.6 per mille of a
// panel's diagonal change the lines by 0.3. Of 0.2, 0.3, 0.43 and 0.7, on 20 panels of six cars: harm to clean ones
// 0.13, 0.15, 0.17, 0.21 degrees in the median.
constexpr double kShallow = 0.35;

// Changes up to this many times the region's median are taken for flaws, too. Of 3, 4, 5 and 6: 0.65, 0.57, 0.55, 0.53
// left of noise, and no more harm. The same number bounds the means of changes over disks, which noise does not hide
// features from. By size alone it does: with noise on stretched meshes a scoop's lines were 4.0 degrees off instead of
// 3.1, and 0.47 of all error was left instead of 0.54; on others both do the same.
constexpr double kTypical = 5.0;

// Radians over the length: a typical change beyond it, that of triangles near each other taken together, is no noise.
// Where a selection is features all over (half a car body: 3 to 6) the median tells nothing, and without this bound
// such selections were changed by 5 degrees. Clean panels have 0.02 to 0.25. Changes of noise cancel out: vertex noise
// of 1 % of an edge makes 0.04 to 0.12 at 800 to 10,000 vertices, where their size is 0.2 to 1.0, the finer the mesh
// the more; by size, noise of 10,000 vertices was features all over, and 0.60 of it was left instead of 0.24.
constexpr double kFeaturesAllOver = 1.1;

// Radius, relative to the length, over which changes are averaged, so that noise does not decide by itself what is
// noise.
constexpr double kAveraged = 0.28;

double geman_mcclure(double x) { return 1.0 / ((1.0 + x * x) * (1.0 + x * x)); }

// Returns up to what a change is a flaw: `kShallow`, or some times the typical one, unless features are all over.
double find_largest(double typical, double alike) {
  return std::max(kShallow, kTypical * typical * geman_mcclure(alike / kFeaturesAllOver));
}

}  // namespace

Vector flaw_weight(const TriangleFields& change, const PlanePositions& centers, const Vector& area, double length) {
  Eigen::MatrixXd columns(change.rows(), change.cols() + 1);
  columns << change.rowwise().squaredNorm(), change;
  columns = DiskMean(centers, area, kAveraged * length).of_columns(columns);
  const Vector size = length * columns.col(0).cwiseSqrt();
  const Vector mean = length * columns.rightCols(change.cols()).rowwise().norm();
  const double alike = weighted_median(mean, area);
  const Vector by_size = size / find_largest(weighted_median(size, area), alike);
  // Squared, so that the means that noise leaves, up to twice their median, count nothing: unsquared 0.29 instead of
  // 0.27 of noise is left on a plain panel.
  const Vector by_mean = (mean / find_largest(alike, alike)).cwiseAbs2();
  return by_size.cwiseMax(by_mean).unaryExpr(&geman_mcclure);
}

}  // namespace reflines
