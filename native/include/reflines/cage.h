// The cage of a subdivision surface: polygons, creases and corners as the artist models them.
#pragma once

#include <array>
#include <vector>

#include "reflines/types.h"

namespace reflines {

// The sharpness from which creases and corners stay sharp at every level; 0 is smooth. Blender's crease c in [0, 1] is
// the sharpness 10 c^2.
inline constexpr double kSharp = 10.0;

struct Cage {
  int vertices = 0;           // #V; vertices in no face are allowed
  IndexVector face_offsets;   // #F + 1: face f is face_vertices[offsets[f] .. offsets[f + 1])
  IndexVector face_vertices;  // corners of all faces, counter-clockwise seen from outside
  Edges creases;              // #C x 2, edges of the cage in either direction
  Vector crease_sharpness;    // #C
  IndexVector corners;        // #K vertices
  Vector corner_sharpness;    // #K
};

struct CageEdge {
  int first, second;  // vertices, first < second
  int faces;          // 1 on the border, 2 inside, more where the cage is not manifold
};

// Returns every edge of the faces once, sorted by (first, second).
std::vector<CageEdge> cage_edges(const Cage& cage);

// Builds the cage with one quad (or triangle) for each row of `quads`, without creases and corners.
Cage cage_from_faces(int vertices, const Eigen::MatrixXi& faces);

// Throws InvalidInput: no face, offsets that do not fit, a face with fewer than 3 vertices or with a vertex twice, an
// index out of range, a crease that is no edge, a sharpness that is negative or not a number.
void check_cage(const Cage& cage);

}  // namespace reflines
