// The same input gives the same bits, whatever the number of threads: the program runs itself with one and with two.
#include <gtest/gtest.h>

#include <cstdint>
#include <cstdio>
#include <cstring>
#include <filesystem>
#include <string>

#include "optimization/linear/linear_solver.h"

namespace reflines {
namespace {

// The thin plate on a side x side grid: fronts wide enough for a BLAS to share among threads.
SparseMatrix thin_plate(int side) {
  SparseMatrix laplacian(side * side, side * side);
  std::vector<Eigen::Triplet<double>> entries;
  const auto index = [side](int i, int j) { return i * side + j; };
  for (int i = 0; i < side; ++i) {
    for (int j = 0; j < side; ++j) {
      entries.emplace_back(index(i, j), index(i, j), 4.0 + 0.1 * (i % 3));
      if (i + 1 < side) entries.emplace_back(index(i + 1, j), index(i, j), -1.0);
      if (i > 0) entries.emplace_back(index(i - 1, j), index(i, j), -1.0);
      if (j + 1 < side) entries.emplace_back(index(i, j + 1), index(i, j), -1.0);
      if (j > 0) entries.emplace_back(index(i, j - 1), index(i, j), -1.0);
    }
  }
  laplacian.setFromTriplets(entries.begin(), entries.end());
  const SparseMatrix full = laplacian.transpose() * laplacian;
  SparseMatrix lower = full.triangularView<Eigen::Lower>();
  lower.makeCompressed();
  return lower;
}

std::uint64_t digest(const Vector& x) {
  std::uint64_t sum = 0;
  for (const double value : x) {
    std::uint64_t bits = 0;
    std::memcpy(&bits, &value, sizeof bits);
    sum = sum * 1099511628211u + bits;
  }
  return sum;
}

// Not a check of its own: what the test below runs twice.
TEST(ThreadCountTest, DISABLED_PrintDigest) {
  const SparseMatrix matrix = thin_plate(150);
  for (const auto kind : {LinearSolverKind::kCholmod, LinearSolverKind::kUmfpack}) {
    LinearSolver solver(kind);
    solver.analyze(matrix);
    solver.factorize(matrix);
    Vector x = Vector::LinSpaced(matrix.rows(), -1.0, 1.0);
    solver.solve(x);
    std::printf("digest %016llx\n", static_cast<unsigned long long>(digest(x)));
  }
}

std::string digests_with_threads(int threads) {
  const std::string count = std::to_string(threads);
  const std::string command = "OMP_NUM_THREADS=" + count + " OPENBLAS_NUM_THREADS=" + count + " '" +
                              std::filesystem::read_symlink("/proc/self/exe").string() +
                              "' --gtest_also_run_disabled_tests --gtest_filter=ThreadCountTest.DISABLED_PrintDigest";
  std::FILE* pipe = popen(command.c_str(), "r");
  if (pipe == nullptr) return "";
  std::string digests;
  char line[256];
  while (std::fgets(line, sizeof line, pipe) != nullptr) {
    if (std::strncmp(line, "digest", 6) == 0) digests += line;
  }
  return pclose(pipe) == 0 ? digests : "";
}

TEST(ThreadCountTest, TheSolutionHasTheSameBits) {
  const std::string one = digests_with_threads(1);
  EXPECT_EQ(one.size(), 2 * std::string("digest 0123456789abcdef\n").size());
  EXPECT_EQ(one, digests_with_threads(2));
}

}  // namespace
}  // namespace reflines
