// Counts triangles and vertices of a region by their roles, and formats the counts as sentences for the user.
#pragma once

#include <string>

#include "geometry/height_field.h"
#include "reflines/region.h"

namespace reflines {

// Returns the counts and messages that follow from the height field. `creases_held`: creases are fixed; else they move
// with their vertices, as on the surface of a cage.
Region describe_region(const HeightField& field, bool creases_held);

// Adds the messages on unused pieces and hidden triangles, once those are counted.
void add_piece_messages(Region& region);

// Returns a sentence why no vertex is free, beginning with `what`. `doubled`: vertices that lie on others.
std::string explain_no_free_vertex(const Region& region, const std::string& what, int doubled);

// Sets the count of features and replaces the message on the previous count.
void set_feature_count(int count, Region& region);

// Formats a count: "1 face", "2 faces".
std::string format_face_count(int count);

}  // namespace reflines
