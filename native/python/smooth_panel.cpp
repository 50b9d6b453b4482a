#include "reflines/smooth_panel.h"

#include <pybind11/eigen.h>
#include <pybind11/stl.h>

#include <map>
#include <optional>
#include <string>

#include "python/bind.h"
#include "python/border_codes.h"
#include "python/gil_handover.h"
#include "python/index_arrays.h"
#include "python/option_names.h"

namespace py = pybind11;

namespace reflines {
namespace {

const std::map<std::string, Lights> kLights = {{"crossed", Lights::kCrossed}, {"single", Lights::kSingle}};

// A length that was given must be positive: 0 is the C++ options' word for automatic.
double given(const std::optional<double>& length, const char* name) {
  if (length && !(*length > 0))
    throw InvalidInput(std::string(name) + " must be a positive length, or None for automatic.");
  return length.value_or(0.0);
}

py::tuple smooth(const Positions& V, const Indices& F, const Vector3& view_direction, const Vector3& line_direction,
                 const Codes& border, const std::optional<Mask>& fixed, const std::string& lights,
                 const std::optional<double>& length, double strength, const std::optional<double>& limit,
                 bool symmetric, std::shared_ptr<Progress> progress) {
  SmoothPanelOptions options;
  options.border = border_codes(border, V.rows());
  if (fixed) options.held = *fixed;
  options.lights = find_named(kLights, lights, "choice of lights");
  options.length = given(length, "The length");
  options.strength = strength;
  options.limit = given(limit, "The limit");
  options.symmetric = symmetric;
  options.progress = std::move(progress);
  const Triangles triangles = triangles_of(F);
  SmoothPanelResult result;
  {
    const ReleaseGil release;
    result = smooth_panel(V, triangles, view_direction, line_direction, options);
  }
  return py::make_tuple(std::move(result.positions), std::move(result.report));
}

}  // namespace

void bind_smooth_panel(py::module_& module) {
  const SmoothPanelOptions defaults;
  using Told = SmoothPanelReport;
  py::class_<Told>(module, "SmoothPanelReport", py::module_local())
      .def_readonly("solve", &Told::solve)
      .def_readonly("length", &Told::length)
      .def_readonly("limit", &Told::limit)
      .def_readonly("largest_move", &Told::largest_move)
      .def_readonly("limited", &Told::limited)
      .def_readonly("bumps", &Told::bumps)
      .def_readonly("mirrored", &Told::mirrored)
      .def_readonly("held_faces", &Told::held_faces)
      .def_readonly("unevenness_before", &Told::unevenness_before)
      .def_readonly("unevenness_after", &Told::unevenness_after)
      .def_readonly("stray", &Told::stray)
      .def_readonly("region", &Told::region)
      .def_readonly("applied", &Told::applied)
      .def_readonly("messages", &Told::messages);
  module.def("smooth_panel", &smooth, py::arg("V"), py::arg("F"), py::kw_only(), py::arg("view_direction"),
             py::arg("line_direction"), py::arg("border") = "clamped", py::arg("fixed") = py::none(),
             py::arg("lights") = "crossed", py::arg("length") = py::none(), py::arg("strength") = defaults.strength,
             py::arg("limit") = py::none(), py::arg("symmetric") = defaults.symmetric,
             py::arg("progress") = py::none());
}

}  // namespace reflines
