// Finds the nearest point of a triangle mesh in space by a tree of bounding boxes.
#pragma once

#include <Eigen/Geometry>
#include <vector>

#include "reflines/types.h"

namespace reflines {

struct NearestPoint {
  int triangle = -1;  // -1: none within the distance
  Vector3 point = Vector3::Zero();
  double distance = 0;
  int compared = 0;  // triangles whose distance was computed
};

// Returns the point of the triangle a, b, c that is nearest to p; it may have no area.
Vector3 nearest_in_triangle(const Vector3& p, const Vector3& a, const Vector3& b, const Vector3& c);

class NearestSurface {
 public:
  // Takes V (#V x 3) and the triangles of F (#F x 3) named by `chosen`; V and F by reference.
  NearestSurface(const Positions& V, const Triangles& F, std::vector<int> chosen);
  NearestSurface(const Positions& V, const Triangles& F);  // all of F

  // Returns the nearest point among those no further than `within`, which may be infinite.
  NearestPoint find(const Vector3& point, double within) const;

 private:
  struct Node {
    Eigen::AlignedBox3d box;
    int begin, end;   // triangles order_[begin .. end)
    int second = -1;  // the first child follows its parent, this is the other; -1: a leaf
  };
  int build(int begin, int end);
  Vector3 corner(int t, int i) const { return V_.row(F_(t, i)); }

  const Positions& V_;
  const Triangles& F_;
  std::vector<int> order_;
  std::vector<Node> nodes_;
};

}  // namespace reflines
