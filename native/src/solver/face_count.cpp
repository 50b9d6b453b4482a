#include "solver/face_count.h"

#include <algorithm>
#include <vector>

namespace reflines {

int count_faces(const Mask& triangles, const IndexVector& face_of_triangle) {
  if (face_of_triangle.size() == 0) return static_cast<int>(triangles.count());
  std::vector<int> faces;
  for (Eigen::Index t = 0; t < triangles.size(); ++t) {
    if (triangles(t)) faces.push_back(face_of_triangle(t));
  }
  std::sort(faces.begin(), faces.end());
  return static_cast<int>(std::unique(faces.begin(), faces.end()) - faces.begin());
}

}  // namespace reflines
