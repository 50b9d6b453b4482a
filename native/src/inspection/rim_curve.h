// The rims of a surface as curves through the vertices of its border.
#pragma once

#include <array>
#include <limits>
#include <optional>
#include <vector>

#include "geometry/nearest_surface.h"
#include "reflines/types.h"

namespace reflines {

// A piece of a rim: the cubic through four of its vertices, between the two in the middle. Beside a corner or an end of
// the rim there are three or two of them.
class RimPiece {
 public:
  // The two vertices in the middle come first.
  RimPiece(const Vector3& first, const Vector3& second, const std::optional<Vector3>& before,
           const std::optional<Vector3>& after);

  Vector3 at(double fraction) const;                // 0: the first of the two in the middle, 1: the second
  double find_nearest(const Vector3& point) const;  // the fraction, in 0 .. 1

 private:
  int count_ = 0;
  std::array<Vector3, 4> points_;
  std::array<double, 4> knots_{};
};

struct RimFoot {
  Vector3 place = Vector3::Zero();
  Vector3 along = Vector3::Zero();  // unit direction of the rim there
  double distance = std::numeric_limits<double>::infinity();
  int triangle = -1;
};

class RimCurve {
 public:
  // Takes those of the triangles F (#F x 3) that are `chosen`, with the triangles across their edges (#F x 3), by
  // reference.
  RimCurve(const Positions& V, const Triangles& F, const Triangles& neighbors, const std::vector<int>& chosen);
  RimCurve(const RimCurve&) = delete;  // the tree refers to it
  RimCurve& operator=(const RimCurve&) = delete;

  // Returns the piece between two neighbouring vertices of the rim.
  RimPiece piece(int first, int second) const;

  // Finds the nearest place of the rims, no further than `within`.
  std::optional<RimFoot> find(const Vector3& point, double within) const;

 private:
  std::optional<Vector3> beyond(int from, int at, const std::vector<int>& step) const;

  const Positions& V_;
  Triangles edges_;               // first, second, second
  std::vector<int> triangles_;    // of each edge
  std::vector<int> next_, last_;  // #V: the vertices before and after along the rim; -1: none, or several
  std::optional<NearestSurface> tree_;
};

}  // namespace reflines
