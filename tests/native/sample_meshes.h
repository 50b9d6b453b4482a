// Meshes small enough to draw by hand, over the unit square of the xy plane, seen from +z.
#pragma once

#include <cmath>
#include <functional>
#include <numbers>
#include <random>

#include "geometry/height_field.h"
#include "reflines/types.h"

namespace reflines::samples {

struct Mesh {
  Positions V;
  Triangles F;
};

using Height = std::function<double(double, double)>;

// n x n cells over [0, 1]^2, every cell cut along the same diagonal; inner vertices moved by up to `jitter` cells.
inline Mesh grid(int n, double jitter = 0.0, unsigned seed = 1) {
  Mesh mesh;
  mesh.V.resize((n + 1) * (n + 1), 3);
  mesh.F.resize(2 * n * n, 3);
  std::mt19937 random(seed);
  std::uniform_real_distribution<double> offset(-jitter, jitter);
  for (int j = 0; j <= n; ++j) {
    for (int i = 0; i <= n; ++i) {
      const bool inner = i > 0 && i < n && j > 0 && j < n;
      const double dx = inner ? offset(random) : 0, dy = inner ? offset(random) : 0;
      mesh.V.row(j * (n + 1) + i) << (i + dx) / n, (j + dy) / n, 0;
    }
  }
  for (int j = 0, t = 0; j < n; ++j) {
    for (int i = 0; i < n; ++i) {
      const int a = j * (n + 1) + i;
      mesh.F.row(t++) << a, a + 1, a + n + 2;
      mesh.F.row(t++) << a, a + n + 2, a + n + 1;
    }
  }
  return mesh;
}

// Vertex 0 with `spokes` triangles around it, and around those two more rings of twice as many, each 0.1 wide.
inline Mesh disc(int spokes) {
  Mesh mesh;
  mesh.V = Positions::Zero(1 + 3 * spokes, 3);
  mesh.F.resize(5 * spokes, 3);
  for (int ring = 0, t = 0; ring < 3; ++ring) {
    for (int i = 0; i < spokes; ++i) {
      const int inner = 1 + (ring - 1) * spokes, outer = 1 + ring * spokes, next = (i + 1) % spokes;
      const double angle = 2 * std::numbers::pi * i / spokes;
      mesh.V.row(outer + i) << 0.1 * (ring + 1) * std::cos(angle), 0.1 * (ring + 1) * std::sin(angle), 0;
      mesh.F.row(t++) << (ring == 0 ? 0 : inner + i), outer + i, outer + next;
      if (ring > 0) mesh.F.row(t++) << inner + i, outer + next, inner + next;
    }
  }
  return mesh;
}

// The grid with a vertex of valence three put into every `every`-th triangle.
inline Mesh grid_with_valence_three(int n, int every) {
  Mesh mesh = grid(n, 0.1);
  const int triangles = static_cast<int>(mesh.F.rows());
  int added = 0;
  for (int t = 0; t < triangles; t += every) ++added;
  int vertex = static_cast<int>(mesh.V.rows()), next = triangles;
  mesh.V.conservativeResize(vertex + added, 3);
  mesh.F.conservativeResize(triangles + 2 * added, 3);
  for (int t = 0; t < triangles; t += every, ++vertex) {
    const int a = mesh.F(t, 0), b = mesh.F(t, 1), c = mesh.F(t, 2);
    mesh.V.row(vertex) = (mesh.V.row(a) + mesh.V.row(b) + mesh.V.row(c)) / 3;
    mesh.F.row(t) << a, b, vertex;
    mesh.F.row(next++) << b, c, vertex;
    mesh.F.row(next++) << c, a, vertex;
  }
  return mesh;
}

inline Mesh lifted(Mesh mesh, const Height& height) {
  for (int v = 0; v < mesh.V.rows(); ++v) mesh.V(v, 2) = height(mesh.V(v, 0), mesh.V(v, 1));
  return mesh;
}

// The mesh as a height field seen from +z with lines along +y (so that the frame is that of the coordinates).
inline HeightField height_field(const Mesh& mesh, Border border = Border::kFixed) {
  Boundary boundary;
  boundary.border.assign(mesh.V.rows(), border);
  return make_height_field(mesh.V, mesh.F, ImagePlane(Vector3::UnitZ(), Vector3::UnitY()), boundary);
}

}  // namespace reflines::samples
