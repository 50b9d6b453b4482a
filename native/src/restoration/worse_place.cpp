#include "restoration/worse_place.h"

#include <algorithm>

#include "restoration/line_departure.h"

namespace reflines {
namespace {

// Lights whose means are taken together: they have the weights of the disks in common, and their columns bound the
// memory.
constexpr int kTogether = 8;

}  // namespace

WorsePlace find_worse_place(const Families& lights, const ChangedSlopes& slopes, const DiskMean& around,
                            const Positions& V, const Triangles& F, double least) {
  WorsePlace result;
  double most = least;
  const int count = static_cast<int>(lights.sight.size());
  for (int first = 0; first < count; first += kTogether) {
    const int some = std::min(kTogether, count - first);
    Eigen::MatrixXd squares(F.rows(), 2 * some);
    for (int k = 0; k < some; ++k) {
      const ReflectionFunction& light = lights.lines[first + k];
      const Vector& sight = lights.sight[first + k];
      squares.col(2 * k) = measure_departure(light, slopes.before, slopes.course_before, sight);
      squares.col(2 * k + 1) = measure_departure(light, slopes.after, slopes.course_after, sight);
    }
    const Eigen::MatrixXd degrees = around.of_columns(squares).cwiseSqrt();
    for (int k = 0; k < some; ++k) {
      for (Eigen::Index t = 0; t < F.rows(); ++t) {
        const double before = degrees(t, 2 * k), after = degrees(t, 2 * k + 1);
        if (after < kWorst || after - before < most) continue;
        most = after - before;
        result = {first + k, before, after, V(F.row(t), Eigen::all).colwise().mean().transpose()};
      }
    }
  }
  return result;
}

}  // namespace reflines
