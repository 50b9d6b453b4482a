#include "optimization/limited_descent.h"

#include <algorithm>
#include <limits>
#include <utility>

#include "optimization/active_set.h"
#include "optimization/descent.h"
#include "optimization/descent_run.h"

namespace reflines {
namespace {

// The tolerance of the model's solution relative to the gradient: the energy is no quadratic function.
constexpr double kModelTolerance = 0.01;

// The part of the gradient left by a step with the model above which a new matrix is assembled.
constexpr double kTrusted = 0.1;

// The part of the gradient left by a step with a matrix of its own above which no more digits are expected.
constexpr double kLeastGain = 0.9;

// The cost of a new matrix and its factor, in steps with contacts: 4 with 10,000 and with 100,000 unknowns; and the
// number of steps to the last digits with it.
constexpr int kStepsPerModel = 5, kStepsAfterModel = 1;

class LimitedDescent final : public DescentRun {
 public:
  LimitedDescent(const RowLimits& limits, Problem& problem, const MinimizerOptions& options, Progress* progress,
                 Workspace& workspace)
      : DescentRun(problem, options, progress, workspace, "projected gradient",
                   RefactorPolicy(kStepsPerModel, kStepsAfterModel)),
        active_(limits, workspace, progress),
        factorizations_before_(workspace.held_factor.factorizations()),
        solves_before_(workspace.held_factor.solves()) {}

 private:
  void place_start(const Vector& x) override {
    work_.x = active_.move_inside(x);
    report_.put_back = active_.count_beyond(x);
    moved_ = report_.put_back > 0;
  }

  double measure_gradient() override { return active_.measure_gradient(); }
  bool factor_is_kept() const override { return active_.has_factor(model()); }

  bool begin() override {
    const bool kept = factor_is_kept();
    return may_move() && (kept || start_near_free_minimum());
  }

  bool may_move() {
    if (active_.may_move()) return true;
    report_.gradient_before = gradient_.now = 0.0;
    stop(moved_ ? Termination::kConverged : Termination::kAlreadyOptimal,
         "Nothing may move: the limit is 0 at every vertex that could.");
    return false;
  }

  // Starts with the free minimum; returns false where that ends the run.
  bool start_near_free_minimum() {
    const Vector start = work_.x;
    Vector minimum = start;
    Report free = descend(problem_, minimum, options_, progress_, work_);
    free.put_back = report_.put_back;
    free.evaluations += report_.evaluations;
    report_ = free;
    report_.gradient_before = gradient_.now;
    work_.x = start;
    if (free.termination == Termination::kCancelled) return false;
    if (active_.contain(minimum)) {
      work_.x = minimum;
      moved_ = true;
      current_.energy = free.energy_after;
      gradient_.now = free.gradient_after;
      return false;
    }
    steps_before_ = std::exchange(report_.iterations, 0);
    active_.aim_at(minimum);
    if (!may_move()) return false;
    start_on_the_way_to(minimum);
    return true;
  }

  // Moves the start towards `minimum`, all unknowns by one factor: without the kinks of a move of each as far as it
  // can.
  void start_on_the_way_to(const Vector& minimum) {
    work_.x = active_.move_inside(work_.x);
    current_.energy = evaluate(work_.x, work_.gradient);
    report_.gradient_before = gradient_.now = measure_gradient();
    gradient_.wanted = options_.gradient_tolerance * gradient_.now;
    work_.trial = active_.go_towards(minimum, work_.x);
    trial_.energy = evaluate(work_.trial, work_.trial_gradient);
    if (trial_.energy < current_.energy) accept_trial();
    failed_ = true;
  }

  bool choose_step() override {
    if (!choose_destination()) return false;
    work_.direction = destination_ - work_.x;
    current_.slope = work_.gradient.dot(work_.direction);
    return true;
  }

  bool choose_destination() {
    if (digits_end_) return has_no_progress(), false;
    if (model_is_outdated()) return renew_model() && solve_model();
    // The last run's pairs gain less than a solve: where contacts have changed, a step with them is no step to take.
    if (report_.iterations == 0) return solve_model();
    return kept_factor_leads_on() || solve_model();
  }

