#include "python/index_arrays.h"

#include <cstdint>
#include <limits>

#include "reflines/errors.h"

namespace py = pybind11;

namespace reflines {
namespace {

using Wide = py::array_t<std::int64_t, py::array::c_style | py::array::forcecast>;

void check_range(const Wide& wide, bool is_unsigned) {
  const std::int64_t low = is_unsigned ? 0 : std::numeric_limits<int>::min();  // 2^63 and more wrap to less than 0
  for (py::ssize_t k = 0; k < wide.size(); ++k) {
    const std::int64_t index = wide.data()[k];
    if (index >= low && index <= std::numeric_limits<int>::max()) continue;
    throw InvalidInput("Index " + std::to_string(k) + " of an array of indices is " +
                       (is_unsigned ? std::to_string(static_cast<std::uint64_t>(index)) : std::to_string(index)) +
                       ", beyond the range of 32 bits; number the vertices from 0.");
  }
}

}  // namespace

Indices indices_of(const py::array& array) {
  const char kind = array.dtype().kind();
  if (array.size() > 0 && kind != 'i' && kind != 'u') {
    throw InvalidInput("Indices are whole numbers, but an array of " + std::string(py::str(array.dtype())) +
                       " was given; convert it with astype(int).");
  }
  if (array.size() > 0 && array.itemsize() >= py::ssize_t(sizeof(int))) check_range(Wide(array), kind == 'u');
  return Indices(py::array_t<int, py::array::c_style | py::array::forcecast>(array));
}

IndexVector index_vector(const Indices& indices) {
  return Eigen::Map<const IndexVector>(indices.data(), indices.size());
}

Triangles triangles_of(const Indices& indices) {
  if (indices.size() > 0 && (indices.ndim() != 2 || indices.shape(1) != 3)) {
    throw InvalidInput("The triangles must be an array of 3 columns, the vertices of each: reshape it.");
  }
  return Eigen::Map<const Triangles>(indices.data(), indices.size() / 3, 3);
}

Edges edges_of(const Indices& indices) {
  if (indices.size() > 0 && (indices.ndim() != 2 || indices.shape(1) != 2)) {
    throw InvalidInput("The creases must be an array of 2 columns, the vertices of an edge: reshape it.");
  }
  return Eigen::Map<const Edges>(indices.data(), indices.size() / 2, 2);
}

}  // namespace reflines
