#include "reflines/target.h"

#include <pybind11/stl.h>

#include <optional>

#include "python/array_arguments.h"
#include "python/bind.h"

namespace py = pybind11;

namespace reflines {
namespace {

// Copies in both directions: a view of the member would dangle as soon as another array is assigned.
template <typename Array>
py::cpp_function make_getter(Array Target::*member) {
  return [member](const Target& target) { return target.*member; };
}

template <typename Array>
py::cpp_function make_setter(Array Target::*member) {
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
      .def_property("gradient", make_getter(&Target::gradient), make_setter(&Target::gradient))
      .def_property("weight", make_getter(&Target::weight), make_setter(&Target::weight))
      .def_property("theta", make_getter(&Target::theta), make_setter(&Target::theta))
      .def_readwrite("family", &Target::family)
      .def_readwrite("reachable_only", &Target::reachable_only);
}

}  // namespace reflines
