#include "reflines/report.h"

namespace reflines {

const char* to_string(Termination termination) {
  switch (termination) {
    case Termination::kConverged:
      return "converged";
    case Termination::kAlreadyOptimal:
      return "already_optimal";
    case Termination::kNoProgress:
      return "no_progress";
    case Termination::kIterationLimit:
      return "iteration_limit";
    case Termination::kCancelled:
      return "cancelled";
  }
  return "";
}

}  // namespace reflines