  bool model_is_outdated() const {
    if (work_.matrix.rows() != work_.x.size() || is_outdated()) return true;
    return !is_fresh() && (active_.renews_each_step() || new_model_pays());
  }

  // Returns whether a new matrix at the start of this run costs no more than the matrix that is kept has cost by now.
  bool new_model_pays() const {
    return assembled_at_ < 0 && report_.iterations == 0 && work_.extra_steps >= kStepsPerModel;
  }

  bool renew_model() {
    work_.held_factor.forget();
    work_.matrix = assemble();
    renewed_ = new_model_pays();
    work_.usual_steps = 1;
    work_.extra_steps = 0;
    analyze(work_.matrix);
    work_.factored_model = model();
    assembled_at_ = report_.iterations;
    start_policy();
    failed_ = false;
    return !is_cancelled() && !gradient_is_small();
  }

  // Tries a step with the present factor and contacts; returns false where others are needed.
  bool kept_factor_leads_on() {
    tell("iterating");
    std::optional<Vector> end = active_.lead_on(gradient_.now, learns_from_steps() ? &work_.memory : nullptr);
    if (!end) return false;
    destination_ = std::move(*end);
    return true;
  }

  // Determines the contacts and the step anew; returns false where these tell that the present point is the minimum.
  bool solve_model() {
    tell("factorizing");
    destination_ = active_.solve_model(std::max(kModelTolerance * gradient_.now, 0.3 * gradient_.wanted));
    work_.memory.clear();
    gradient_.now = measure_gradient();
    return !gradient_is_small();
  }

  void go(double step) override {
    work_.trial = step == 1.0 ? destination_ : active_.keep_inside(work_.x + step * work_.direction);
  }

  bool shortens_steps() const override { return true; }
  bool renews_failed() const override { return true; }

  bool measure_step() override {
    work_.direction = work_.trial - work_.x;
    return active_.keeps_contacts();
  }

  void take_step() override {
    const double before = gradient_.now;
    const bool fresh = is_fresh();
    DescentRun::take_step();
    digits_end_ =
        active_.renews_each_step() && gradient_.now > kLeastGain * std::exchange(reached_norm_, gradient_.now);
    failed_ = fresh && gradient_.now > kTrusted * before;
  }

  void finish(Vector& x) override {
    count_steps();
    report_.iterations = steps();
    DescentRun::finish(x);
    report_.factorizations += work_.held_factor.factorizations() - factorizations_before_;
    report_.solves += work_.held_factor.solves() - solves_before_;
  }

  // Counts the steps that the matrix has cost beyond the usual ones: a new matrix that saved none is not paid for
  // again.
  void count_steps() {
    const int steps = report_.iterations - std::max(assembled_at_, 0);
    if (renewed_)
      work_.usual_steps = std::max(steps, 1);
    else
      work_.extra_steps += std::max(steps - work_.usual_steps, 0);
  }

  bool gradient_is_small() override {
    const bool small = gradient_.now <= gradient_.wanted && moved_;
    if (!small && gradient_.now > gradient_.rounding) return false;
    return stop(moved_ ? Termination::kConverged : Termination::kAlreadyOptimal,
                format_sentence("The projected gradient is down to %.3g; %.3g was wanted.", gradient_.now,
                                gradient_.reachable()));
  }

  ActiveSet active_;
  int factorizations_before_, solves_before_;
  Vector destination_;       // end of a full step
  bool renewed_ = false;     // the matrix replaces one whose steps have cost as much
  bool digits_end_ = false;  // a new matrix for each step has not brought the gradient down
  double reached_norm_ = std::numeric_limits<double>::infinity();  // gradient_.now after the last such step
};

}  // namespace

Report descend_within(const RowLimits& limits, Problem& problem, Vector& x, const MinimizerOptions& options,
                      Progress* progress, Workspace& workspace) {
  return LimitedDescent(limits, problem, options, progress, workspace).run(x);
}

}  // namespace reflines
