// The press of several panels that face each other, prepared to be repeated with other amounts.
#pragma once

#include <memory>
#include <vector>

#include "reflines/joint_smoother.h"
#include "restoration/joint_side.h"

namespace reflines {

class JointPress {
 public:
  // Takes what JointSmoother does, checked; of the amounts their progress alone.
  JointPress(std::vector<JointPanel> panels, const std::vector<PressAmount>& amounts);

  std::vector<SmoothPanelResult> run(std::vector<PressAmount> amounts);

 private:
  enum class Kinks { kGo, kStay };  // along gaps
  enum class Flush { kEven, kStays };

  struct Across {
    int side = -1;
    RimPlace place{};
  };

  Positions widen(size_t k, const Positions& used_positions) const;
  Skin others_of(size_t own, const std::vector<double>& fractions = {}) const;
  void widen_flaws();
  bool is_joint(size_t k) const { return sides_[k]->is_joint(); }
  bool is_limited() const;
  bool evens_flush(size_t k) const { return is_joint(k) && panels_[k].panel.options.even_flush; }
  FlushPart find_flush_part(size_t own) const;
  std::vector<UnevenFlush> find_uneven_flush(const std::vector<double>& fractions) const;
  bool even_flush(const std::vector<PressAmount>& amounts);
  void tell_flush(const std::vector<PressAmount>& amounts, std::vector<SmoothPanelResult>& results) const;
  std::vector<Turn> find_turns(double lengths) const;
  void turn_after();
  bool begin_turned();
  Across find_across(size_t own, int v) const;
  double find_difference(size_t own, int v) const;
  void even_rims();
  void settle_cages();
  void find_moves(const std::vector<PressAmount>& amounts);
  bool begin(const std::vector<PressAmount>& amounts, Flush flush);
  void move_jointly(const std::vector<PressAmount>& amounts, Kinks kinks);
  bool judge(const std::vector<PressAmount>& amounts, Kinks kinks, std::vector<SmoothPanelResult>& results);
  std::vector<SmoothPanelResult> press_jointly(const std::vector<PressAmount>& amounts);

  std::vector<CagePanel> panels_;
  std::vector<std::unique_ptr<JointSide>> sides_;  // refer to panels_
};

}  // namespace reflines
