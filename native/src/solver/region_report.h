// Counts what became of the triangles and vertices of a region, and says it in sentences for the user.
#pragma once

#include <string>

#include "geometry/height_field.h"
#include "reflines/region.h"

namespace reflines {

// The counts and messages that follow from the height field. `creases_held`: creases are fixed; else they move with
// what moves their vertices, as on the surface of a cage.
Region describe_region(const HeightField& field, bool creases_held);

// Adds the messages on unused pieces and hidden triangles, once those are counted.
void add_piece_messages(Region& region);

// Says why no vertex is free; `what` is said before the reasons.
std::string explain_no_free_vertex(const Region& region, const std::string& what);

// Sets the count of features and replaces the message on the count before.
void set_feature_count(int count, Region& region);

// "1 face", "2 faces".
std::string format_face_count(int count);

}  // namespace reflines
