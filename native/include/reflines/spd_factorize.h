// A factorization of sparse matrices as a function, by which builders of targets solve systems of their own.
#pragma once

#include <functional>

#include "reflines/types.h"

namespace reflines {

// A function that factors a symmetric positive definite matrix (lower triangle) and returns the solve x <- A^-1 x.
using SpdSolve = std::function<void(Vector&)>;
using SpdFactorize = std::function<SpdSolve(const SparseMatrix&)>;

}  // namespace reflines
