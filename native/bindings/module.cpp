#include "native/bindings/bind.h"
#include "native/errors.h"

namespace reflines {

// Errors and classes are this copy's own: of two installed copies of the add-on each must see its own ones only.
void bind_errors(pybind11::module_& module) {
  pybind11::register_local_exception<InvalidInput>(module, "InvalidInput", PyExc_ValueError);
  pybind11::register_local_exception<SolverFailure>(module, "SolverFailure", PyExc_RuntimeError);
  pybind11::register_local_exception<Cancelled>(module, "Cancelled");
}

}  // namespace reflines

PYBIND11_MODULE(reflines, module) {
  module.doc() = "Shape optimization using reflection lines: numpy in, numpy out (see reflines.pyi).";
  module.attr("__version__") = REFLINES_VERSION;
  reflines::bind_errors(module);
  reflines::bind_turn(module);
  reflines::bind_geometry(module);
  reflines::bind_subdivision(module);
  reflines::bind_target(module);
  reflines::bind_report(module);
  reflines::bind_optimizer(module);
  reflines::bind_cage_optimizer(module);
  reflines::bind_builders(module);
}
