#include "solver/mirror_coupling.h"

#include <algorithm>
#include <string>

#include "reflines/errors.h"

namespace reflines {

void check_partners(const IndexVector& partner, Eigen::Index vertex_count) {
  const auto n = static_cast<int>(partner.size());
  if (n == 0) return;
  if (n != vertex_count) {
    throw InvalidInput("The list of mirror partners has " + std::to_string(n) + " entries for " +
                       std::to_string(vertex_count) + " vertices; give one for each, -1 where there is none.");
  }
  for (int v = 0; v < n; ++v) {
    const int other = partner(v);
    if (other == -1 || (other >= 0 && other < n && partner(other) == v)) continue;
    throw InvalidInput("The mirror partner of vertex " + std::to_string(v) + " is " + std::to_string(other) +
                       ", which is none of the " + std::to_string(n) +
                       " vertices or has another partner; use mirror_pairs, or -1 for none.");
  }
}

void hold_partners(const IndexVector& partner, Boundary& boundary) {
  const std::vector<Border> border = boundary.border;
  const Mask held = boundary.held;
  for (int v = 0; v < partner.size(); ++v) {
    if (partner(v) < 0) continue;
    boundary.border[v] = std::max(border[v], border[partner(v)]);
    if (held.size() > 0) boundary.held(v) = held(v) || held(partner(v));
  }
}

void hold_partners(const IndexVector& partner, HeightField& field) {
  const std::vector<VertexRole> role = field.role;
  for (int v = 0; v < partner.size(); ++v) {
    if (partner(v) < 0 || role[v] != VertexRole::kFree) continue;
    field.role[v] = std::max(role[v], role[partner(v)]);
    if (role[partner(v)] == VertexRole::kUnused) field.role[v] = VertexRole::kFixed;
  }
}

MoveLimit intersect_limits(const MoveLimit& limit, const IndexVector& partner) {
  MoveLimit result = limit;
  for (int v = 0; v < partner.size() && limit.exists(); ++v) {
    if (partner(v) < 0) continue;
    result.lowest(v) = std::max(limit.lowest(v), limit.lowest(partner(v)));
    result.highest(v) = std::min(limit.highest(v), limit.highest(partner(v)));
  }
  return result;
}

std::vector<int> choose_leaders(const Piece& piece) {
  const HeightField& field = piece.field;
  const auto has_partner = [&](int v) { return piece.partner.size() > 0 && piece.partner(v) >= 0; };
  const auto way = [&](int v) { return Vector2(field.xy.row(v) - field.xy.row(piece.partner(v))); };
  std::vector<int> leader(field.vertex_count(), -1);
  Vector2 across = Vector2::Zero();
  for (int v = 0; v < field.vertex_count(); ++v) {
    if (field.role[v] != VertexRole::kFree) continue;
    leader[v] = v;
    if (has_partner(v) && way(v).squaredNorm() > across.squaredNorm()) across = way(v);
  }
  for (int v = 0; v < field.vertex_count(); ++v) {
    if (leader[v] < 0 || !has_partner(v)) continue;
    const double side = way(v).dot(across);
    if (side < 0 || (side == 0 && piece.partner(v) < v)) leader[v] = piece.partner(v);
  }
  return leader;
}

}  // namespace reflines
