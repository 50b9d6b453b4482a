#include "reflines/check_panel.h"

#include <pybind11/stl.h>

#include <optional>
#include <string>

#include "python/array_arguments.h"
#include "python/bind.h"
#include "python/change_names.h"
#include "python/index_arrays.h"
#include "python/native_call.h"
#include "python/option_names.h"

namespace py = pybind11;

namespace reflines {
namespace {

py::object check(const Positions& before, const Positions& after, const Indices& F, const Mask& region,
                 const std::string& crease_rule, const Indices& marked_creases, double crease_angle,
                 double neighbor_distance, double gap, double angle, double curvature,
                 const std::optional<double>& deviation) {
  CheckOptions options;
  options.creases = {find_named(kCreaseRules, crease_rule, "rule of creases"), crease_angle, edges_of(marked_creases)};
  options.neighbor_distance = neighbor_distance;
  options.gap = gap;
  options.angle = angle;
  options.curvature = curvature;
  if (deviation && !(*deviation >= 0))
    throw InvalidInput("The pass mark for the deviation must be 0 or more, or None.");
  options.deviation = deviation.value_or(options.deviation);
  const Triangles triangles = triangles_of(F);
  return run_native([=] { return check_panel(before, after, triangles, region, options); });
}

std::string kind_name(SeamKind kind) {
  if (kind == SeamKind::kOpen) return "open";
  return kind == SeamKind::kCrease ? "crease" : "border";
}

std::vector<std::string> kind_names(const PanelCheck& check) {
  std::vector<std::string> names;
  for (const SeamKind kind : check.kind) names.push_back(kind_name(kind));
  return names;
}

std::optional<double> mark_of(const CheckRow& row) {
  if (row.mark < 0) return std::nullopt;
  return row.mark;
}

}  // namespace

void bind_check_panel(py::module_& module) {
  py::class_<CheckRow>(module, "CheckRow", py::module_local())
      .def_readonly("name", &CheckRow::name)
      .def_readonly("unit", &CheckRow::unit)
      .def_readonly("before", &CheckRow::before)
      .def_readonly("after", &CheckRow::after)
      .def_property_readonly("mark", &mark_of)
      .def_readonly("passes", &CheckRow::passes)
      .def_readonly("place", &CheckRow::place)
      .def_property_readonly("change", [](const CheckRow& row) { return change_name(row.change); })
      .def_readonly("better", &CheckRow::better)
      .def_readonly("worse", &CheckRow::worse);
  py::class_<PanelCheck>(module, "PanelCheck", py::module_local())
      .def_readonly("edges", &PanelCheck::edges)
      .def_property_readonly("kind", &kind_names)
      .def_property_readonly("gap_before", [](const PanelCheck& own) { return own.before.gap; })
      .def_property_readonly("gap_after", [](const PanelCheck& own) { return own.after.gap; })
      .def_property_readonly("angle_before", [](const PanelCheck& own) { return own.before.angle; })
      .def_property_readonly("angle_after", [](const PanelCheck& own) { return own.after.angle; })
      .def_property_readonly("curvature_before", [](const PanelCheck& own) { return own.before.curvature; })
      .def_property_readonly("curvature_after", [](const PanelCheck& own) { return own.after.curvature; })
      .def_readonly("passes", &PanelCheck::passes)
      .def_property_readonly("change", [](const PanelCheck& own) { return change_names(own.change); })
      .def_readonly("deviation", &PanelCheck::deviation)
      .def_readonly("largest_deviation", &PanelCheck::largest_deviation)
      .def_readonly("deviation_95", &PanelCheck::deviation_95)
      .def_readonly("rows", &PanelCheck::rows)
      .def_property_readonly("all_pass", &PanelCheck::all_pass);
  const CheckOptions options;
  module.def("check", &check, py::arg("before"), py::arg("after"), py::arg("F"), py::arg("region"), py::kw_only(),
             py::arg("crease_rule") = "automatic", py::arg("marked_creases") = Indices(),
             py::arg("crease_angle") = options.creases.angle, py::arg("neighbor_distance") = options.neighbor_distance,
             py::arg("gap") = options.gap, py::arg("angle") = options.angle, py::arg("curvature") = options.curvature,
             py::arg("deviation") = py::none());
}

}  // namespace reflines
