#include "optimization/linear/linear_backend.h"

#include <string>

#include "reflines/errors.h"

namespace reflines {

namespace {

// The multiples of the diagonal that are added one after the other until the factorization succeeds, and of the mean
// diagonal entry for unknowns that no term constrains. A Gauss-Newton matrix is semi-definite on paper: 1e-12 is above
// the rounding of a sum of some thousand terms, 1e-9 is for very thin triangles, and the last two, which shorten the
// steps, for free borders around faces seen nearly edge on.
constexpr double kDiagonalShifts[] = {0.0, 1e-12, 1e-9, 1e-6, 1e-3};

Vector shift_diagonal(const SparseMatrix& matrix, double shift) {
  Vector values = Eigen::Map<const Vector>(matrix.valuePtr(), matrix.nonZeros());
  const double mean = matrix.diagonal().mean();
  for (int column = 0; column < matrix.cols(); ++column) {
    double& entry = values[matrix.outerIndexPtr()[column]];
    entry += shift * (entry + mean);
  }
  return values;
}

}  // namespace

void require_memory(bool enough, const char* stage, Eigen::Index n) {
  if (enough) return;
  throw SolverFailure("Memory ran out while " + std::string(stage) + " a system of " + std::to_string(n) +
                      " unknowns; optimize a smaller region.");
}

std::unique_lock<std::mutex> lock_metis() {
  static std::mutex mutex;
  return std::unique_lock(mutex);
}

double LinearBackend::factorize_shifted(const SparseMatrix& matrix) {
  allocate();
  Vector shifted;
  for (const double shift : kDiagonalShifts) {
    if (shift > 0.0) shifted = shift_diagonal(matrix, shift);
    if (factorize(matrix, shift > 0.0 ? shifted.data() : matrix.valuePtr())) return shift;
  }
  throw SolverFailure(
      "The system of " + std::to_string(matrix.rows()) +
      " unknowns is singular or not positive definite, also with 1e-3 of its diagonal added; hold more of "
      "the border.");
}

}  // namespace reflines
