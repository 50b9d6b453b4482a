#include "geometry/sight.h"

#include <Eigen/Geometry>
#include <algorithm>
#include <cmath>
#include <utility>

#include "base/smoothstep.h"
#include "geometry/bounding_box.h"
#include "geometry/mesh.h"

namespace reflines {
namespace {

// The cosine of the angle between normal and eye from which on a triangle is seen, and seen well.
constexpr double kGrazing = 0.2, kFacing = 0.35;

constexpr double kClearance = 1e-6;  // relative to the diagonal: what is no further in front of a place hides nothing

constexpr double kMostCells = 4e6;

using Box = Eigen::AlignedBox2d;

Box find_box(const Positions& seen, const Triangles& F, Eigen::Index t) {
  Box box;
  for (int i = 0; i < 3; ++i) box.extend(Vector2(seen(F(t, i), 0), seen(F(t, i), 1)));
  return box;
}

Positions turn(const Positions& V, const Vector3& view) {
  const Vector3 x = view.unitOrthogonal();
  Eigen::Matrix3d axes;
  axes << x, view.cross(x), view;
  return V * axes;
}

// A set of triangles as it is seen from afar, in cells across the view.
class ViewVisibility {
 public:
  // Takes V (#V x 3) and F (#F x 3), the latter by reference; `view` is a unit direction from the surface to the
  // viewer.
  ViewVisibility(const Positions& V, const Triangles& F, const Vector3& view);

  // Returns true where another triangle, more than `clearance` in front of triangle t, hides its middle; its neighbours
  // do not.
  bool is_hidden(int t, double clearance) const;

  // Returns the cosine of the angle between the triangle's normal and the view.
  double facing(int t) const;

 private:
  bool covers(int t, const Vector3& point) const;
  bool touches(int t, int other) const;
  std::pair<int, int> cell_of(const Vector2& point) const;

  const Triangles& F_;
  Positions seen_;  // #V x 3: place across the view, and height towards the viewer
  Vector2 low_ = Vector2::Zero();
  double cell_ = 1.0;
  int columns_ = 1, rows_ = 1;
  Incidence triangles_of_cell_;
};

ViewVisibility::ViewVisibility(const Positions& V, const Triangles& F, const Vector3& view)
    : F_(F), seen_(turn(V, view)) {
  Box all;
  double size = 0;  // of a triangle, in the mean
  for (Eigen::Index t = 0; t < F.rows(); ++t) {
    const Box box = find_box(seen_, F, t);
    all.extend(box);
    size += box.sizes().maxCoeff() / static_cast<double>(F.rows());
  }
  if (F.rows() == 0) return;
  low_ = all.min();
  const Vector2 extent = all.sizes();
  cell_ = std::max({size, std::sqrt(extent.prod() / kMostCells), extent.maxCoeff() / kMostCells, 1e-300});
  columns_ = 1 + static_cast<int>(extent.x() / cell_);
  rows_ = 1 + static_cast<int>(extent.y() / cell_);
  triangles_of_cell_ = make_incidence(static_cast<std::size_t>(columns_) * rows_, [&](const auto& take) {
    for (int t = 0; t < static_cast<int>(F_.rows()); ++t) {
      const Box box = find_box(seen_, F_, t);
      const auto [left, bottom] = cell_of(box.min());
      const auto [right, top] = cell_of(box.max());
      for (int row = bottom; row <= top; ++row) {
        for (int column = left; column <= right; ++column) take(static_cast<std::size_t>(row) * columns_ + column, t);
      }
    }
  });
}

std::pair<int, int> ViewVisibility::cell_of(const Vector2& point) const {
  const Vector2 place = (point - low_) / cell_;
  return {static_cast<int>(std::clamp(place.x(), 0.0, columns_ - 1.0)),
          static_cast<int>(std::clamp(place.y(), 0.0, rows_ - 1.0))};
}

// Returns true where triangle t lies over a point, higher than that.
bool ViewVisibility::covers(int t, const Vector3& point) const {
  const Vector3 a = seen_.row(F_(t, 0)), b = seen_.row(F_(t, 1)), c = seen_.row(F_(t, 2));
  if (std::max({a.z(), b.z(), c.z()}) <= point.z()) return false;
  const Vector3 ab = b - a, ac = c - a, ap = point - a;
  const double area = ab.x() * ac.y() - ab.y() * ac.x();
  if (area == 0) return false;  // seen from the side
  const double v = (ap.x() * ac.y() - ap.y() * ac.x()) / area, w = (ab.x() * ap.y() - ab.y() * ap.x()) / area;
  return v >= 0 && w >= 0 && v + w <= 1 && v * ab.z() + w * ac.z() > ap.z();
}

bool ViewVisibility::touches(int t, int other) const {
  for (int i = 0; i < 3; ++i) {
    if ((F_.row(t).array() == F_(other, i)).any()) return true;
  }
  return false;
}

bool ViewVisibility::is_hidden(int t, double clearance) const {
  Vector3 middle = (seen_.row(F_(t, 0)) + seen_.row(F_(t, 1)) + seen_.row(F_(t, 2))) / 3;
  middle.z() += clearance;
  const auto [column, row] = cell_of(middle.head<2>());
  const int cell = row * columns_ + column;
  for (int k = triangles_of_cell_.begin(cell); k < triangles_of_cell_.end(cell); ++k) {
    const int other = triangles_of_cell_.items[k];
    if (covers(other, middle) && !touches(t, other)) return true;
  }
  return false;
}

double ViewVisibility::facing(int t) const { return unit_normal(seen_, F_, t).z(); }

}  // namespace

Vector weigh_sight(const Positions& V, const Triangles& F, const std::vector<int>& triangles, const Vector3& eye) {
  const ViewVisibility visibility(V, F, eye);
  const double clearance = kClearance * find_bounding_box(V, F).diagonal().norm();
  const int count = static_cast<int>(triangles.size());
  Vector weight(count);
#pragma omp parallel for schedule(dynamic, 256)
  for (int k = 0; k < count; ++k) {
    weight(k) = smoothstep(kGrazing, kFacing, visibility.facing(triangles[k]));
    if (weight(k) > 0 && visibility.is_hidden(triangles[k], clearance)) weight(k) = 0;
  }
  return weight;
}

}  // namespace reflines
