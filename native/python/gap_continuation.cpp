#include "reflines/gap_continuation.h"

#include <pybind11/stl.h>

#include <optional>

#include "python/array_arguments.h"
#include "python/bind.h"
#include "python/index_arrays.h"
#include "python/native_call.h"
#include "python/press_arguments.h"
#include "python/surroundings.h"
#include "solver/solve_checks.h"

namespace py = pybind11;

namespace reflines {
namespace {

py::object continue_gap(const Positions& V, const Indices& F, const Positions& V_beside, const Indices& F_beside,
                        const Around& around, const std::optional<double>& gap, const std::optional<double>& margin) {
  const GapOptions options{given(gap, "The gap"), given(margin, "The margin")};
  const Triangles region = triangles_of(F), beside = triangles_of(F_beside);
  const Surroundings joined = surroundings_of(around);
  check_surroundings(joined, V.rows());
  return run_native([=] { return continue_over_gap(V, region, joined, V_beside, beside, options); });
}

}  // namespace

void bind_gap_continuation(py::module_& module) {
  py::class_<GapContinuation>(module, "GapContinuation", py::module_local())
      .def_property_readonly("V", [](const GapContinuation& own) { return own.around.V; })
      .def_property_readonly("F", [](const GapContinuation& own) { return own.around.F; })
      .def_readonly("followed", &GapContinuation::followed)
      .def_readonly("gap", &GapContinuation::gap)
      .def_readonly("width", &GapContinuation::width)
      .def_readonly("flush", &GapContinuation::flush);
  module.attr("AUTOMATIC_GAP") = kAutomaticGap;
  module.def("continue_over_gap", &continue_gap, py::arg("V"), py::arg("F"), py::arg("V_beside"), py::arg("F_beside"),
             py::kw_only(), py::arg("around") = py::none(), py::arg("gap") = py::none(),
             py::arg("margin") = py::none());
}

}  // namespace reflines
