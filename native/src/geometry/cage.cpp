#include "reflines/cage.h"

#include <algorithm>
#include <cmath>
#include <cstdint>
#include <string>

#include "reflines/errors.h"

namespace reflines {
namespace {

using std::to_string;

void check_offsets(const Cage& cage) {
  const IndexVector& offsets = cage.face_offsets;
  if (offsets.size() < 2) throw InvalidInput("The cage has no face: give at least one.");
  if (offsets[0] != 0 || offsets[offsets.size() - 1] != cage.face_vertices.size()) {
    throw InvalidInput("The face offsets run from " + to_string(offsets[0]) + " to " +
                       to_string(offsets[offsets.size() - 1]) + ": they must run from 0 to the number of corners, " +
                       to_string(cage.face_vertices.size()) + ".");
  }
  int small = 0, which = -1;
  for (int f = 0; f + 1 < offsets.size(); ++f) {
    if (std::int64_t{offsets[f + 1]} - offsets[f] >= 3) continue;
    ++small;
    if (which < 0) which = f;
  }
  if (small == 0) return;
  throw InvalidInput(to_string(small) + " faces of the cage have fewer than 3 vertices, the first is face " +
                     to_string(which) + ": delete them.");
}

void check_range(const IndexVector& indices, int vertices, const std::string& owner) {
  for (int i = 0; i < indices.size(); ++i) {
    if (indices[i] >= 0 && indices[i] < vertices) continue;
    throw InvalidInput(owner + " " + to_string(i) + " names vertex " + to_string(indices[i]) + " of a cage with " +
                       to_string(vertices) + " vertices: use indices from 0 to " + to_string(vertices - 1) + ".");
  }
}

void check_repeats(const Cage& cage) {
  std::vector<int> face;
  for (int f = 0; f + 1 < cage.face_offsets.size(); ++f) {
    const int* corners = cage.face_vertices.data();
    face.assign(corners + cage.face_offsets[f], corners + cage.face_offsets[f + 1]);
    std::sort(face.begin(), face.end());
    const auto twice = std::adjacent_find(face.begin(), face.end());
    if (twice == face.end()) continue;
    throw InvalidInput("Face " + to_string(f) + " of the cage uses vertex " + to_string(*twice) +
                       " twice: merge its doubled vertices or delete it.");
  }
}

void check_sharpness(const Vector& sharpness, int expected, const std::string& owner) {
  if (sharpness.size() != expected) {
    throw InvalidInput("There are " + to_string(expected) + " " + owner + "s but " + to_string(sharpness.size()) +
                       " sharpnesses: give one for each.");
  }
  for (int i = 0; i < sharpness.size(); ++i) {
    if (sharpness[i] >= 0) continue;  // false for NaN
    throw InvalidInput("The sharpness of " + owner + " " + to_string(i) + " is " + to_string(sharpness[i]) +
                       ": give a number from 0 (smooth) to 10 (sharp).");
  }
}

void check_creases(const Cage& cage) {
  const std::vector<CageEdge> edges = cage_edges(cage);
  const auto before = [](const CageEdge& a, const CageEdge& b) {
    return a.first != b.first ? a.first < b.first : a.second < b.second;
  };
  for (int c = 0; c < cage.creases.rows(); ++c) {
    const auto [first, second] = std::minmax(cage.creases(c, 0), cage.creases(c, 1));
    if (std::binary_search(edges.begin(), edges.end(), CageEdge{first, second, 0}, before)) continue;
    throw InvalidInput("Crease " + to_string(c) + " joins vertices " + to_string(first) + " and " + to_string(second) +
                       ", which is no edge of a face: remove it.");
  }
}

}  // namespace

std::vector<CageEdge> cage_edges(const Cage& cage) {
  std::vector<std::array<int, 2>> sides;
  sides.reserve(cage.face_vertices.size());
  for (int f = 0; f + 1 < cage.face_offsets.size(); ++f) {
    const int begin = cage.face_offsets[f], end = cage.face_offsets[f + 1];
    for (int i = begin; i < end; ++i) {
      const int a = cage.face_vertices[i], b = cage.face_vertices[i + 1 < end ? i + 1 : begin];
      sides.push_back({std::min(a, b), std::max(a, b)});
    }
  }
  std::sort(sides.begin(), sides.end());
  std::vector<CageEdge> edges;
  for (const auto& [first, second] : sides) {
    if (edges.empty() || edges.back().first != first || edges.back().second != second)
      edges.push_back({first, second, 0});
    ++edges.back().faces;
  }
  return edges;
}

Cage cage_from_faces(int vertices, const Eigen::MatrixXi& faces) {
  Cage cage;
  cage.vertices = vertices;
  cage.face_offsets = IndexVector::LinSpaced(faces.rows() + 1, 0, faces.size());
  cage.face_vertices = faces.transpose().reshaped();
  return cage;
}

void check_cage(const Cage& cage) {
  check_offsets(cage);
  check_range(cage.face_vertices, cage.vertices, "Face corner");
  check_repeats(cage);
  check_sharpness(cage.crease_sharpness, cage.creases.rows(), "crease");
  check_creases(cage);
  check_range(cage.corners, cage.vertices, "Corner");
  check_sharpness(cage.corner_sharpness, cage.corners.size(), "corner");
}

}  // namespace reflines
