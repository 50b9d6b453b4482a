#include "reflines/solve_panel.h"

#include <pybind11/stl.h>

#include <memory>
#include <optional>
#include <vector>

#include "python/array_arguments.h"
#include "python/bind.h"
#include "python/exclusive_use.h"
#include "python/native_call.h"
#include "python/surroundings.h"

namespace py = pybind11;

namespace reflines {
namespace {

py::object solve(ShapeOptimizer& optimizer, const std::vector<Target>& targets, double length, double limit,
                 const std::optional<PlanePositions>& limit_range, const Around& around, int most_bounded,
                 const std::shared_ptr<Progress>& progress) {
  SolvePanelOptions options{length, limit, {}, surroundings_of(around), most_bounded};
  if (limit_range) options.limit_range = {limit_range->col(0), limit_range->col(1)};
  return call_native(optimizer, [&optimizer, targets, options, progress] {
    return solve_panel(optimizer, targets, options, progress.get());
  });
}

py::object residual_of(const ShapeOptimizer& optimizer, const Target& target) {
  return call_native(optimizer, ExclusiveUse::Use::kReads,
                     [&optimizer, target] { return measure_residual(optimizer, target); });
}

}  // namespace

void bind_solve_panel(py::module_& module) {
  using Result = SolvePanelReport;
  module.attr("MOST_BOUNDED") = kMostBounded;
  module.attr("MOST_BOUNDED_CAGE") = kMostBoundedCage;
  py::class_<Result>(module, "SolvePanelReport", py::module_local())
      .def_readonly("solve", &Result::solve)
      .def_readonly("limited", &Result::limited)
      .def_readonly("score_before", &Result::score_before)
      .def_readonly("score_after", &Result::score_after)
      .def_readonly("residual_before", &Result::residual_before)
      .def_readonly("residual_after", &Result::residual_after)
      .def_readonly("residual", &Result::residual)
      .def_readonly("falls_short", &Result::falls_short)
      .def_readonly("held_faces", &Result::held_faces)
      .def_readonly("turned_faces", &Result::turned_faces)
      .def_readonly("rim_bend", &Result::rim_bend);
  module.def("solve_panel", &solve, py::arg("optimizer"), py::arg("targets"), py::kw_only(), py::arg("length"),
             py::arg("limit"), py::arg("limit_range") = py::none(), py::arg("around") = py::none(),
             py::arg("most_bounded") = SolvePanelOptions().most_bounded, py::arg("progress") = py::none());
  module.def("measure_residual", &residual_of, py::arg("optimizer"), py::arg("target"));
}

}  // namespace reflines
