#include "reflines/target.h"

#include <pybind11/eigen.h>
#include <pybind11/stl.h>

#include <optional>

#include "python/bind.h"

namespace py = pybind11;

namespace reflines {
namespace {

// A copy both ways: a view of the member would dangle as soon as another array is put in its place.
template <typename Array>
py::cpp_function copy_of(Array Target::*member) {
  return [member](const Target& target) { return target.*member; };
}

template <typename Array>
py::cpp_function copy_into(Array Target::*member) {
  return [member](Target& target, const Array& array) { target.*member = array; };
}

}  // namespace

void bind_target(py::module_& module) {
  py::class_<Target>(module, "Target", py::module_local())
      .def(py::init([](const PlaneVectors& gradient, const std::optional<Vector>& weight,
                       const std::optional<Vector>& theta, int family, bool reachable_only) {
             return Target{gradient, weight.value_or(Vector()), theta.value_or(Vector()), family, reachable_only};
           }),
           py::arg("gradient"), py::arg("weight") = py::none(), py::kw_only(), py::arg("theta") = py::none(),
           py::arg("family") = Target().family, py::arg("reachable_only") = Target().reachable_only)
      .def_property("gradient", copy_of(&Target::gradient), copy_into(&Target::gradient))
      .def_property("weight", copy_of(&Target::weight), copy_into(&Target::weight))
      .def_property("theta", copy_of(&Target::theta), copy_into(&Target::theta))
      .def_readwrite("family", &Target::family)
      .def_readwrite("reachable_only", &Target::reachable_only);
}

}  // namespace reflines
