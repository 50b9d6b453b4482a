// The functions that add the classes and functions of each binding file to the module `reflines`. The Python names,
// shapes and units are in reflines.pyi.
#pragma once

#include <pybind11/pybind11.h>

namespace reflines {

void bind_errors(pybind11::module_& module);
void bind_geometry(pybind11::module_& module);
void bind_subdivision(pybind11::module_& module);
void bind_task(pybind11::module_& module);
void bind_target(pybind11::module_& module);
void bind_builders(pybind11::module_& module);
void bind_line_handles(pybind11::module_& module);
void bind_report(pybind11::module_& module);
void bind_light_set(pybind11::module_& module);
void bind_smooth_panel(pybind11::module_& module);
void bind_solve_panel(pybind11::module_& module);
void bind_check_panel(pybind11::module_& module);
void bind_shut_lines(pybind11::module_& module);
void bind_inspect_panel(pybind11::module_& module);
void bind_gap_continuation(pybind11::module_& module);
void bind_joint_smoother(pybind11::module_& module);
void bind_optimizer(pybind11::module_& module);
void bind_cage_optimizer(pybind11::module_& module);

}  // namespace reflines
