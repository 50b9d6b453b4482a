#include "reflines/inspect_panel.h"

#include <pybind11/stl.h>

#include <memory>
#include <optional>
#include <utility>

#include "python/array_arguments.h"
#include "python/bind.h"
#include "python/exclusive_use.h"
#include "python/eyes.h"
#include "python/index_arrays.h"
#include "python/native_call.h"
#include "reflines/errors.h"
#include "reflines/judge_change.h"

namespace py = pybind11;

namespace reflines {
namespace {

using Pairs = Eigen::Array<bool, Eigen::Dynamic, Eigen::Dynamic>;

py::object inspect(const Positions& V, const Indices& F, const Positions& views, const Positions& lines,
                   const std::optional<double>& length, double flaw_size, double noise_floor, int most_spots, bool maps,
                   const Blockers& blockers, const std::optional<Pairs>& pairs, std::shared_ptr<Progress> progress) {
  InspectOptions options;
  if (pairs) options.pairs = *pairs;
  if (length && !(*length > 0)) throw InvalidInput("The length must be a positive length, or None for automatic.");
  options.length = length.value_or(0.0);
  options.flaw_size = flaw_size;
  options.noise_floor = noise_floor;
  options.most_spots = most_spots;
  options.keep_maps = maps;
  const Eyes beside = eyes_of({}, blockers);
  options.blocker_vertices = beside.blocker_vertices;
  options.blockers = beside.blockers;
  options.progress = std::move(progress);
  const Triangles triangles = triangles_of(F);
  return run_native([=] { return inspect_panel(V, triangles, views, lines, options); });
}

py::object judge(const Positions& before, const Positions& after, const Indices& F, const Vector3& view_direction,
                 const LightSet& lights, double length, const std::shared_ptr<Progress>& progress) {
  const Triangles triangles = triangles_of(F);
  return run_native([=] { return judge_change(before, after, triangles, view_direction, lights, length, progress); });
}

py::object judge_solve(const ShapeOptimizer& optimizer, const LightSet& lights, double length,
                       const std::shared_ptr<Progress>& progress) {
  return call_native(optimizer, ExclusiveUse::Use::kReads, [&optimizer, lights, length, progress] {
    return judge_change(optimizer, lights, length, progress);
  });
}

}  // namespace

void bind_inspect_panel(py::module_& module) {
  py::class_<WorstSpot>(module, "WorstSpot", py::module_local())
      .def_readonly("place", &WorstSpot::place)
      .def_readonly("size", &WorstSpot::size)
      .def_readonly("degrees", &WorstSpot::degrees)
      .def_readonly("height", &WorstSpot::height)
      .def_readonly("view", &WorstSpot::view)
      .def_readonly("light", &WorstSpot::light)
      .def_readonly("front_light", &WorstSpot::front_light)
      .def_readonly("triangles", &WorstSpot::triangles);
  py::class_<PanelInspection>(module, "PanelInspection", py::module_local())
      .def_readonly("length", &PanelInspection::length)
      .def_readonly("degrees", &PanelInspection::degrees)
      .def_readonly("seen", &PanelInspection::seen)
      .def_readonly("deviation", &PanelInspection::deviation)
      .def_readonly("view", &PanelInspection::view)
      .def_readonly("light", &PanelInspection::light)
      .def_readonly("height", &PanelInspection::height)
      .def_readonly("maps", &PanelInspection::maps)
      .def_readonly("mean", &PanelInspection::mean)
      .def_readonly("worst_view", &PanelInspection::worst_view)
      .def_readonly("worst_light", &PanelInspection::worst_light)
      .def_readonly("spots", &PanelInspection::spots);
  const InspectOptions defaults;
  module.def("inspect_panel", &inspect, py::arg("V"), py::arg("F"), py::arg("views"), py::arg("lines"), py::kw_only(),
             py::arg("length") = py::none(), py::arg("flaw_size") = defaults.flaw_size,
             py::arg("noise_floor") = defaults.noise_floor, py::arg("most_spots") = defaults.most_spots,
             py::arg("maps") = defaults.keep_maps, py::arg("blockers") = py::none(), py::arg("pairs") = py::none(),
             py::arg("progress") = py::none());
  module.def("judge_change", &judge, py::arg("before"), py::arg("after"), py::arg("F"), py::kw_only(),
             py::arg("view_direction"), py::arg("lights"), py::arg("length"), py::arg("progress") = py::none());
  module.def("judge_solve", &judge_solve, py::arg("optimizer"), py::kw_only(), py::arg("lights"), py::arg("length"),
             py::arg("progress") = py::none());
  module.def(
      "walk_around",
      [](const Vector3& view, const Vector3& line, const Vector3& up) {
        const WalkAround found = walk_around(view, line, up);
        return py::make_tuple(found.views, found.lines);
      },
      py::arg("view_direction"), py::arg("line_direction"), py::arg("up") = Vector3(Vector3::Zero()));
}

}  // namespace reflines
