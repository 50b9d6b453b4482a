#include "optimization/bounds.h"

#include <algorithm>
#include <cmath>

namespace reflines {

Sides Bounds::touched_by(const Vector& x) const {
  Sides sides(x.size(), Side::kBetween);
  for (int k = 0; k < x.size(); ++k) {
    if (x(k) <= low(k)) sides[k] = Side::kLow;
    if (x(k) >= high(k)) sides[k] = Side::kHigh;
  }
  return sides;
}

Sides Bounds::points() const {
  Sides sides(low.size(), Side::kBetween);
  for (int k = 0; k < low.size(); ++k) {
    if (is_point(k)) sides[k] = Side::kLow;
  }
  return sides;
}

Vector Bounds::ends(const Sides& held) const {
  Vector ends = Vector::Zero(low.size());
  for (int k = 0; k < ends.size(); ++k) {
    if (held[k] != Side::kBetween) ends(k) = end(k, held[k]);
  }
  return ends;
}

Vector Bounds::nearest(const Vector& x, const Contacts& contacts) const {
  Vector result = nearest(x);
  for (const Contact& own : contacts) result(own.row) = end(own.row, own.side);
  return result;
}

double Bounds::projected_norm(const Vector& x, const Vector& gradient) const {
  double squared = 0.0;
  for (int k = 0; k < x.size(); ++k) {
    double entry = gradient(k);
    if (x(k) <= low(k)) entry = std::min(entry, 0.0);
    if (x(k) >= high(k)) entry = std::max(entry, 0.0);
    squared += entry * entry;
  }
  return std::sqrt(squared);
}

double largest_finite(const Vector& values) {
  return values.array().isFinite().select(values.array().abs(), 0.0).maxCoeff();
}

int count_held(const Sides& sides) {
  return static_cast<int>(std::count_if(sides.begin(), sides.end(), [](Side s) { return s != Side::kBetween; }));
}

int count_changes(const Sides& before, const Sides& after) {
  int changes = 0;
  for (size_t k = 0; k < before.size(); ++k) changes += before[k] != after[k];
  return changes;
}

void clear_held(const Sides& held, Vector& x) {
  for (Eigen::Index k = 0; k < x.size(); ++k) {
    if (held[k] != Side::kBetween) x(k) = 0.0;
  }
}

}  // namespace reflines
