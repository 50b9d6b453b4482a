// Counts faces, triangles and vertices of a region by their roles, and tells which faces and edges stay as they are.
#pragma once

#include <string>

#include "geometry/height_field.h"
#include "reflines/region.h"
#include "reflines/types.h"

namespace reflines {

// Returns the number of faces as the artist has them, from which triangles in the mask (#F) were cut.
// `face_of_triangle`: see ShapeOptions.
int count_faces(const Mask& triangles, const IndexVector& face_of_triangle);

// Returns the counts and notes that follow from the height field. `face_of_triangle`: see ShapeOptions.
// `creases_held`: creases are fixed; else they move with their vertices, as on the surface of a cage.
Region describe_region(const HeightField& field, const IndexVector& face_of_triangle, bool creases_held);

// Adds the notes on unused pieces and hidden faces, once those are counted.
void add_piece_notes(Region& region);

// Adds a note for each eye that sees nothing of the region; `sight` (#F) is that of each, see Families.
void add_eye_notes(const std::vector<Vector>& sight, Region& region);

// Returns a sentence why no vertex of a region of so many faces is free. `doubled`: vertices that lie on others.
std::string explain_no_free_vertex(const Region& region, int faces, int doubled);

// Sets the count of features and replaces the note on the previous count.
void set_feature_count(int count, Region& region);

}  // namespace reflines
