// The counts of a region's faces and vertices by what the optimizer does with them.
#pragma once

#include <vector>

#include "reflines/note.h"

namespace reflines {

struct Region {
  int triangles = 0;  // in height-field pieces
  int free = 0, fixed = 0, clamped = 0;
  int pieces = 0;
  // Faces are those that triangles were cut from (see ShapeOptions::face_of_triangle); one counts where any of its
  // triangles does.
  int silhouettes = 0;      // faces left out, seen at less than 12 degrees: |n.v| < 0.2
  int turned_away = 0;      // faces left out, turned away: n.v <= -0.2
  int unused_pieces = 0;    // pieces without a free vertex
  int creases = 0;          // edges held as creases
  int marked_creases = 0;   // those of them that were marked
  int hidden = 0;           // faces of reduced weight: their reflected ray is nearly parallel to the lines
  int features = 0;         // faces whose lines the tools keep: extended strong bends (see strong_features)
  bool closed = false;      // the region has no border edge
  std::vector<Note> notes;  // what of it is left as it is, and where the border is not as asked for
};

}  // namespace reflines
