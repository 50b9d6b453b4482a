// Converts cages and the options of their subdivision from numpy arrays and names.
#pragma once

#include <pybind11/numpy.h>

#include <optional>
#include <string>
#include <vector>

#include "python/border_codes.h"
#include "python/index_arrays.h"
#include "reflines/cage_optimizer.h"
#include "reflines/subdivision.h"
#include "reflines/types.h"

namespace reflines {

using Numbers = pybind11::array_t<double, pybind11::array::c_style | pybind11::array::forcecast>;

// The arrays and names from which Python describes a cage; empty arrays where there are no creases or corners.
struct CageArrays {
  Indices face_offsets, face_vertices, creases;
  Numbers crease_sharpness;
  Indices corners;
  Numbers corner_sharpness;
};

Cage cage_of(const CageArrays& arrays, int vertices);
SubdivisionOptions subdivision_options(int level, const std::string& scheme, const std::string& boundary, bool limit);

// Reads what of a cage may move; the other options keep their defaults.
CageOptions cage_options_of(const std::optional<Mask>& region, const Codes& border, Eigen::Index vertices,
                            const std::optional<Mask>& fixed, const std::optional<Indices>& partner);

}  // namespace reflines
