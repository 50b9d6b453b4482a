#include "reflines/shut_lines.h"

#include <pybind11/stl.h>

#include <optional>

#include "python/array_arguments.h"
#include "python/bind.h"
#include "python/change_names.h"
#include "python/index_arrays.h"
#include "python/native_call.h"
#include "python/press_arguments.h"

namespace py = pybind11;

namespace reflines {
namespace {

py::object check_lines(const Positions& before, const Positions& after, const Indices& F, const Mask& region,
                       const Positions& V_beside, const Indices& F_beside, const Indices& label,
                       const std::optional<double>& gap, const std::optional<Vector3>& view_direction,
                       const std::optional<Vector3>& line_direction, double spacing, double uneven, double flush,
                       double kink, double line_angle, double line_offset) {
  if (view_direction.has_value() != line_direction.has_value())
    throw InvalidInput("Give the view and line directions, or neither.");
  const Vector3 none = Vector3::Zero();
  const ShutLineOptions options{given(gap, "The gap"),
                                view_direction.value_or(none),
                                line_direction.value_or(none),
                                spacing,
                                uneven,
                                flush,
                                kink,
                                line_angle,
                                line_offset};
  const BesidePanel beside{V_beside, triangles_of(F_beside), index_vector(label)};
  const Triangles triangles = triangles_of(F);
  return run_native([=] { return check_shut_lines(before, after, triangles, region, beside, options); });
}

}  // namespace

void bind_shut_lines(py::module_& module) {
  py::class_<ShutLine>(module, "ShutLine", py::module_local())
      .def_readonly("label", &ShutLine::label)
      .def_readonly("edges", &ShutLine::edges)
      .def_readonly("length", &ShutLine::length)
      .def_readonly("rows", &ShutLine::rows);
  py::class_<ShutMeasures>(module, "ShutMeasures", py::module_local())
      .def_readonly("gap", &ShutMeasures::gap)
      .def_readonly("flush", &ShutMeasures::flush)
      .def_readonly("kink", &ShutMeasures::kink)
      .def_readonly("line_angle", &ShutMeasures::line_angle)
      .def_readonly("line_offset", &ShutMeasures::line_offset);
  py::class_<ShutLines>(module, "ShutLines", py::module_local())
      .def_readonly("gap", &ShutLines::gap)
      .def_readonly("edges", &ShutLines::edges)
      .def_readonly("before", &ShutLines::before)
      .def_readonly("after", &ShutLines::after)
      .def_readonly("passes", &ShutLines::passes)
      .def_property_readonly("change", [](const ShutLines& own) { return change_names(own.change); })
      .def_readonly("list", &ShutLines::list);
  const ShutLineOptions options;
  module.def("check_shut_lines", &check_lines, py::arg("before"), py::arg("after"), py::arg("F"), py::arg("region"),
             py::arg("V_beside") = Positions(0, 3), py::arg("F_beside") = Indices(), py::kw_only(),
             py::arg("label") = Indices(), py::arg("gap") = py::none(), py::arg("view_direction") = py::none(),
             py::arg("line_direction") = py::none(), py::arg("spacing") = options.spacing,
             py::arg("uneven") = options.uneven, py::arg("flush") = options.flush, py::arg("kink") = options.kink,
             py::arg("line_angle") = options.line_angle, py::arg("line_offset") = options.line_offset);
}

}  // namespace reflines
