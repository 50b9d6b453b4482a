#include "python/cage_arrays.h"

#include "python/option_names.h"

namespace reflines {
namespace {

Vector number_vector(const Numbers& array) { return Eigen::Map<const Vector>(array.data(), array.size()); }

}  // namespace

Cage cage_of(const CageArrays& arrays, int vertices) {
  Cage cage;
  cage.vertices = vertices;
  cage.face_offsets = index_vector(arrays.face_offsets);
  cage.face_vertices = index_vector(arrays.face_vertices);
  cage.creases = edges_of(arrays.creases);
  cage.crease_sharpness = number_vector(arrays.crease_sharpness);
  cage.corners = index_vector(arrays.corners);
  cage.corner_sharpness = number_vector(arrays.corner_sharpness);
  return cage;
}

SubdivisionOptions subdivision_options(int level, const std::string& scheme, const std::string& boundary, bool limit) {
  return {find_named(kSchemes, scheme, "subdivision scheme"), find_named(kBoundaries, boundary, "boundary rule"), level,
          limit};
}

CageOptions cage_options_of(const std::optional<Mask>& region, const Codes& border, Eigen::Index vertices,
                            const std::optional<Mask>& fixed, const std::optional<Indices>& partner) {
  CageOptions options;
  if (region) options.region = *region;
  options.border = border_codes(border, vertices);
  if (fixed) options.held = *fixed;
  if (partner) options.partner = index_vector(*partner);
  return options;
}

}  // namespace reflines
