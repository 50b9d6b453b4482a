#include "reflines/shut_lines.h"

#include <algorithm>
#include <cmath>
#include <map>
#include <optional>
#include <string>
#include <utility>

#include "base/parallel_failure.h"
#include "base/union_find.h"
#include "geometry/bounding_box.h"
#include "geometry/next_edges.h"
#include "inspection/check_input.h"
#include "inspection/compare_values.h"
#include "inspection/gap_probe.h"
#include "inspection/region_parts.h"
#include "inspection/shut_rows.h"
#include "reflines/errors.h"
#include "reflines/gap_continuation.h"

namespace reflines {
namespace {

constexpr double kNear = 0.25;    // diagonals of a part within which its other sides lie
constexpr double kSparse = 0.05;  // diagonals of the region: lines further apart have no angle that is seen
constexpr size_t kFewest = 3;     // edges of a shut line

void check(const BesidePanel& beside, const ShutLineOptions& options) {
  for (const auto& [mark, name] :
       {std::pair(options.gap, "widest gap"), std::pair(options.uneven, "unevenness"),
        std::pair(options.flush, "flush"), std::pair(options.kink, "kink"),
        std::pair(options.line_angle, "lines' angle"), std::pair(options.line_offset, "lines' offset")})
    check_mark(mark, name);
  if (!(options.spacing > 0) || !std::isfinite(options.spacing))
    throw InvalidInput("The spacing of the lines must be a positive finite number.");
  if (beside.F.size() > 0 && (beside.F.minCoeff() < 0 || beside.F.maxCoeff() >= beside.V.rows())) {
    throw InvalidInput("The triangles beside the panel name a vertex beyond the " + std::to_string(beside.V.rows()) +
                       " that there are.");
  }
  if (beside.label.size() != 0 && beside.label.size() != beside.F.rows())
    throw InvalidInput("Each triangle beside the panel needs a label.");
}

// The panel's mesh and what lies beside as one: its own vertices and triangles come first.
struct Scene {
  Triangles F;
  RegionParts parts;
  IndexVector label;  // #F, -1 of the panel's own mesh
};

Positions append(const Positions& V, const Positions& more) {
  Positions all(V.rows() + more.rows(), 3);
  all << V, more;
  return all;
}

Scene build_scene(const Positions& V, const Triangles& F, const Mask& region, const BesidePanel& beside,
                  Eigen::Index own) {
  Scene scene;
  scene.F.resize(F.rows() + beside.F.rows(), 3);
  scene.F << F, beside.F.array() + static_cast<int>(own);
  Mask all = Mask::Constant(scene.F.rows(), false);
  all.head(F.rows()) = region;
  scene.label = IndexVector::Zero(scene.F.rows());
  scene.label.head(F.rows()).setConstant(-1);
  if (beside.label.size() > 0) scene.label.tail(beside.F.rows()) = beside.label;
  scene.parts = split_region(V, scene.F, all, kNear);
  return scene;
}

// An edge of the region's border, by its vertices, and what was measured there.
struct Found {
  GapPlace place;
  int part, label;
};
using FoundEdges = std::map<std::pair<int, int>, Found>;

// Measures the edges of one part of the region, with all vertices at V.
void measure_part(const Scene& scene, const Positions& V, int part, double gap, const LinesAcross* lines,
                  FoundEdges& found) {
  const RegionPart& own = scene.parts.list[part];
  const Positions positions = own.positions(V);
  const GapProbe probe(positions, own.F, own.around(V), V, scene.F(own.beside, Eigen::all), gap, lines);
  const auto count = static_cast<int>(probe.edges().size());
  std::vector<std::optional<GapPlace>> places(count);
  ParallelFailure failure;
#pragma omp parallel for schedule(dynamic, 16)
  for (int k = 0; k < count; ++k) failure.run([&] { places[k] = probe.measure(probe.edges()[k]); });
  failure.rethrow();
  for (int k = 0; k < count; ++k) {
    if (!places[k]) continue;
    const int source = own.beside[places[k]->source], other = scene.parts.part(source);
    if (other >= 0 && other < part) continue;  // reported from that part
    const BorderEdge& edge = probe.edges()[k];
    found[{own.vertices[edge.first], own.vertices[edge.second]}] = {*places[k], part, scene.label(source)};
  }
}

FoundEdges measure_all(const Scene& scene, const Positions& V, double gap, const LinesAcross* lines) {
  FoundEdges found;
  for (int k = 0; k < static_cast<int>(scene.parts.list.size()); ++k) measure_part(scene, V, k, gap, lines, found);
  return found;
}

// Joins edges that go on from each other without a corner beside the same surface: the lists of their numbers.
std::vector<std::vector<int>> join_edges(const Positions& V, const Edges& edges, const std::vector<Found>& found) {
  const std::vector<int> next = find_next_edges(V, edges, [&](int k, int follower) {
    const Found &one = found[k], &other = found[follower];
    return one.part == other.part && one.label == other.label && one.place.sheet == other.place.sheet;
  });
  UnionFind joined(edges.rows());
  for (int k = 0; k < edges.rows(); ++k) {
    if (next[k] >= 0) joined.unite(k, next[k]);
  }
  std::vector<std::vector<int>> lists = joined.list_sets();
  std::erase_if(lists, [](const std::vector<int>& list) { return list.size() < kFewest; });
  return lists;
}

void store(const GapPlace& place, int k, ShutMeasures& measures) {
  measures.gap(k) = place.gap;
  measures.flush(k) = place.flush;
  measures.kink(k) = place.kink;
  measures.line_angle(k) = place.lines.angle;
  measures.line_offset(k) = place.lines.offset;
}

ShutMeasures make_measures(Eigen::Index count) {
  const Vector zero = Vector::Zero(count);
  return {zero, zero, zero, zero, zero};
}

void judge(const ShutLineOptions& marks, ShutLines& lines) {
  const ShutMeasures &first = lines.before, &last = lines.after;
  const Eigen::Index count = lines.edges.rows();
  lines.passes = last.flush.array().abs() <= marks.flush && last.kink.array() <= marks.kink &&
                 last.line_angle.array() <= marks.line_angle && last.line_offset.array() <= marks.line_offset;
  for (int k = 0; k < count; ++k) {
    lines.change.push_back(sum_up({compare_values(std::abs(first.flush(k)), std::abs(last.flush(k)), marks.flush),
                                   compare_values(first.kink(k), last.kink(k), marks.kink),
                                   compare_values(first.line_angle(k), last.line_angle(k), marks.line_angle),
                                   compare_values(first.line_offset(k), last.line_offset(k), marks.line_offset)}));
  }
  for (const ShutLine& line : lines.list) {
    const double middle = 0.5 * (line.rows[0].after + line.rows[1].after);  // of the smallest and largest gap
    for (const int k : line.edges)
      lines.passes(k) = lines.passes(k) && std::abs(last.gap(k) - middle) <= 0.5 * marks.uneven;
  }
}

// Keeps the edges that are part of lines, in the lines' order, and fills in all that is reported of them.
ShutLines build_lines(const Positions& V, const FoundEdges& before, const FoundEdges& after,
                      const ShutLineOptions& options) {
  Edges edges(static_cast<Eigen::Index>(after.size()), 2);
  std::vector<Found> found;
  for (const auto& [ends, each] : after) {
    edges.row(static_cast<Eigen::Index>(found.size())) << ends.first, ends.second;
    found.push_back(each);
  }
  const std::vector<std::vector<int>> lists = join_edges(V, edges, found);
  std::vector<int> kept;
  for (const std::vector<int>& list : lists) kept.insert(kept.end(), list.begin(), list.end());
  const auto count = static_cast<Eigen::Index>(kept.size());
  ShutLines result;
  result.edges = edges(kept, Eigen::all);
  result.before = result.after = make_measures(count);
  Positions places(count, 3);
  for (int k = 0; k < count; ++k) {
    const auto was = before.find({result.edges(k, 0), result.edges(k, 1)});
    store(found[kept[k]].place, k, result.after);
    store(was == before.end() ? found[kept[k]].place : was->second.place, k, result.before);
    places.row(k) = 0.5 * (V.row(result.edges(k, 0)) + V.row(result.edges(k, 1)));
  }
  int next = 0;
  for (const std::vector<int>& list : lists) {
    ShutLine line;
    line.label = found[list.front()].label;
    for (size_t k = 0; k < list.size(); ++k) line.edges.push_back(next++);
    for (const int k : line.edges) line.length += (V.row(result.edges(k, 1)) - V.row(result.edges(k, 0))).norm();
    line.rows = list_rows(line.edges, result.before, result.after, places, options);
    result.list.push_back(std::move(line));
  }
  return result;
}

Positions take_region(const Positions& V, const Triangles& F, const Mask& region) {
  std::vector<int> vertices;
  for (int t = 0; t < F.rows(); ++t) {
    if (region(t)) vertices.insert(vertices.end(), {F(t, 0), F(t, 1), F(t, 2)});
  }
  return V(vertices, Eigen::all);
}

}  // namespace

ShutLines check_shut_lines(const Positions& before, const Positions& after, const Triangles& F, const Mask& region,
                           const BesidePanel& beside, const ShutLineOptions& options) {
  check_compared(before, after, F, region);
  check(beside, options);
  const double diagonal = bounding_box_diagonal(take_region(after, F, region));
  const double gap = options.gap > 0 ? options.gap : kAutomaticGap * diagonal;
  std::optional<LinesAcross> lines;
  if (options.view_direction.norm() > 0)
    lines.emplace(options.view_direction, options.line_direction, options.spacing, kSparse * diagonal);
  const Positions V = append(after, beside.V);
  const Scene scene = build_scene(V, F, region, beside, after.rows());
  const FoundEdges last = measure_all(scene, V, gap, lines ? &*lines : nullptr);
  const FoundEdges first =
      before == after ? last : measure_all(scene, append(before, beside.V), gap, lines ? &*lines : nullptr);
  ShutLines result = build_lines(V, first, last, options);
  result.gap = gap;
  judge(options, result);
  return result;
}

}  // namespace reflines
