// The choice of a sparse direct solver for the symmetric positive definite systems of a solve.
#pragma once

namespace reflines {

enum class LinearSolverKind {
  kCholmod,  // supernodal L L^T
  kUmfpack,  // multifrontal L U, symmetric strategy
};
const char* to_string(LinearSolverKind kind);  // "cholmod", "umfpack"

}  // namespace reflines
