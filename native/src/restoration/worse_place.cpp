#include "restoration/worse_place.h"

#include <algorithm>

#include "restoration/line_departure.h"

namespace reflines {
namespace {

// Lights whose means are taken together: they have the weights of the disks in common, and their columns bound the
// memory.
constexpr int kTogether = 8;

}  // namespace

void take_worse(const Eigen::Ref<const Eigen::MatrixXd>& before, const Eigen::Ref<const Eigen::MatrixXd>& after,
                int first, const Positions& V, const Triangles& F, double least, WorsePlace& worst) {
  double most = worst.light < 0 ? least : worst.after - worst.before;
  for (Eigen::Index k = 0; k < before.cols(); ++k) {
    for (Eigen::Index t = 0; t < F.rows(); ++t) {
      if (after(t, k) < kWorst || after(t, k) - before(t, k) < most) continue;
      most = after(t, k) - before(t, k);
      worst = {first + static_cast<int>(k), before(t, k), after(t, k),
               V(F.row(t), Eigen::all).colwise().mean().transpose()};
    }
  }
}

WorsePlace find_worse_place(const Families& lights, const ChangedSlopes& slopes, const DiskMean& around,
                            const Positions& V, const Triangles& F, double least) {
  WorsePlace result;
  const int count = static_cast<int>(lights.sight.size());
  for (int first = 0; first < count; first += kTogether) {
    const int some = std::min(kTogether, count - first);
    Eigen::MatrixXd squares(F.rows(), 2 * some);  // before, and after
    for (int k = 0; k < some; ++k) {
      const ReflectionFunction& light = lights.lines[first + k];
      const Vector& sight = lights.sight[first + k];
      squares.col(k) = measure_departure(light, slopes.before, slopes.course_before, sight);
      squares.col(some + k) = measure_departure(light, slopes.after, slopes.course_after, sight);
    }
    const Eigen::MatrixXd degrees = around.of_columns(squares).cwiseSqrt();
    take_worse(degrees.leftCols(some), degrees.rightCols(some), first, V, F, least, result);
  }
  return result;
}

}  // namespace reflines
