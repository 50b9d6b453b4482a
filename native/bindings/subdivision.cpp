#include "native/geometry/subdivision.h"

#include <pybind11/eigen.h>
#include <pybind11/numpy.h>
#include <pybind11/pybind11.h>

#include <memory>
#include <string>

#include "native/bindings/bind.h"
#include "native/errors.h"

namespace reflines {
namespace {

namespace py = pybind11;
using py::literals::operator""_a;
using Indices = py::array_t<int, py::array::c_style | py::array::forcecast>;
using Numbers = py::array_t<double, py::array::c_style | py::array::forcecast>;
using RowMatrix = Eigen::SparseMatrix<double, Eigen::RowMajor, int>;

// A subdivided cage and how many vertices the cage has.
struct SubdividedCage {
  int vertices;
  Subdivision result;
};

IndexVector index_vector(const Indices& array) { return Eigen::Map<const IndexVector>(array.data(), array.size()); }

Vector number_vector(const Numbers& array) { return Eigen::Map<const Vector>(array.data(), array.size()); }

SubdivisionScheme scheme_named(const std::string& name) {
  if (name == "catmull_clark") return SubdivisionScheme::kCatmullClark;
  if (name == "loop") return SubdivisionScheme::kLoop;
  throw InvalidInput("There is no subdivision scheme '" + name + "': use 'catmull_clark' or 'loop'.");
}

SubdivisionBoundary boundary_named(const std::string& name) {
  if (name == "all") return SubdivisionBoundary::kAll;
  if (name == "preserve_corners") return SubdivisionBoundary::kPreserveCorners;
  throw InvalidInput("There is no boundary rule '" + name + "': use 'all' or 'preserve_corners'.");
}

std::unique_ptr<SubdividedCage> make(const Indices& face_offsets, const Indices& face_vertices, int vertices, int level,
                                     const std::string& scheme, const std::string& boundary, const Indices& creases,
                                     const Numbers& crease_sharpness, const Indices& corners,
                                     const Numbers& corner_sharpness, bool limit) {
  if (creases.size() > 0 && (creases.ndim() != 2 || creases.shape(1) != 2)) {
    throw InvalidInput("The creases must be an array of 2 columns, the vertices of an edge: reshape it.");
  }
  Cage cage;
  cage.vertices = vertices;
  cage.face_offsets = index_vector(face_offsets);
  cage.face_vertices = index_vector(face_vertices);
  cage.creases = Eigen::Map<const decltype(cage.creases)>(creases.data(), creases.size() / 2, 2);
  cage.crease_sharpness = number_vector(crease_sharpness);
  cage.corners = index_vector(corners);
  cage.corner_sharpness = number_vector(corner_sharpness);
  const SubdivisionOptions options = {scheme_named(scheme), boundary_named(boundary), level, limit};
  const py::gil_scoped_release release;
  return std::make_unique<SubdividedCage>(SubdividedCage{vertices, subdivide(cage, options)});
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

// (data, indices, indptr), the way scipy.sparse.csr_matrix takes them.
py::tuple matrix(const SubdividedCage& cage) {
  const RowMatrix rows = cage.result.positions;
  return py::make_tuple(py::array_t<double>(rows.nonZeros(), rows.valuePtr()),
                        py::array_t<int>(rows.nonZeros(), rows.innerIndexPtr()),
                        py::array_t<int>(rows.rows() + 1, rows.outerIndexPtr()));
}

}  // namespace

void bind_subdivision(py::module_& module) {
  const SubdivisionOptions defaults;
  py::class_<SubdividedCage>(module, "Subdivision")
      .def(py::init(&make), "face_offsets"_a, "face_vertices"_a, py::kw_only(), "vertices"_a,
           "level"_a = defaults.level, "scheme"_a = "catmull_clark", "boundary"_a = "all", "creases"_a = Indices(),
           "crease_sharpness"_a = Numbers(), "corners"_a = Indices(), "corner_sharpness"_a = Numbers(),
           "limit"_a = defaults.limit)
      .def_property_readonly("faces", [](const SubdividedCage& cage) { return cage.result.faces; })
      .def_property_readonly("face_parent", [](const SubdividedCage& cage) { return cage.result.face_parent; })
      .def("positions", &positions, "V"_a)
      .def("normals", &normals, "V"_a)
      .def("matrix", &matrix);
}

}  // namespace reflines
