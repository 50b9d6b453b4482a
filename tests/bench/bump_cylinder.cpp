#include "tests/bench/bump_cylinder.h"

#include <cmath>
#include <numbers>
#include <random>

#include "reflection/element.h"

namespace reflines::bench {
namespace {

constexpr double kBumpHeight = 0.03;
constexpr double kBumpRadius = 0.3;
constexpr double kJitter = 0.2;

const Vector3 kView = Vector3::UnitZ();
const Vector3 kLines(0.0, std::cos(std::numbers::pi / 9), std::sin(std::numbers::pi / 9));

// A polynomial bump (1 - s)^4 of s = r^2 / radius^2: three continuous derivatives, and closed forms for all that is
// needed.
struct Height {
  double z;
  Vector5 derivatives;  // f_x, f_y, f_xx, f_xy, f_yy
};

Height height(double x, double y, double bump) {
  const double root = std::sqrt(1 - x * x);
  Height h{root, Vector5::Zero()};
  h.derivatives << -x / root, 0, -1 / (root * root * root), 0, 0;
  const double scale = 1 / (kBumpRadius * kBumpRadius), s = (x * x + y * y) * scale;
  if (s >= 1) return h;
  const double c = bump * kBumpHeight, rest = 1 - s;
  const double first = -4 * c * rest * rest * rest * 2 * scale;    // f_x = first * x
  const double second = 12 * c * rest * rest * 4 * scale * scale;  // f_xx = first + second * x^2
  h.z += c * rest * rest * rest * rest;
  Vector5 own;
  own << first * x, first * y, first + second * x * x, second * x * y, first + second * y * y;
  h.derivatives += own;
  return h;
}

}  // namespace

BumpCylinder::BumpCylinder(int cells) : xy_((cells + 1) * (cells + 1), 2), F_(2 * cells * cells, 3) {
  std::mt19937 random(7);
  const auto uniform = [&random] {
    return random() / 4294967296.0;
  };  // the library's distributions differ between compilers
  for (int j = 0; j <= cells; ++j) {
    for (int i = 0; i <= cells; ++i) {
      const bool inner = i > 0 && i < cells && j > 0 && j < cells;
      const double dx = kJitter * (2 * uniform() - 1), dy = kJitter * (2 * uniform() - 1);
      xy_.row(j * (cells + 1) + i) << (i + inner * dx) / cells - 0.5, (j + inner * dy) / cells - 0.5;
    }
  }
  for (int j = 0, t = 0; j < cells; ++j) {
    for (int i = 0; i < cells; ++i) {
      const int a = j * (cells + 1) + i, b = a + 1, c = a + cells + 2, d = a + cells + 1;
      const bool rising = uniform() < 0.5;
      F_.row(t++) << a, b, (rising ? c : d);
      F_.row(t++) << (rising ? a : b), c, d;
    }
  }
}

Positions BumpCylinder::positions(double bump) const {
  Positions V(xy_.rows(), 3);
  for (Eigen::Index v = 0; v < V.rows(); ++v) V.row(v) << xy_(v, 0), xy_(v, 1), height(xy_(v, 0), xy_(v, 1), bump).z;
  return V;
}

Target BumpCylinder::target(double bump) const {
  const ReflectionFunction reflection(ImagePlane(kView, kLines), kView, kLines);
  Target target;
  target.gradient.resize(F_.rows(), 2);
  for (Eigen::Index t = 0; t < F_.rows(); ++t) {
    const Vector2 centroid = (xy_.row(F_(t, 0)) + xy_.row(F_(t, 1)) + xy_.row(F_(t, 2))) / 3;
    const Vector5 u = height(centroid.x(), centroid.y(), bump).derivatives;
    target.gradient.row(t) = theta_gradient(reflection.derivatives(u(0), u(1), 1), u);
  }
  return target;
}

std::unique_ptr<ShapeOptimizer> BumpCylinder::optimizer(double bump) const {
  return std::make_unique<ShapeOptimizer>(positions(bump), F_, kView, std::vector<Vector3>{kLines});
}

int cells_for_unknowns(int unknowns) { return static_cast<int>(std::lround(std::sqrt(unknowns))) + 3; }

}  // namespace reflines::bench
