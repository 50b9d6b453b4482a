#include "native/bindings/cage_arrays.h"

#include "native/bindings/names.h"
#include "native/errors.h"

namespace reflines {
namespace {

Vector number_vector(const Numbers& array) { return Eigen::Map<const Vector>(array.data(), array.size()); }

}  // namespace

Cage cage_of(const CageArrays& arrays, int vertices) {
  const Indices& creases = arrays.creases;
  if (creases.size() > 0 && (creases.ndim() != 2 || creases.shape(1) != 2)) {
    throw InvalidInput("The creases must be an array of 2 columns, the vertices of an edge: reshape it.");
  }
  Cage cage;
  cage.vertices = vertices;
  cage.face_offsets = index_vector(arrays.face_offsets);
  cage.face_vertices = index_vector(arrays.face_vertices);
  cage.creases = Eigen::Map<const decltype(cage.creases)>(creases.data(), creases.size() / 2, 2);
  cage.crease_sharpness = number_vector(arrays.crease_sharpness);
  cage.corners = index_vector(arrays.corners);
  cage.corner_sharpness = number_vector(arrays.corner_sharpness);
  return cage;
}

SubdivisionOptions subdivision_options(int level, const std::string& scheme, const std::string& boundary, bool limit) {
  return {named(kSchemes, scheme, "subdivision scheme"), named(kBoundaries, boundary, "boundary rule"), level, limit};
}

}  // namespace reflines
