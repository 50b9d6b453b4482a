#include "geometry/bend_contrast.h"

#include <Eigen/Geometry>
#include <algorithm>
#include <limits>
#include <vector>

namespace reflines {
namespace {

// The smallest width relative to the larger triangle's height, and the growth of the widths. The first is large enough
// that on equal quads each strip beside the edge holds an edge of the same kind.
constexpr double kFirstWidth = 1.2, kWidthGrowth = 1.5;
// The width of a strip beside, relative to the strip in the middle. On equal quads of step 1 and a width slightly above
// 2 the middle holds 3 edges, and a strip of equal width beside it 1 or 2.
constexpr double kBeside = 1.5;
// The limit of crossings of a walk, for a very fine mesh beside a very coarse triangle.
constexpr int kMostCrossings = 1000;
// The least turning, relative to the bend of the edge, of a side where the surface ends within the window: the part
// that exists may prove a round shape, the missing part proves nothing.
constexpr double kTellingFraction = 0.25;

struct Crossing {
  double distance, turning;  // distance from the edge; radians
};

struct Path {
  std::vector<Crossing> crossings;
  double length = 0.0;  // distance to the end of the surface
};

Vector3 edge_direction(const BentSurface& surface, int t, int i) {
  return (surface.V.row(surface.F(t, (i + 2) % 3)) - surface.V.row(surface.F(t, (i + 1) % 3))).normalized();
}

double measure_height(const BentSurface& surface, int t, int i) {
  const Vector3 start = surface.V.row(surface.F(t, (i + 1) % 3)), apex = surface.V.row(surface.F(t, i));
  return edge_direction(surface, t, i).cross(apex - start).norm();
}

// A straight walk over the surface, unfolded triangle by triangle.
class Walk {
 public:
  // Starts in t at the middle of the edge opposite corner i, at right angles to it.
  Walk(const BentSurface& surface, int t, int i) : surface_(surface), t_(t), entry_(i) {
    const Vector3 normal = surface.normals.row(t);
    direction_ = normal.cross(edge_direction(surface, t, i));
    place_ = 0.5 * (surface.V.row(surface.F(t, (i + 1) % 3)) + surface.V.row(surface.F(t, (i + 2) % 3)));
  }

  Path go(double distance) {
    Path path;
    for (int k = 0; k < kMostCrossings; ++k) {
      const int exit = next_exit();
      if (exit < 0 || path.length + step_ >= distance) break;
      path.length += step_;
      if (surface_.neighbors(t_, exit) < 0) return path;
      path.crossings.push_back({path.length, cross(exit)});
    }
    path.length = distance;
    return path;
  }

 private:
  // Returns the corner opposite the edge through which the walk leaves t, and sets step_ to the distance to that edge;
  // returns -1 where the walk meets a vertex.
  int next_exit() {
    const Vector3 normal = surface_.normals.row(t_);
    int exit = -1;
    step_ = std::numeric_limits<double>::infinity();
    for (int i = 0; i < 3; ++i) {
      if (i == entry_) continue;
      const Vector3 outward = edge_direction(surface_, t_, i).cross(normal);
      const double rate = direction_.dot(outward);
      if (rate <= 0) continue;
      const Vector3 start = surface_.V.row(surface_.F(t_, (i + 1) % 3));
      const double distance = std::max(outward.dot(start - place_) / rate, 0.0);
      if (distance < step_) exit = i;
      step_ = std::min(step_, distance);
    }
    return exit;
  }

  // Enters the next triangle and returns the angle by which the walk's direction turns.
  double cross(int exit) {
    const Vector3 edge = edge_direction(surface_, t_, exit);
    const double along = direction_.dot(edge), across = direction_.dot(edge.cross(Vector3(surface_.normals.row(t_))));
    const double turning = surface_.bend(t_, exit) * across;
    const int next = surface_.neighbors(t_, exit);
    place_ += step_ * direction_;
    direction_ = (along * edge + across * edge.cross(Vector3(surface_.normals.row(next)))).normalized();
    entry_ = find_facing_corner(surface_.F, surface_.neighbors, t_, exit);
    t_ = next;
    return turning;
  }

  const BentSurface& surface_;
  int t_, entry_;
  double step_ = 0.0;
  Vector3 place_, direction_;
};

double measure_turning(const Path& path, double from, double to) {
  double sum = 0;
  for (const Crossing& crossing : path.crossings) {
    if (crossing.distance >= from && crossing.distance < to) sum += crossing.turning;
  }
  return sum;
}

double measure_contrast(const Path (&sides)[2], double bend, double width) {
  double inside = bend, beside = -1;
  for (const Path& side : sides) {
    inside += measure_turning(side, 0, 0.5 * width);
    const double turning = measure_turning(side, 0.5 * width, (0.5 + kBeside) * width);
    if (side.length >= (0.5 + kBeside) * width || turning > kTellingFraction * bend) beside = std::max(beside, turning);
  }
  if (beside < 0) return -1;
  return beside > 0 ? inside / beside : std::numeric_limits<double>::infinity();
}

}  // namespace

int find_facing_corner(const Triangles& F, const Triangles& neighbors, int t, int i) {
  const int other = neighbors(t, i), start = F(t, (i + 1) % 3), end = F(t, (i + 2) % 3);
  int corner = 0;
  while (F(other, corner) == start || F(other, corner) == end) ++corner;
  return corner;
}

double bend_contrast(const BentSurface& surface, int t, int i, double widest) {
  const int other = surface.neighbors(t, i), facing = find_facing_corner(surface.F, surface.neighbors, t, i);
  const double first = kFirstWidth * std::max(measure_height(surface, t, i), measure_height(surface, other, facing));
  const double distance = (0.5 + kBeside) * std::max(first, widest);
  const Path sides[2] = {Walk(surface, t, i).go(distance), Walk(surface, other, facing).go(distance)};
  double largest = -1;
  for (double width = first; width <= std::max(first, widest); width *= kWidthGrowth) {
    largest = std::max(largest, measure_contrast(sides, surface.bend(t, i), width));
  }
  return largest;
}

}  // namespace reflines
