// The height-field pieces of a region, read and written by the region's indices of vertices and triangles.
#pragma once

#include <memory>
#include <vector>

#include "reflines/image_plane.h"
#include "reflines/move_limit.h"
#include "reflines/region_field.h"
#include "solver/limited_move.h"
#include "solver/piece_problem.h"

namespace reflines {

class RegionPieces {
 public:
  // Takes V (#V x 3) and F (#F x 3) of the region, and the frame in which its pieces are height fields; pieces are
  // added later.
  RegionPieces(const Positions& V, const Triangles& F, const ImagePlane& frame);

  void add(std::unique_ptr<PieceProblem> piece) { pieces_.push_back(std::move(piece)); }
  const std::vector<std::unique_ptr<PieceProblem>>& pieces() const { return pieces_; }
  const PieceProblem& piece_of(int number) const;  // that has this number in RegionField::piece
  const ImagePlane& frame() const { return frame_; }
  const Positions& start() const { return V_; }  // #V x 3, as handed in
  const Triangles& triangles() const { return F_; }
  int triangle_count() const { return static_cast<int>(F_.rows()); }
  int vertex_count() const { return static_cast<int>(V_.rows()); }

  void set_limit(const MoveLimit& limit);  // from the next solve on; see PieceProblem
  const MoveLimit& limit() const { return limit_; }
  IndexVector at_limit() const;  // #V: -1 or 1 where a free vertex lies at its lowest or highest move, else 0

  PlanePositions xy() const;       // #V x 2
  PlanePositions centers() const;  // #F x 2
  Vector area() const;             // #F
  Mask active() const;             // #F
  Mask changeable() const;         // #F
  Mask free() const;               // #V
  Mask hidden() const;             // #F: see PieceProblem

  // These depend on the current heights; rows of triangles in no piece are zero.
  Vector heights() const;                                               // #V, in the image plane of the world's origin
  Positions positions() const;                                          // #V x 3
  Vector theta(int family) const;                                       // #F
  PlaneVectors field(int family) const;                                 // #F x 2
  PlaneVectors smooth_field(const SmoothOptions& options, int family);  // #F x 2
  Mask features(int family, double length);                             // #F
  RegionField region_field(int family, double feature_length);
  RegionField vertex_field(int family) const;  // see ShapeOptimizer

  PlaneVectors start_field(int family) const;           // #F x 2, at the start
  double strong_size(const PlaneVectors& field) const;  // of one of the region's fields: see find_strong_size

  // Reads the lines of a piecewise surface with other heights (#V); weight 0 (#V) marks unknown heights. Rows of
  // triangles that depend on an unknown height keep their lines and have weight 0.
  void read_lines(const Vector& heights, const Vector& weight, Target& target, Vector& theta) const;

  void stay_near(const Vector& heights);  // #V, see ShapeOptimizer
  // Pulls the only piece towards heights (#V) with these weights (#V).
  void pull_to(const Vector& heights, const Vector& weight);

 private:
  template <typename Rows, typename Read>
  Rows gather(int columns, const Read& read) const;
  MoveRange range(int vertex) const;
  Vector response(int family, const Mask& features) const;  // #F, of the lines at the start; see RegionField

  ImagePlane frame_;
  Positions V_;
  Triangles F_;
  MoveLimit limit_;
  std::vector<std::unique_ptr<PieceProblem>> pieces_;
};

}  // namespace reflines
