#include "reflines/warp_target.h"

#include <cmath>
#include <optional>
#include <vector>

#include "geometry/triangle_locator.h"
#include "reflection/reflection_function.h"
#include "reflection/scalar_gradient.h"
#include "reflines/errors.h"
#include "targets/line_reader.h"

namespace reflines {
namespace {

constexpr int kMostNodes = 100'000'000;  // twice as many triangles, and three times that many corners, fit an int

Vector2 rest(const WarpGrid& grid, int i, int j) {
  return grid.low + (grid.high - grid.low).cwiseProduct(Vector2(double(i) / grid.columns, double(j) / grid.rows));
}

// Checks the grid before anything of its size is allocated.
void check_grid(const WarpGrid& grid) {
  const Eigen::Index nodes = (Eigen::Index(grid.columns) + 1) * (Eigen::Index(grid.rows) + 1);
  if (grid.columns < 1 || grid.rows < 1 || grid.position.rows() != nodes || nodes > kMostNodes ||
      !grid.position.allFinite() || !(grid.high - grid.low).allFinite() || !((grid.high - grid.low).minCoeff() > 0)) {
    throw InvalidInput("The warp needs (columns + 1) x (rows + 1) finite positions, " + std::to_string(kMostNodes) +
                       " at most, over a rectangle of positive size; there are " +
                       std::to_string(grid.position.rows()) + " for " + std::to_string(grid.columns) + " columns and " +
                       std::to_string(grid.rows) + " rows.");
  }
}

Triangles grid_triangles(const WarpGrid& grid) {
  Triangles F(2 * grid.columns * grid.rows, 3);
  for (int j = 0, t = 0; j < grid.rows; ++j) {
    for (int i = 0; i < grid.columns; ++i) {
      const int a = j * (grid.columns + 1) + i, above = a + grid.columns + 1;
      F.row(t++) << a, a + 1, above + 1;
      F.row(t++) << a, above + 1, above;
    }
  }
  return F;
}

void check_folds(const WarpGrid& grid, const Triangles& F) {
  int folded = 0;
  for (int t = 0; t < F.rows(); ++t) {
    const Vector2 a = grid.position.row(F(t, 0)), b = grid.position.row(F(t, 1)), c = grid.position.row(F(t, 2));
    folded += !((b - a).x() * (c - a).y() - (b - a).y() * (c - a).x() > 0);
  }
  if (folded == 0) return;
  throw InvalidInput("The lattice folds over itself (" + std::to_string(Eigen::Index(100) * folded / F.rows() + 1) +
                     " % of its area); move its points back until they no longer cross.");
}

// Returns w^-1(x) - x at the region's vertices (#V x 2).
PlanePositions invert_grid(const RegionField& field, const WarpGrid& grid) {
  check_grid(grid);
  const Triangles F = grid_triangles(grid);
  check_folds(grid, F);
  PlanePositions shift(grid.position.rows(), 2);
  for (int j = 0; j <= grid.rows; ++j) {
    for (int i = 0; i <= grid.columns; ++i) {
      const int node = j * (grid.columns + 1) + i;
      shift.row(node) = rest(grid, i, j).transpose() - grid.position.row(node);
    }
  }
  const TriangleLocator locator(grid.position, F);
  PlanePositions result = PlanePositions::Zero(field.xy.rows(), 2);
#pragma omp parallel for schedule(static)
  for (int v = 0; v < static_cast<int>(field.xy.rows()); ++v) {
    const Location at = locator.locate(field.xy.row(v));
    if (at.triangle < 0) continue;
    for (int i = 0; i < 3; ++i) result.row(v) += at.barycentric(i) * shift.row(F(at.triangle, i));
  }
  return result;
}

// Adds the gradient of `delta` (#V) to the field; triangles with an `unknown` vertex keep theirs, with little weight.
WarpResult add_difference(const RegionField& field, const Vector& delta, const Mask& unknown, bool by_value) {
  const int triangles = static_cast<int>(field.F.rows());
  WarpResult result{{field.gradient, Vector::Ones(triangles), {}, field.family, true}, 0};
  if (by_value) result.target.theta = Vector::Zero(triangles);
  for (int t = 0; t < triangles; ++t) {
    if (!field.active(t)) continue;
    if (by_value) result.target.theta(t) = field.theta(t);
    const double response = field.response(t);
    if (response == 0) continue;
    const int a = field.F(t, 0), b = field.F(t, 1), c = field.F(t, 2);
    const double db = wrap_angle(delta(b) - delta(a)), dc = wrap_angle(delta(c) - delta(a));
    const bool known = !unknown(a) && !unknown(b) && !unknown(c);
    result.outside += !known;
    if (!known) result.target.weight(t) = kOutsideWeight;
    if (known)
      result.target.gradient.row(t) += response * linear_gradient(field.xy, field.F.row(t), db, dc).transpose();
    if (by_value)
      result.target.theta(t) = wrap_angle(field.theta(t) + response * delta(a) + response * (db + dc) / 3.0);
  }
  return result;
}

// Returns the piece of each vertex (#V); -1 where several meet: theta at the vertex is a mean over both sides of a
// crease.
Eigen::VectorXi piece_of_vertices(const RegionField& field) {
  constexpr int kNone = -2;
  Eigen::VectorXi piece = Eigen::VectorXi::Constant(field.xy.rows(), kNone);
  for (int t = 0; t < field.F.rows(); ++t) {
    if (!field.active(t)) continue;
    for (int v : field.F.row(t)) piece(v) = piece(v) == kNone || piece(v) == field.piece(t) ? field.piece(t) : -1;
  }
  return piece;
}

// Finds the triangles in which lines can be read: smooth ones, away from creases.
class LineSource {
 public:
  explicit LineSource(const RegionField& field) : piece_(piece_of_vertices(field)) {
    active_.resize(field.F.rows(), 3);
    for (int t = 0; t < field.F.rows(); ++t) {
      if (!field.active(t)) continue;
      active_.row(static_cast<int>(number_.size())) = field.F.row(t);
      number_.push_back(t);
    }
    active_.conservativeResize(static_cast<int>(number_.size()), 3);
    locator_.emplace(field.xy, active_);
  }

