// Checked conversion of integers from Python: triangles, faces, partners, codes. numpy's own casts would silently
// truncate fractions and wrap numbers too large for an int, and so name another vertex.
#pragma once

#include <pybind11/numpy.h>

#include <string>

#include "reflines/types.h"

namespace reflines {

class Indices : public pybind11::array_t<int, pybind11::array::c_style> {
  using pybind11::array_t<int, pybind11::array::c_style>::array_t;
};

// Converts an array of integers of any kind and shape; an empty one may be of any kind. Throws InvalidInput: numbers
// that are no integers, integers that do not fit an int.
Indices indices_of(const pybind11::array& array);

IndexVector index_vector(const Indices& indices);

// Throws InvalidInput where the array is not #F x 3.
Triangles triangles_of(const Indices& indices);

// Throws InvalidInput where the array is not #E x 2.
Edges edges_of(const Indices& indices);

}  // namespace reflines

namespace pybind11::detail {

template <>
struct type_caster<reflines::Indices> {
  PYBIND11_TYPE_CASTER(reflines::Indices, const_name("numpy.ndarray[int]"));

  bool load(handle source, bool) {
    if (isinstance<str>(source)) return false;
    const array any = array::ensure(source);
    if (!any) return false;
    value = reflines::indices_of(any);
    return true;
  }

  static handle cast(const reflines::Indices& source, return_value_policy, handle) { return source.inc_ref(); }
};

}  // namespace pybind11::detail
