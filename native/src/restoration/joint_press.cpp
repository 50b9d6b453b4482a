#include "restoration/joint_press.h"

#include <algorithm>
#include <utility>

#include "base/union_find.h"
#include "restoration/press_rules.h"
#include "restoration/region_result.h"
#include "restoration/used_vertices.h"
#include "solver/mirror_coupling.h"

namespace reflines {
namespace {

// Returns the amount for the vertices of a panel that are in faces.
PressAmount narrow(const JointSide& side, const JointPanel& panel, PressAmount amount) {
  if (amount.limit_range.exists() && !panel.cage) {
    const UsedVertices used = find_used_vertices(panel.F, static_cast<int>(panel.V.rows()));
    amount.limit_range = {amount.limit_range.lowest(used.index), amount.limit_range.highest(used.index)};
  }
  amount.limit_range = intersect_limits(amount.limit_range, side.partner());
  return amount;
}

}  // namespace

JointPress::JointPress(std::vector<JointPanel> panels, const std::vector<PressAmount>& amounts) {
  for (JointPanel& panel : panels)
    panels_.push_back(panel.cage ? read_surface(panel) : CagePanel{std::move(panel), {}});
  for (size_t k = 0; k < panels_.size(); ++k) sides_.push_back(std::make_unique<JointSide>(panels_[k], amounts[k]));
  for (size_t k = 0; k < sides_.size(); ++k) sides_[k]->face(others_of(k));
  widen_flaws();
}

std::vector<SmoothPanelResult> JointPress::run(std::vector<PressAmount> amounts) {
  for (size_t k = 0; k < sides_.size(); ++k) amounts[k] = narrow(*sides_[k], panels_[k].panel, amounts[k]);
  std::vector<SmoothPanelResult> results = press_jointly(amounts);
  for (size_t k = 0; k < sides_.size(); ++k) {
    if (!sides_[k]->is_cage()) results[k].positions = widen(k, results[k].positions);
  }
  return results;
}

Positions JointPress::widen(size_t k, const Positions& used_positions) const {
  Positions all = panels_[k].panel.V;
  all(find_used_vertices(panels_[k].panel.F, static_cast<int>(all.rows())).index, Eigen::all) = used_positions;
  return all;
}

// Returns the others at present, or at fractions of their moves.
Skin JointPress::others_of(size_t own, const std::vector<double>& fractions) const {
  Eigen::Index vertices = 0, triangles = 0;
  std::vector<Skin> skins;
  for (size_t k = 0; k < sides_.size(); ++k) {
    if (k == own) continue;
    skins.push_back(sides_[k]->skin(fractions.empty() ? 1 : fractions[k]));
    vertices += skins.back().V.rows();
    triangles += skins.back().F.rows();
  }
  Skin all{Positions(vertices, 3), Triangles(triangles, 3)};
  vertices = triangles = 0;
  for (const Skin& skin : skins) {
    all.V.middleRows(vertices, skin.V.rows()) = skin.V;
    all.F.middleRows(triangles, skin.F.rows()) = skin.F.array() + static_cast<int>(vertices);
    vertices += skin.V.rows();
    triangles += skin.F.rows();
  }
  return all;
}

// Gives the panels that face each other, directly or by others, the size of all of them.
void JointPress::widen_flaws() {
  UnionFind joined(static_cast<int>(sides_.size()));
  for (size_t k = 0; k < sides_.size(); ++k) {
    for (int v = 0; v < sides_[k]->joint().size(); ++v) {
      const Across across = sides_[k]->joint()(v) ? find_across(k, v) : Across{};
      if (across.side >= 0) joined.unite(static_cast<int>(k), across.side);
    }
  }
  std::vector<Eigen::AlignedBox3d> boxes(sides_.size());
  for (size_t k = 0; k < sides_.size(); ++k) boxes[joined.find(static_cast<int>(k))].extend(sides_[k]->box());
  for (size_t k = 0; k < sides_.size(); ++k)
    sides_[k]->widen_flaws(boxes[joined.find(static_cast<int>(k))].diagonal().norm());
}

// Returns the turns of the joint sides as all are at present.
std::vector<Turn> JointPress::find_turns(double lengths) const {
  std::vector<Turn> turns(sides_.size());
  for (size_t k = 0; k < sides_.size(); ++k) {
    if (is_joint(k)) turns[k] = sides_[k]->find_turn(others_of(k), lengths);
  }
  return turns;
}

void JointPress::turn_after() {
  const std::vector<Turn> turns = find_turns(kRules.border.turned_after);
  for (size_t k = 0; k < sides_.size(); ++k) {
    if (is_joint(k)) sides_[k]->turn_after(turns[k].change);
  }
}

// Begins again with the sides turned by the kinks that a press has left; returns whether there are any. What a limit
// has left of a dent is none.
bool JointPress::begin_turned() {
  if (is_limited()) return false;
  const std::vector<Turn> turns = find_turns(kRules.border.turned_before);
  const auto is_kink = [](const Turn& turn) { return turn.degrees > kRules.visible; };
  if (std::none_of(turns.begin(), turns.end(), is_kink)) return false;
  for (size_t k = 0; k < sides_.size(); ++k) {
    if (is_joint(k)) sides_[k]->begin_turned(is_kink(turns[k]) ? turns[k].change : 0 * turns[k].change);
  }
  return true;
}

// Finds the nearest rim across from a vertex of a rim, by the shapes at the start.
JointPress::Across JointPress::find_across(size_t own, int v) const {
  Across best;
  for (size_t k = 0; k < sides_.size(); ++k) {
    if (k == own) continue;
    const RimPlace found = sides_[k]->find_rim(sides_[own]->place(v), kRules.joint.across * sides_[own]->gap());
    if (found.first < 0 || (best.side >= 0 && found.distance >= best.place.distance)) continue;
    best = {static_cast<int>(k), found};
  }
  return best;
}

// Returns by how much more a vertex of a joint rim is to move, so that both sides of the gap move by the mean of what
// they found; where the other side is held, by what that does.
double JointPress::find_difference(size_t own, int v) const {
  const JointSide& side = *sides_[own];
  const auto [number, place] = find_across(own, v);
  if (side.is_firm()) return 0;
  if (number < 0 || !is_joint(number)) return -side.shift(v);
  const JointSide& other = *sides_[number];
  const auto between = [fraction = place.fraction](double a, double b) { return (1 - fraction) * a + fraction * b; };
  const double movable = other.is_firm() ? 0 : between(other.joint()(place.first), other.joint()(place.second));
  const double across = between(other.shift(place.first), other.shift(place.second));
  return (1 - 0.5 * movable) * (across * other.axis().dot(side.axis()) - side.shift(v));
}

// Returns the part of a side in making its flush even: half, where the other side takes the other half. Towards a mesh
// a cage leaves all to it, which can follow waves that a cage cannot. What does not move with the other side has no
// part.
FlushPart JointPress::find_flush_part(size_t own) const {
  const Eigen::Index count = sides_[own]->joint().size();
  FlushPart part{IndexVector::Constant(count, -1), Vector::Zero(count)};
  for (int v = 0; v < count; ++v) {
    const Across across = sides_[own]->joint()(v) ? find_across(own, v) : Across{};
    if (across.side < 0 || !evens_flush(across.side)) continue;
    part.across(v) = across.side;
    const bool cage = sides_[own]->is_cage(), other = sides_[across.side]->is_cage();
    part.taken(v) = cage == other ? 0.5 : other ? 1 : 0;
  }
  return part;
}

// Returns what find_uneven_flush of each side does, after fractions of the moves or at present; without change where it
// is not asked for.
std::vector<UnevenFlush> JointPress::find_uneven_flush(const std::vector<double>& fractions) const {
  std::vector<UnevenFlush> found(sides_.size());
  for (size_t k = 0; k < sides_.size(); ++k) {
    if (!evens_flush(k)) continue;
    found[k] =
        sides_[k]->find_uneven_flush(others_of(k, fractions), find_flush_part(k), fractions.empty() ? 1 : fractions[k]);
  }
  return found;
}

// Begins with the flush even; returns whether it was uneven somewhere. It is measured once more after a press, which
// leaves it as it is: beside a dent that goes on across the gap, the fits that tell it err.
bool JointPress::even_flush(const std::vector<PressAmount>& amounts) {
  const auto is_even = [](const UnevenFlush& each) { return each.change.isZero(0); };
  std::vector<UnevenFlush> found = find_uneven_flush({});
  if (std::all_of(found.begin(), found.end(), is_even)) return false;
  find_moves(amounts);
  found = find_uneven_flush({});
  for (size_t k = 0; k < sides_.size(); ++k) {
    if (evens_flush(k)) {
      sides_[k]->begin_evened(found[k].change);
    } else if (is_joint(k)) {
      sides_[k]->begin(amounts[k]);
    }
  }
  return !std::all_of(found.begin(), found.end(), is_even);
}

// Tells how uneven the flush was, and is after these moves.
void JointPress::tell_flush(const std::vector<PressAmount>& amounts, std::vector<SmoothPanelResult>& results) const {
  std::vector<double> fractions;
  for (const PressAmount& amount : amounts) fractions.push_back(amount.strength);
  const std::vector<UnevenFlush> before = find_uneven_flush(std::vector<double>(sides_.size(), 0.0)),
                                 after = find_uneven_flush(fractions);
  for (size_t k = 0; k < sides_.size(); ++k) {
    results[k].report.flush_before = before[k].most;
    results[k].report.flush_after = after[k].most;
  }
}

void JointPress::even_rims() {
  std::vector<Vector> changes(sides_.size());
  for (size_t k = 0; k < sides_.size(); ++k) {
    changes[k] = Vector::Zero(sides_[k]->joint().size());
    for (int v = 0; v < changes[k].size(); ++v) {
      if (sides_[k]->joint()(v)) changes[k](v) = find_difference(k, v);
    }
  }
  for (size_t k = 0; k < sides_.size(); ++k) {
    if (is_joint(k) && !sides_[k]->is_firm()) sides_[k]->even(changes[k]);
  }
  if (!is_limited()) return;
  for (size_t k = 0; k < sides_.size(); ++k) {  // all of them, so that rims still move alike
    if (is_joint(k) && !sides_[k]->is_firm()) sides_[k]->saturate();
  }
}

bool JointPress::is_limited() const {
  return std::any_of(sides_.begin(), sides_.end(),
                     [](const auto& side) { return side->is_joint() && !side->is_firm() && side->is_beyond_limit(); });
}

// Lets cages take what they can of their moves, a second time after both sides of each gap were evened, and then all
// others follow their rims.
void JointPress::settle_cages() {
  std::vector<JointSide*> cages;
  for (const auto& side : sides_) {
    if (side->is_cage() && side->is_joint()) cages.push_back(side.get());
  }
  if (cages.empty()) return;
  for (JointSide* cage : cages) cage->take_shape();
  even_rims();
  for (JointSide* cage : cages) {
    cage->take_shape();
    cage->make_firm();
  }
  even_rims();
}

void JointPress::find_moves(const std::vector<PressAmount>& amounts) {
  std::vector<Skin> others;
  for (size_t k = 0; k < sides_.size(); ++k) others.push_back(others_of(k));
  for (size_t k = 0; k < sides_.size(); ++k) {
    if (is_joint(k)) sides_[k]->press(others[k], amounts[k]);
  }
  even_rims();
}

// Begins the moves; returns whether that makes a flush even or none is to be.
bool JointPress::begin(const std::vector<PressAmount>& amounts, Flush flush) {
  for (size_t k = 0; k < sides_.size(); ++k) {
    if (is_joint(k)) sides_[k]->begin(amounts[k]);
  }
  return flush == Flush::kStays || even_flush(amounts);
}

void JointPress::move_jointly(const std::vector<PressAmount>& amounts, Kinks kinks) {
  find_moves(amounts);
  if (kinks == Kinks::kGo) {
    if (begin_turned()) find_moves(amounts);
    for (int pass = 0; pass < kRules.joint.turns_after; ++pass) turn_after();
  }
  settle_cages();
}

// Judges the moves of the joint sides; returns whether none has a worse place, or one that turned kinks made bad.
bool JointPress::judge(const std::vector<PressAmount>& amounts, Kinks kinks, std::vector<SmoothPanelResult>& results) {
  bool good = true;
  for (size_t k = 0; k < sides_.size(); ++k) {
    if (!is_joint(k)) continue;
    results[k] = sides_[k]->judge(amounts[k]);
    const HealedFlaws& healed = results[k].report.healed;
    good = good && results[k].report.applied && !has_worse_place(healed);
    if (kinks == Kinks::kGo) good = good && healed.worse.after <= kRules.joint.kink_worse * healed.worst_before;
  }
  return good;
}

std::vector<SmoothPanelResult> JointPress::press_jointly(const std::vector<PressAmount>& amounts) {
  std::vector<SmoothPanelResult> results(sides_.size());
  begin(amounts, Flush::kStays);  // a rim that faces others with held vertices alone is none
  for (size_t k = 0; k < sides_.size(); ++k) {
    if (!is_joint(k)) results[k] = sides_[k]->press_alone(amounts[k]);
  }
  for (const Flush flush : {Flush::kEven, Flush::kStays}) {
    for (const Kinks kinks : {Kinks::kGo, Kinks::kStay}) {
      if (!begin(amounts, flush)) break;
      move_jointly(amounts, kinks);
      if (!judge(amounts, kinks, results)) continue;
      tell_flush(amounts, results);
      return results;
    }
  }
  for (size_t k = 0; k < sides_.size(); ++k) {
    if (!is_joint(k)) continue;
    sides_[k]->begin(amounts[k]);
    results[k] = sides_[k]->press_clamped(amounts[k]);
  }
  tell_flush(amounts, results);
  return results;
}

}  // namespace reflines
