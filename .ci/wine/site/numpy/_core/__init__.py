"""Where pybind11 looks for the C interface of numpy 2."""
