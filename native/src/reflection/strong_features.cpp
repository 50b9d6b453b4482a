#include "reflection/strong_features.h"

#include <algorithm>
#include <vector>

#include "reflection/weighted_median.h"

namespace reflines {
namespace {

constexpr double kStrong =
    8.0;  // multiple of the median; dents of 2 mm in 8 cm come to 5 to 10 times, fillets 50 and more

// The least |grad theta| of a feature times the piece's diagonal: a bend radius of a fifth of the diagonal (|grad
// theta| is some 2 / radius). On a mostly flat panel the median is rounding, and every dent exceeds 8 times that.
constexpr double kLeast = 10.0;

// The |grad theta| relative to a feature's least up to which tools act in full.
constexpr double kOrdinary = 1.0 / 3.0;

// Returns the triangles connected to `first` through marked ones, and unmarks them.
std::vector<int> take_component(const HeightField& field, int first, Mask& marked) {
  std::vector<int> component = {first};
  marked(first) = false;
  for (size_t k = 0; k < component.size(); ++k) {
    for (int i = 0; i < 3; ++i) {
      const int other = field.neighbors(component[k], i);
      if (other < 0 || !marked(other)) continue;
      marked(other) = false;
      component.push_back(other);
    }
  }
  return component;
}

double extent(const HeightField& field, const std::vector<int>& triangles) {
  Vector2 low = field.xy.row(field.F(triangles[0], 0)), high = low;
  for (int t : triangles) {
    for (int i = 0; i < 3; ++i) {
      low = low.cwiseMin(field.xy.row(field.F(t, i)).transpose());
      high = high.cwiseMax(field.xy.row(field.F(t, i)).transpose());
    }
  }
  return (high - low).norm();
}

}  // namespace

double strong_bend(const PlaneVectors& gradient, double diagonal) {
  const Vector size = gradient.rowwise().norm();
  std::vector<double> sorted(size.data(), size.data() + size.size());
  std::nth_element(sorted.begin(), sorted.begin() + sorted.size() / 2, sorted.end());
  return std::max(kStrong * sorted[sorted.size() / 2], kLeast / diagonal);
}

double find_strong_size(const PlaneVectors& gradient, const Vector& area, double diagonal) {
  return std::max(kStrong * weighted_median(gradient.rowwise().norm(), area), kLeast / diagonal);
}

Vector measure_response(const PlaneVectors& gradient, double strong) {
  const Vector size = gradient.rowwise().norm();
  const Vector x = (size.array() / strong - kOrdinary).cwiseMax(0.0).cwiseMin(1.0);
  return 1.0 - x.array().square() * (3.0 - 2.0 * x.array());
}

Mask strong_features(const HeightField& field, const PlaneVectors& gradient, double length) {
  Mask strong = gradient.rowwise().norm().array() > strong_bend(gradient, field.piece_diagonal());
  Mask features = Mask::Constant(field.triangle_count(), false);
  for (int t = 0; t < field.triangle_count(); ++t) {
    if (!strong(t)) continue;
    const std::vector<int> component = take_component(field, t, strong);
    if (extent(field, component) <= length) continue;
    for (int member : component) features(member) = true;
  }
  return features;
}

}  // namespace reflines
