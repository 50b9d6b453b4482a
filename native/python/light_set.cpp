#include "reflines/light_set.h"

#include <pybind11/stl.h>

#include "python/bind.h"
#include "python/eyes.h"

namespace py = pybind11;

namespace reflines {

void bind_light_set(py::module_& module) {
  py::class_<LightSet>(module, "LightSet", py::module_local())
      .def(py::init([](const Eigen::MatrixXd& lines, const EyeDirections& eyes, const std::vector<double>& weight,
                       const Blockers& blockers) {
             return LightSet{read_directions(lines, "A line direction"), eyes_of(eyes, blockers), weight};
           }),
           py::arg("line_directions"), py::arg("eye_directions") = py::none(), py::kw_only(),
           py::arg("weight") = std::vector<double>(), py::arg("blockers") = py::none());
}

}  // namespace reflines
