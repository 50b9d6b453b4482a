#include "python/bind.h"
#include "reflines/errors.h"
#include "threads/short_waits.h"

namespace reflines {

// Exceptions and classes are local to this module: of two installed copies of the add-on each must use its own.
void bind_errors(pybind11::module_& module) {
  pybind11::register_local_exception<InvalidInput>(module, "InvalidInput", PyExc_ValueError);
  pybind11::register_local_exception<SolverFailure>(module, "SolverFailure", PyExc_RuntimeError);
  pybind11::register_local_exception<Cancelled>(module, "Cancelled");
}

namespace {

namespace py = pybind11;

// Replaces pybind11's tp_new, so that Python's `T.__new__(T)` and copies by it raise a TypeError: pybind11 would treat
// uninitialized memory as an object.
PyObject* allocate(PyTypeObject* type, PyObject* arguments, PyObject* keywords) {
  const auto* base = reinterpret_cast<PyTypeObject*>(py::detail::get_internals().instance_base);
  return base->tp_new(type, arguments, keywords);
}

void allow_only_initialized_objects(const py::module_& module) {
  for (const auto& item : module.attr("__dict__").cast<py::dict>()) {
    if (!PyType_Check(item.second.ptr())) continue;
    auto* type = reinterpret_cast<PyTypeObject*>(item.second.ptr());
    if (py::detail::get_type_info(type) == nullptr) continue;  // an exception
    type->tp_new = &allocate;
    PyType_Modified(type);
  }
}

}  // namespace
}  // namespace reflines

PYBIND11_MODULE(reflines, module) {
  module.doc() = "Shape optimization using reflection lines: numpy in, numpy out (see reflines.pyi).";
  module.attr("__version__") = REFLINES_VERSION;
  reflines::bind_errors(module);
  reflines::bind_task(module);
  reflines::bind_geometry(module);
  reflines::bind_subdivision(module);
  reflines::bind_target(module);
  reflines::bind_report(module);
  reflines::bind_light_set(module);
  reflines::bind_smooth_panel(module);
  reflines::bind_check_panel(module);
  reflines::bind_shut_lines(module);
  reflines::bind_inspect_panel(module);
  reflines::bind_gap_continuation(module);
  reflines::bind_joint_smoother(module);
  reflines::bind_optimizer(module);
  reflines::bind_cage_optimizer(module);
  reflines::bind_solve_panel(module);
  reflines::bind_builders(module);
  reflines::bind_line_handles(module);
  reflines::allow_only_initialized_objects(module);
  reflines::shorten_waits();
}
