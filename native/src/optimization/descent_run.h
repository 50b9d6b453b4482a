// One run of a Minimizer: the loop, its steps and its stopping tests, as free runs and those within limits have them.
#pragma once

#include <algorithm>
#include <chrono>
#include <string>

#include "optimization/line_search.h"
#include "optimization/problem.h"
#include "optimization/refactor_policy.h"
#include "optimization/workspace.h"
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

class DescentRun {
 public:
  // Takes what a run needs; all outlive it, and `progress` may be null. `name` is what sentences call the gradient.
  DescentRun(Problem& problem, const MinimizerOptions& options, Progress* progress, Workspace& workspace,
             const char* name, const RefactorPolicy& policy);
  virtual ~DescentRun() = default;

  // Implements Minimizer::minimize.
  Report run(Vector& x);

 protected:
  // These differ. Those that return bool return false where the run is to stop.
  virtual void place_start(const Vector& x) = 0;  // writes the current point
  virtual double measure_gradient() = 0;          // its norm at the current point
  virtual bool factor_is_kept() const = 0;        // of an earlier run
  virtual bool begin() = 0;                       // approaches the minimum
  virtual bool choose_step() = 0;                 // writes the direction and its slope
  virtual void go(double step) = 0;               // writes the trial point
  virtual bool shortens_steps() const = 0;        // where the full one is refused
  virtual bool measure_step() = 0;                // writes the step to the direction; false: there is nothing to learn
  virtual void take_step();
  virtual bool renews_failed() const = 0;  // a matrix of another point by which no step lowers the energy
  virtual bool gradient_is_small() = 0;    // a stopping test
  virtual void finish(Vector& x);

  double evaluate(const Vector& x, Vector& gradient);
  const SparseMatrix& assemble();  // at the current point
  void analyze(const SparseMatrix& matrix) { report_.analyses += work_.analyze(matrix, problem_, progress_); }
  void start_policy();       // with the matrix assembled last
  bool is_outdated() const;  // of that matrix
  void accept_trial();

  HessianModel model() const;
  bool learns_from_steps() const { return options_.strategy == Strategy::kAdaptive; }
  bool is_fresh() const { return assembled_at_ == report_.iterations; }
  int steps() const { return steps_before_ + report_.iterations; }

  // These are stopping tests: each that holds writes Report::termination and its sentence, and returns true.
  bool is_cancelled();
  bool iterations_are_used_up();
  bool has_no_progress();  // no test: no step lowers the energy
  bool stop(Termination termination, const std::string& message);
  static std::string format_sentence(const std::string& format, double first, double second);  // two %g

  // Reports a stage, with the fraction of the digits of the gradient norm that are gained; it never decreases.
  void tell(const char* stage) const;

  Problem& problem_;
  const MinimizerOptions& options_;
  Progress* progress_;
  Workspace& work_;
  const std::string name_;
  const std::chrono::steady_clock::time_point start_ = std::chrono::steady_clock::now();
  Report report_;
  RefactorPolicy policy_;
  GradientNorm gradient_;
  LinePoint current_, trial_;
  bool moved_ = false;
  int steps_before_ = 0;   // of another run, after which this one began: they count towards the limit of steps
  int assembled_at_ = -1;  // iteration at whose point the matrix was assembled; -1: before this run
  bool failed_ = false;    // no step with it lowers the energy, or its prediction was wrong

 private:
  void evaluate_start(const Vector& x);
  void measure_rounding(const Vector& weight);
  bool find_step();
  void try_step(double step);
  bool discard_matrix();
};

}  // namespace reflines
