// The same input gives the same bits, whatever the number of threads: the program runs itself with one and with two.
#include <gtest/gtest.h>

#include <cstdint>
#include <cstdio>
#include <cstdlib>
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

#if defined(_WIN32)
void set_variable(const char* name, const std::string& value) { _putenv_s(name, value.c_str()); }
std::FILE* start(const std::string& command) { return _popen(command.c_str(), "r"); }
int finish(std::FILE* pipe) { return _pclose(pipe); }
#else
void set_variable(const char* name, const std::string& value) { setenv(name, value.c_str(), 1); }
std::FILE* start(const std::string& command) { return popen(command.c_str(), "r"); }
int finish(std::FILE* pipe) { return pclose(pipe); }
#endif

// Changes the environment of this process too, where all libraries have read theirs.
std::string digests_with_threads(int threads) {
  for (const char* name : {"OMP_NUM_THREADS", "OPENBLAS_NUM_THREADS"}) set_variable(name, std::to_string(threads));
  const std::filesystem::path program = std::filesystem::absolute(testing::internal::GetArgvs().front());
  std::FILE* pipe = start('"' + program.string() +
                          "\" --gtest_also_run_disabled_tests --gtest_filter=ThreadCountTest.DISABLED_PrintDigest");
  if (pipe == nullptr) return "";
  std::string digests;
  char line[256];
  while (std::fgets(line, sizeof line, pipe) != nullptr) {
    if (std::strncmp(line, "digest", 6) == 0) digests += line;
  }
  return finish(pipe) == 0 ? digests : "";
}

TEST(ThreadCountTest, TheSolutionHasTheSameBits) {
  const std::string one = digests_with_threads(1);
  EXPECT_EQ(one.size(), 2 * std::string("digest 0123456789abcdef\n").size());
  EXPECT_EQ(one, digests_with_threads(2));
}

}  // namespace
}  // namespace reflines
