#include "solver/face_count.h"

#include <vector>

#include "base/sort_unique.h"

namespace reflines {

int count_faces(const Mask& triangles, const IndexVector& face_of_triangle) {
  if (face_of_triangle.size() == 0) return static_cast<int>(triangles.count());
  std::vector<int> faces;
  for (Eigen::Index t = 0; t < triangles.size(); ++t) {
    if (triangles(t)) faces.push_back(face_of_triangle(t));
  }
  sort_unique(faces);
  return static_cast<int>(faces.size());
}

}  // namespace reflines
