#include "restoration/cage_press.h"

#include "restoration/held_border.h"
#include "restoration/press_rules.h"
#include "restoration/press_setup.h"
#include "solver/mirror_coupling.h"

namespace reflines {
namespace {

class CagePress : public Press {
 public:
  CagePress(JointCage cage, const Vector3& view, const Vector3& lines, const SmoothPanelOptions& options,
            const PressAmount& amount)
      : partner_(cage.options.partner) {
    set_restoration_rules(options, lines, amount, kRules.cage.proximity, cage.options.shape);
    press_ =
        prepare_held_cage_border(cage.cage, cage.V, view, make_families(view, lines, options), cage.options, options);
  }

  SmoothPanelResult run(const PressAmount& amount) override {
    PressAmount own = amount;
    own.limit_range = intersect_limits(amount.limit_range, partner_);
    return press_->run(own);
  }

 private:
  IndexVector partner_;  // of the cage's vertices
  std::unique_ptr<Press> press_;
};

}  // namespace

std::unique_ptr<Press> prepare_cage(const JointCage& cage, const Vector3& view, const Vector3& lines,
                                    const SmoothPanelOptions& options, const PressAmount& amount) {
  return std::make_unique<CagePress>(cage, view, lines, options, amount);
}

}  // namespace reflines
