#include "python/array_arguments.h"

namespace reflines {

void refuse_array(const pybind11::array& given, const char* wanted) {
  if (!holds_reals(given)) {
    throw InvalidInput("An array of " + std::string(pybind11::str(given.dtype())) + " was given where " + wanted +
                       " are needed; convert it with astype(float).");
  }
  throw InvalidInput("An array of shape " + std::string(pybind11::str(given.attr("shape"))) + " was given where " +
                     wanted + " are needed; reshape it.");
}

}  // namespace reflines
