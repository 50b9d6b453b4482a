// CGAL's fairing of the same region, continuity 1: what a user of that library gets.
#include <CGAL/Polygon_mesh_processing/fair.h>
#include <CGAL/Simple_cartesian.h>
#include <CGAL/Surface_mesh.h>
#include <benchmark/benchmark.h>

#include <vector>

#include "tests/bench/bump_cylinder.h"

namespace {

using Point = CGAL::Simple_cartesian<double>::Point_3;
using Surface = CGAL::Surface_mesh<Point>;

void cgal_fair(benchmark::State& state, int unknowns) {
  const reflines::bench::BumpCylinder problem(reflines::bench::cells_for_unknowns(unknowns));
  const reflines::Positions V = problem.positions(1.0);
  const reflines::Mask is_free = problem.optimizer(1.0)->free();
  Surface whole;
  std::vector<Surface::Vertex_index> free_vertices;
  for (Eigen::Index v = 0; v < V.rows(); ++v) {
    const auto vertex = whole.add_vertex(Point(V(v, 0), V(v, 1), V(v, 2)));
    if (is_free(v)) free_vertices.push_back(vertex);
  }
  for (const auto& t : problem.triangles().rowwise()) {
    whole.add_face(Surface::Vertex_index(t(0)), Surface::Vertex_index(t(1)), Surface::Vertex_index(t(2)));
  }
  bool done = true;
  for (auto _ : state) {
    state.PauseTiming();
    Surface surface = whole;
    state.ResumeTiming();
    done = done && CGAL::Polygon_mesh_processing::fair(
                       surface, free_vertices, CGAL::Polygon_mesh_processing::parameters::fairing_continuity(1));
  }
  state.counters["unknowns"] = static_cast<double>(free_vertices.size());
  state.counters["converged"] = done;
}
BENCHMARK_CAPTURE(cgal_fair, 10k, 10000)->Iterations(1)->Unit(benchmark::kMillisecond)->UseRealTime();

}  // namespace

BENCHMARK_MAIN();
