#include "reflines/subdivision.h"

#include <pybind11/numpy.h>
#include <pybind11/pybind11.h>

#include <memory>
#include <string>

#include "python/array_arguments.h"
#include "python/bind.h"
#include "python/cage_arrays.h"
#include "python/native_call.h"
#include "reflines/errors.h"

namespace reflines {
namespace {

namespace py = pybind11;
using py::literals::operator""_a;
using RowMatrix = Eigen::SparseMatrix<double, Eigen::RowMajor, int>;

// A subdivided cage with the number of the cage's vertices.
struct SubdividedCage {
  int vertices;
  Subdivision result;
};

using BuildSubdivision = std::function<std::unique_ptr<SubdividedCage>()>;

BuildSubdivision prepare_subdivision(const Indices& face_offsets, const Indices& face_vertices, int vertices, int level,
                                     const std::string& scheme, const std::string& boundary, const Indices& creases,
                                     const Numbers& crease_sharpness, const Indices& corners,
                                     const Numbers& corner_sharpness, bool limit) {
  const Cage cage =
      cage_of({face_offsets, face_vertices, creases, crease_sharpness, corners, corner_sharpness}, vertices);
  const SubdivisionOptions options = subdivision_options(level, scheme, boundary, limit);
  return [=] { return std::make_unique<SubdividedCage>(SubdividedCage{vertices, subdivide(cage, options)}); };
}

Positions cage_positions(const SubdividedCage& cage, const Numbers& V) {
  if (V.ndim() != 2 || V.shape(0) != cage.vertices || V.shape(1) != 3) {
    throw InvalidInput("The positions are not an array of " + std::to_string(cage.vertices) +
                       " rows, the cage's vertices, and 3 columns: give one row for each.");
  }
  return Eigen::Map<const Positions>(V.data(), V.shape(0), 3);
}

Positions positions(const SubdividedCage& cage, const Numbers& V) {
  return cage.result.positions * cage_positions(cage, V);
}

Positions normals(const SubdividedCage& cage, const Numbers& V) {
  return limit_normals(cage.result, cage_positions(cage, V));
}

// Returns (data, indices, indptr), the arguments of scipy.sparse.csr_matrix.
py::tuple matrix(const SubdividedCage& cage) {
  const RowMatrix rows = cage.result.positions;
  return py::make_tuple(py::array_t<double>(rows.nonZeros(), rows.valuePtr()),
                        py::array_t<int>(rows.nonZeros(), rows.innerIndexPtr()),
                        py::array_t<int>(rows.rows() + 1, rows.outerIndexPtr()));
}

}  // namespace

void bind_subdivision(py::module_& module) {
  const SubdivisionOptions defaults;
  py::class_<SubdividedCage> subdivision(module, "Subdivision", py::module_local());
  const auto define = [&](const auto&... arguments) {
    subdivision.def(py::init(construct(&prepare_subdivision)), arguments...);
    subdivision.def_static("create", create(&prepare_subdivision), arguments...);
  };
  define("face_offsets"_a, "face_vertices"_a, py::kw_only(), "vertices"_a, "level"_a = defaults.level,
         "scheme"_a = "catmull_clark", "boundary"_a = "all", "creases"_a = Indices(), "crease_sharpness"_a = Numbers(),
         "corners"_a = Indices(), "corner_sharpness"_a = Numbers(), "limit"_a = defaults.limit);
  subdivision.def_property_readonly("faces", [](const SubdividedCage& cage) { return cage.result.faces; })
      .def_property_readonly("face_parent", [](const SubdividedCage& cage) { return cage.result.face_parent; })
      .def("positions", &positions, "V"_a)
      .def("normals", &normals, "V"_a)
      .def("matrix", &matrix);
}

}  // namespace reflines
