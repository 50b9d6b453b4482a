#include "reflines/line_handles.h"

#include <pybind11/stl.h>

#include <memory>
#include <optional>
#include <utility>

#include "python/array_arguments.h"
#include "python/bind.h"
#include "python/exclusive_use.h"
#include "python/index_arrays.h"
#include "reflines/handle_follower.h"
#include "reflines/shape_optimizer.h"

namespace py = pybind11;

namespace reflines {
namespace {

Handle make_handle(const PlanePositions& points, const std::optional<double>& value, double radius,
                   const std::optional<PlanePositions>& centre, const Indices& triangles, const std::string& name) {
  const HandleKind kind = value ? HandleKind::kPull : HandleKind::kPin;
  return {kind, points, value.value_or(0.0), centre.value_or(PlanePositions()), radius, index_vector(triangles), name};
}

std::function<std::unique_ptr<LineHandles>()> prepare_line_handles(ShapeOptimizer& optimizer, int family,
                                                                   const std::optional<Vector>& falloff) {
  return [=, exclusive_use = std::make_shared<const ExclusiveUse>(optimizer, ExclusiveUse::Use::kChanges), &optimizer] {
    return std::make_unique<LineHandles>(optimizer.region_field(family), optimizer.changeable(), optimizer.factorizer(),
                                         falloff.value_or(Vector()));
  };
}

py::object measure(const LineHandles& line_handles, const std::vector<Handle>& handles, ShapeOptimizer& optimizer,
                   double line_step) {
  return call_native(optimizer, [=, &line_handles, &optimizer] {
    return line_handles.measure(handles, optimizer.vertex_field(line_handles.family()), line_step);
  });
}

py::object handles(ShapeOptimizer& optimizer, const std::vector<Handle>& handles, int family,
                   const std::optional<Vector>& falloff) {
  return call_native(optimizer, [=, &optimizer] {
    return LineHandles(optimizer.region_field(family), optimizer.changeable(), optimizer.factorizer(),
                       falloff.value_or(Vector()))
        .build(handles);
  });
}

py::object read_vertex_theta(ShapeOptimizer& optimizer, int family) {
  return call_native(optimizer, [&optimizer, family] { return Vector(optimizer.vertex_field(family).vertex_theta); });
}

py::object follow(HandleFollower& follower, const std::vector<Handle>& handles, ShapeOptimizer& optimizer,
                  bool keep_others) {
  auto own = std::make_shared<const ExclusiveUse>(follower, ExclusiveUse::Use::kChanges);
  return call_native(optimizer, [=, own = std::move(own), &follower, &optimizer] {
    return follower.follow(handles, optimizer, keep_others);
  });
}

}  // namespace

void bind_line_handles(py::module_& module) {
  py::class_<Handle>(module, "Handle", py::module_local())
      .def(py::init(&make_handle), py::arg("points") = PlanePositions(0, 2), py::kw_only(),
           py::arg("value") = py::none(), py::arg("radius") = Handle().radius, py::arg("centre") = py::none(),
           py::arg("triangles") = Indices(), py::arg("name") = "");
  py::class_<HandleResidual>(module, "HandleResidual", py::module_local())
      .def_readonly("theta", &HandleResidual::theta)
      .def_readonly("distance", &HandleResidual::distance)
      .def_readonly("fraction", &HandleResidual::fraction);
  py::class_<LineHandles> lines(module, "LineHandles", py::module_local());
  const auto define = [&](const auto&... arguments) {
    lines.def(py::init(construct(&prepare_line_handles)), arguments...);
    lines.def_static("create", create(&prepare_line_handles), arguments...);
  };
  define(py::arg("optimizer"), py::kw_only(), py::arg("family") = 0, py::arg("falloff") = py::none());
  lines.def("build", bind_method(&LineHandles::build), py::arg("handles"))
      .def("find_conflicts", bind_method(&LineHandles::find_conflicts), py::arg("handles"))
      .def("read_theta", bind_method(&LineHandles::read_theta), py::arg("points"))
      .def("can_follow", &LineHandles::can_follow, py::arg("points"))
      .def("measure", &measure, py::arg("handles"), py::arg("optimizer"), py::kw_only(), py::arg("line_step"));
  py::class_<HandleFollower>(module, "HandleFollower", py::module_local())
      .def(py::init<const ShapeOptimizer&, const LineHandles&>(), py::arg("start"), py::arg("lines"),
           py::keep_alive<1, 2>(), py::keep_alive<1, 3>())
      .def("follow", &follow, py::arg("handles"), py::arg("optimizer"), py::kw_only(), py::arg("keep_others") = true);
  module.def("handles", &handles, py::arg("optimizer"), py::arg("handles"), py::kw_only(), py::arg("family") = 0,
             py::arg("falloff") = py::none());
  module.def("vertex_theta", &read_vertex_theta, py::arg("optimizer"), py::kw_only(), py::arg("family") = 0);
}

}  // namespace reflines
