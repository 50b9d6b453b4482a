// The fuzzer's bytes as numbers; past their end all are 0.
#pragma once

#include <cmath>
#include <cstdint>
#include <cstring>
#include <limits>

#include "reflines/errors.h"

namespace reflines::fuzz {

class Bytes {
 public:
  Bytes(const std::uint8_t* data, std::size_t size) : data_(data), left_(size) {}

  int below(int count) { return byte() % count; }
  int between(int low, int high) { return low + below(high - low + 1); }
  bool flag() { return byte() % 2 != 0; }
  // Mostly in [-1, 1] on a grid of 1/64; sometimes anything that a double can be.
  double number() {
    const int kind = byte();
    if (kind < 250) return (byte() - 128) / 64.0;
    static constexpr double kStrange[] = {
        0.0, 1e300, -1e300, 1e-300, std::numeric_limits<double>::infinity(), std::numeric_limits<double>::quiet_NaN()};
    return kStrange[kind - 250];
  }
  bool empty() const { return left_ == 0; }

 private:
  int byte() {
    if (left_ == 0) return 0;
    --left_;
    return *data_++;
  }

  const std::uint8_t* data_;
  std::size_t left_;
};

inline void require(bool true_here) {
  if (!true_here) __builtin_trap();
}

// Runs what may be refused. Every other exception is a finding.
template <class Work>
void may_refuse(const Work& work) {
  try {
    work();
  } catch (const InvalidInput&) {
  } catch (const SolverFailure&) {
  } catch (const Cancelled&) {
  }
}

}  // namespace reflines::fuzz
