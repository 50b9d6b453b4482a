#include "optimization/stopping_tests.h"

#include "optimization/wording.h"

namespace reflines {

bool StoppingTests::is_cancelled() {
  if (progress_ == nullptr || !progress_->cancelled()) return false;
  const std::string format =
      std::string("Cancelled after %.0f steps with the ") + name_ + " at %.3g; nothing was changed.";
  return stop(Termination::kCancelled, format_sentence(format.c_str(), steps(), gradient_.now));
}

bool StoppingTests::iterations_are_used_up() {
  if (steps() < options_.max_iterations) return false;
  const std::string format = "The limit of " + std::to_string(options_.max_iterations) +
                             " steps was reached with the " + name_ + " at %.3g where %.3g was wanted.";
  return stop(Termination::kIterationLimit, format_sentence(format.c_str(), gradient_.now, gradient_.wanted));
}

bool StoppingTests::has_no_progress() {
  const std::string format =
      std::string("No step lowers the energy any further: the ") + name_ + " is %.3g where %.3g was wanted.";
  return stop(Termination::kNoProgress, format_sentence(format.c_str(), gradient_.now, gradient_.wanted));
}

bool StoppingTests::stop(Termination termination, const std::string& message) {
  report_.termination = termination;
  report_.message = message;
  return true;
}

void StoppingTests::tell(const char* stage) const {
  report_digits(progress_, stage, report_.gradient_before, gradient_.now, gradient_.reachable());
}

}  // namespace reflines
