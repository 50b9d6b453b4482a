#include "restoration/merged_report.h"

#include <algorithm>
#include <cmath>

namespace reflines {
namespace {

// Adds notes; of one kind their counts are added and the larger change is reported.
void add_notes(const std::vector<Note>& more, std::vector<Note>& notes) {
  for (const Note& note : more) {
    const auto same = std::find_if(notes.begin(), notes.end(), [&](const Note& own) { return own.kind == note.kind; });
    if (same == notes.end()) {
      notes.push_back(note);
      continue;
    }
    same->count += note.count;
    if (std::abs(note.after) > std::abs(same->after)) {
      same->before = note.before;
      same->after = note.after;
    }
  }
}

void add_region(const Region& more, Region& region) {
  for (int Region::*count : {&Region::triangles, &Region::free, &Region::fixed, &Region::clamped, &Region::pieces,
                             &Region::silhouettes, &Region::turned_away, &Region::unused_pieces, &Region::creases,
                             &Region::marked_creases, &Region::hidden, &Region::features})
    region.*count += more.*count;
  region.closed = region.closed && more.closed;
  add_notes(more.notes, region.notes);
}

// Adds measures of a part, with its fraction of the area, to means that begin at 0.
void add_means(const std::vector<double>& more, double fraction, std::vector<double>& means) {
  means.resize(more.size(), 0.0);
  for (size_t k = 0; k < more.size(); ++k) means[k] += fraction * more[k];
}

void add_scores(const std::vector<LineScore>& more, double fraction, std::vector<LineScore>& means) {
  means.resize(more.size());
  for (size_t k = 0; k < more.size(); ++k) {
    means[k].shift += fraction * more[k].shift;
    means[k].turn += fraction * more[k].turn;
  }
}

// Returns the place where lines got worse by more.
WorsePlace choose_worse(const WorsePlace& one, const WorsePlace& other) {
  if (one.light < 0 || other.light < 0) return one.light < 0 ? other : one;
  return other.after - other.before > one.after - one.before ? other : one;
}

void add_healed(const HealedFlaws& more, double fraction, HealedFlaws& healed) {
  const double was = healed.area, added = fraction * more.area, all = was + added;
  const auto mean = [&](double a, double b) {
    return std::sqrt((was * a * a + added * b * b) / std::max(all, 1e-300));
  };
  healed.mean_before = mean(healed.mean_before, more.mean_before);
  healed.mean_after = mean(healed.mean_after, more.mean_after);
  healed.area = all;
  healed.worst_before = std::max(healed.worst_before, more.worst_before);
  healed.worst_after = std::max(healed.worst_after, more.worst_after);
  healed.worse = choose_worse(healed.worse, more.worse);
  healed.worse_for_judges = choose_worse(healed.worse_for_judges, more.worse_for_judges);
}

void add_totals(const SmoothPanelReport& more, SmoothPanelReport& total) {
  total.work += more.work;
  for (double SmoothPanelReport::*most :
       {&SmoothPanelReport::length, &SmoothPanelReport::limit, &SmoothPanelReport::largest_move,
        &SmoothPanelReport::largest_control_move, &SmoothPanelReport::flush_before, &SmoothPanelReport::flush_after})
    total.*most = std::max(total.*most, more.*most);
  for (int SmoothPanelReport::*count : {&SmoothPanelReport::limited, &SmoothPanelReport::bumps,
                                        &SmoothPanelReport::mirrored, &SmoothPanelReport::held_faces})
    total.*count += more.*count;
  total.longer_waves = total.longer_waves || more.longer_waves;
  total.applied = total.applied || more.applied;
  add_notes(more.notes, total.notes);
  add_region(more.region, total.region);
}

}  // namespace

SmoothPanelReport merge_reports(const std::vector<PressedPart>& parts, Eigen::Index triangle_count) {
  SmoothPanelReport total;
  total.solve = parts.front().report.solve;
  total.applied = false;
  total.region.closed = true;
  total.line_deviation = total.verdict = Vector::Zero(triangle_count);
  double area = 0;
  for (const PressedPart& part : parts) area += part.area;
  for (const PressedPart& part : parts) {
    const double fraction = part.area / std::max(area, 1e-300);
    add_totals(part.report, total);
    add_scores(part.report.score_before, fraction, total.score_before);
    add_scores(part.report.score_after, fraction, total.score_after);
    add_means(part.report.unevenness_before, fraction, total.unevenness_before);
    add_means(part.report.unevenness_after, fraction, total.unevenness_after);
    add_means(part.report.seen, fraction, total.seen);
    add_healed(part.report.healed, fraction, total.healed);
    for (Vector SmoothPanelReport::*field : {&SmoothPanelReport::line_deviation, &SmoothPanelReport::verdict}) {
      if ((part.report.*field).size() == static_cast<Eigen::Index>(part.triangles.size()))
        (total.*field)(part.triangles) = part.report.*field;
    }
  }
  return total;
}

}  // namespace reflines
