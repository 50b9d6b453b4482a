// The parts of a ShapeOptimizer that only this library's own sources use.
#pragma once

#include <Eigen/Geometry>
#include <map>
#include <memory>
#include <optional>
#include <vector>

#include "geometry/height_field.h"
#include "reflines/shape_optimizer.h"
#include "solver/families.h"
#include "solver/region_pieces.h"
#include "solver/surface_kind.h"

namespace reflines {

struct ShapeOptimizer::Internals {
  Internals(const Positions& V, const Triangles& F, const Vector3& view_direction,
            const std::vector<Vector3>& line_directions, const ShapeOptions& options);
  void enter(double fraction, const char* stage) const;
  void forget_lines();  // drops what was read at other heights
  void continue_border(const HeightField& field, const Boundary& boundary, const Surroundings& around,
                       const Families& families);
  std::vector<Target> with_border(const std::vector<Target>& targets) const;
  void check(const Target& target) const;
  void check_family(int family) const;
  int count_faces(const Mask& triangles) const;
  void count_features(double length, int family);
  void measure(const std::vector<Target>& targets, Report& report) const;
  void tell_limit(Report& report) const;

  // Returns the second-order model that a solve would factor at the current heights: the lower triangle over the
  // unknowns, the pieces one after another.
  SparseMatrix hessian(const std::vector<Target>& targets, HessianModel model);

  // Keep the heights, with the limit of the solve that found them, and return to them.
  struct State {
    std::vector<Vector> unknowns;  // of each piece
    MoveLimit limit;
  };
  State state() const;
  void restore(const State& state);

  // These are for the surface of a cage (see ShapeOptions::B), which is one piece: the values of the unknowns; a new
  // start, and rest position of the proximity term; and a quadratic pull of the vertices towards heights along the view
  // with these weights (#V each) until a reset.
  const Vector& unknowns() const { return pieces.pieces().front()->unknowns(); }
  void rest_at(const Vector& unknowns);
  void pull_to(const Vector& heights, const Vector& weight) { pieces.pull_to(heights, weight); }

  RegionPieces pieces;
  IndexVector partner;  // see ShapeOptions
  SurfaceKind kind;
  int family_count;
  LinearSolverKind linear_solver;
  std::shared_ptr<Progress> progress;
  IndexVector face_of_triangle;
  Region region;
  Eigen::AlignedBox3d box;         // around the region's faces
  double feature_length = 0.0;     // see RegionField::feature
  std::vector<int> free_unknowns;  // indices of a cage's unknowns that can move; empty for a mesh
  std::vector<Vector> sight;       // #F of each family, or none; see Families
  std::vector<Target> border;      // continue the surroundings' curvature; see continue_curvature
  bool sampled = false;            // some triangles have the quadrature weight 0
  std::map<int, std::optional<RegionField>> region_fields,
      vertex_fields;  // of the families asked for, at the current heights
};

}  // namespace reflines
