// The parts of the module `reflines`, one a file.
#pragma once

#include <pybind11/pybind11.h>

namespace reflines {

void bind_subdivision(pybind11::module_& module);

}  // namespace reflines
