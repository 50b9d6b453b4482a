// The exceptions of the library: two kinds of failure, and cancellation. A solve that does not converge throws nothing:
// it returns a value of Report::termination.
#pragma once

#include <exception>
#include <stdexcept>

namespace reflines {

// Thrown where the caller's data cannot be used. The text is one sentence: what, how many (or which index), what to do.
class InvalidInput : public std::invalid_argument {
 public:
  using std::invalid_argument::invalid_argument;
};

// Thrown at a numerical breakdown inside a solve (for instance a singular matrix); the caller's data are untouched.
class SolverFailure : public std::runtime_error {
 public:
  using std::runtime_error::runtime_error;
};

// Thrown where Progress::cancel was called before there was a result. A solve does not throw it: it returns a
// Termination.
class Cancelled : public std::exception {
 public:
  const char* what() const noexcept override { return "Cancelled: nothing was made and nothing was changed."; }
};

}  // namespace reflines
