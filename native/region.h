// What became of the triangles and vertices that were handed in: counts, and sentences for the user.
#pragma once

#include <string>
#include <vector>

#include "native/geometry/height_field.h"

namespace reflines {

struct Region {
  int triangles = 0;  // in height-field pieces
  int free = 0, fixed = 0, clamped = 0;
  int pieces = 0;
  int silhouettes = 0;                // triangles left out, |n.v| < 0.02
  int turned_away = 0;                // triangles left out, n.v < 0
  int unused_pieces = 0;              // pieces without a free vertex
  int creases = 0;                    // edges held because they bend by more than the crease angle
  int hidden = 0;                     // triangles of less weight: their reflected ray is nearly parallel to the lines
  int features = 0;                   // triangles the tools leave alone: strong bends that run on (see strong_features)
  bool closed = false;                // the region has no border edge
  std::vector<std::string> messages;  // sentences for the user
};

// `creases_held`: they are; else they move with what moves their vertices, as on the surface of a cage.
Region describe(const HeightField& field, bool creases_held);

// Once the pieces are made and their counts known.
void tell_pieces(Region& region);

// Takes the place of what was told of another count.
void tell_features(int count, Region& region);

std::string count_of_faces(int count);  // "1 face", "2 faces"

}  // namespace reflines