  // Locates `point` for vertex v; triangle -1 where it lies outside, on a feature, or in another piece than v.
  Location locate(const RegionField& field, int v, const Vector2& point) const {
    Location at = locator_->locate(point);
    if (at.triangle < 0) return at;
    at.triangle = number_[at.triangle];
    bool smooth = !field.feature(at.triangle) && piece_(v) >= 0;
    for (int corner : field.F.row(at.triangle)) smooth = smooth && piece_(corner) == piece_(v);
    if (!smooth) at.triangle = -1;
    return at;
  }

 private:
  Eigen::VectorXi piece_;    // #V
  Triangles active_;         // the locator's
  std::vector<int> number_;  // of each of them in the region
  std::optional<TriangleLocator> locator_;
};

}  // namespace

WarpResult build_warp_target(const RegionField& field, const WarpGrid& grid, bool by_value) {
  const PlanePositions shift = invert_grid(field, grid);
  const LineSource lines(field);
  Vector delta = Vector::Zero(field.xy.rows());
  Mask outside = Mask::Constant(field.xy.rows(), false);
  for (int v = 0; v < static_cast<int>(field.xy.rows()); ++v) {
    if (shift.row(v).isZero(0.0)) continue;
    const Vector2 source = (field.xy.row(v) + shift.row(v)).transpose();
    const Location at = lines.locate(field, v, source);
    outside(v) = at.triangle < 0;
    if (!outside(v)) delta(v) = evaluate_theta_near(field, at, source, field.vertex_theta(v));
  }
  return add_difference(field, delta, outside, by_value);
}

}  // namespace reflines
