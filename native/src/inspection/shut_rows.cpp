#include "inspection/shut_rows.h"

#include <cmath>

#include "inspection/compare_values.h"

namespace reflines {
namespace {

// Returns the row of the largest of `sign` times the values.
CheckRow find_extreme(const char* name, const char* unit, double sign, const std::vector<int>& edges,
                      const Vector& before, const Vector& after, const Positions& places) {
  int first = edges.front(), last = first;
  for (const int k : edges) {
    if (sign * before(k) > sign * before(first)) first = k;
    if (sign * after(k) > sign * after(last)) last = k;
  }
  return {.name = name, .unit = unit, .before = before(first), .after = after(last), .place = places.row(last)};
}

void hold_against(double mark, CheckRow& row) {
  const double before = std::abs(row.before), after = std::abs(row.after);
  row.mark = mark;
  row.passes = after <= mark;
  row.change = compare_values(before, after, mark);
}

double unevenness(const CheckRow& smallest, const CheckRow& largest, bool is_after) {
  return is_after ? largest.after - smallest.after : largest.before - smallest.before;
}

}  // namespace

std::vector<CheckRow> list_rows(const std::vector<int>& edges, const ShutMeasures& before, const ShutMeasures& after,
                                const Positions& places, const ShutLineOptions& options) {
  const auto find = [&](const char* name, const char* unit, double sign, Vector ShutMeasures::*measure) {
    return find_extreme(name, unit, sign, edges, before.*measure, after.*measure, places);
  };
  std::vector<CheckRow> rows = {find("smallest gap", "length", -1, &ShutMeasures::gap),
                                find("largest gap", "length", 1, &ShutMeasures::gap)};
  rows.push_back({.name = "uneven gap",
                  .unit = "length",
                  .before = unevenness(rows[0], rows[1], false),
                  .after = unevenness(rows[0], rows[1], true),
                  .place = rows[1].place});
  hold_against(options.uneven, rows.back());
  for (const auto& [name, sign] : {std::pair("lowest flush", -1.0), std::pair("highest flush", 1.0)}) {
    rows.push_back(find(name, "length", sign, &ShutMeasures::flush));
    hold_against(options.flush, rows.back());
  }
  rows.push_back(find("kink", "degrees", 1, &ShutMeasures::kink));
  hold_against(options.kink, rows.back());
  if (options.view_direction.norm() == 0) return rows;
  rows.push_back(find("line angle", "degrees", 1, &ShutMeasures::line_angle));
  hold_against(options.line_angle, rows.back());
  rows.push_back(find("line offset", "percent", 1, &ShutMeasures::line_offset));
  hold_against(options.line_offset, rows.back());
  return rows;
}

}  // namespace reflines
