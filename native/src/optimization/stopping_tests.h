// The stopping tests of all runs of a Minimizer, and what they tell of it.
#pragma once

#include <algorithm>
#include <string>

#include "reflines/minimizer_options.h"
#include "reflines/progress.h"
#include "reflines/report.h"

namespace reflines {

// The norm of the gradient of a run, or of the projected gradient where there are limits.
struct GradientNorm {
  double now = 0.0;
  double wanted = 0.0;    // at the end
  double rounding = 0.0;  // by which it changes where x alone is rounded

  double reachable() const { return std::max(wanted, rounding); }
};

// Each test that holds writes Report::termination and its sentence, and returns true.
class StoppingTests {
 public:
  // Keeps references to all; `progress` may be null. `name` is what the sentences call the gradient.
  StoppingTests(const char* name, const GradientNorm& gradient, const MinimizerOptions& options, Progress* progress,
                Report& report)
      : name_(name), gradient_(gradient), options_(options), progress_(progress), report_(report) {}

  // Takes over the steps of another run, after which this one began: they count towards the limit of steps.
  void count_before(int steps) { steps_before_ = steps; }
  int steps() const { return steps_before_ + report_.iterations; }

  bool is_cancelled();
  bool iterations_are_used_up();
  bool has_no_progress();  // no test: no step lowers the energy
  bool stop(Termination termination, const std::string& message);

  // Reports a stage to `progress`, with the fraction of the gradient's digits that are gained.
  void tell(const char* stage) const;

 private:
  const char* name_;
  const GradientNorm& gradient_;
  const MinimizerOptions& options_;
  Progress* progress_;
  Report& report_;
  int steps_before_ = 0;
};

}  // namespace reflines
