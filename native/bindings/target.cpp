#include "native/reflection/target.h"

#include <pybind11/eigen.h>
#include <pybind11/stl.h>

#include <optional>

#include "native/bindings/bind.h"

namespace py = pybind11;

namespace reflines {

void bind_target(py::module_& module) {
  py::class_<Target>(module, "Target", py::module_local())
      .def(py::init([](const PlaneVectors& gradient, const std::optional<Vector>& weight,
                       const std::optional<Vector>& theta, int family) {
             return Target{gradient, weight.value_or(Vector()), theta.value_or(Vector()), family};
           }),
           py::arg("gradient"), py::arg("weight") = py::none(), py::kw_only(), py::arg("theta") = py::none(),
           py::arg("family") = Target().family)
      .def_readwrite("gradient", &Target::gradient)
      .def_readwrite("weight", &Target::weight)
      .def_readwrite("theta", &Target::theta)
      .def_readwrite("family", &Target::family);
}

}  // namespace reflines
