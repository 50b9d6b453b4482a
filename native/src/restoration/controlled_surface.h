// Surfaces whose vertices follow control vertices along the view: a mesh, whose vertices control themselves, and a
// subdivision surface, which its cage controls. The restoration of a panel knows no other difference between the two.
#pragma once

#include <memory>
#include <vector>

#include "reflines/cage_optimizer.h"
#include "reflines/shape_optimizer.h"
#include "reflines/types.h"

namespace reflines {

class ControlledSurface {
 public:
  virtual ~ControlledSurface() = default;

  virtual ShapeOptimizer& optimizer() = 0;  // of the surface; valid until hold()

  virtual const Positions& positions() const = 0;          // #V x 3 of the surface at the start
  virtual const Triangles& triangles() const = 0;          // #F x 3
  virtual const Positions& control_positions() const = 0;  // #C x 3 at the start
  virtual Mask control_free() const = 0;                   // #C

  // Returns the last solve's moves of the control vertices along the view (#C); exactly 0 for those that did not move.
  virtual Vector control_move() const = 0;

  // Returns true where solves can be limited at a cost worth waiting for, see kMostBounded. Those of cages have a limit
  // for their surface, not for the control vertices.
  virtual bool can_limit() const = 0;

  // Returns true where each vertex of the surface is a control vertex.
  virtual bool controls_every_vertex() const = 0;

  // Returns the moves of the surface (#V) from those of its control vertices (#C). No vertex moves further than they.
  virtual Vector surface_move(const Vector& control_move) const = 0;

  // Returns the control vertices (#C) that move any of these vertices of the surface (#V).
  virtual Mask controls_of(const Mask& vertices) const = 0;

  // Converts values of triangles (#F) to those of the faces that the caller knows: the triangles themselves, or the
  // faces of a cage, each with the root mean square over its surface.
  virtual Vector gather_faces(const Vector& values) const = 0;

  // Holds vertices of the surface (#V) from now on, and builds the optimizer anew at the start.
  virtual void hold(const Mask& vertices) = 0;

  // Builds the optimizer anew at the start, with what was held at the beginning only.
  virtual void rebuild() = 0;

  // Reports the stages of later work to `progress`, which may be null.
  virtual void watch(std::shared_ptr<Progress> progress) = 0;
};

class MeshSurface : public ControlledSurface {
 public:
  // `shape` says what is held; throws InvalidInput as ShapeOptimizer does.
  MeshSurface(const Positions& V, const Triangles& F, const Vector3& view, std::vector<Vector3> families,
              ShapeOptions shape);

  ShapeOptimizer& optimizer() override { return *optimizer_; }
  const Positions& positions() const override { return V_; }
  const Triangles& triangles() const override { return F_; }
  const Positions& control_positions() const override { return V_; }
  Mask control_free() const override { return optimizer_->free(); }
  Vector control_move() const override;
  bool can_limit() const override;
  bool controls_every_vertex() const override { return true; }
  Vector surface_move(const Vector& control_move) const override { return control_move; }
  Mask controls_of(const Mask& vertices) const override { return vertices; }
  Vector gather_faces(const Vector& values) const override { return values; }
  void hold(const Mask& vertices) override;
  void rebuild() override;
  void watch(std::shared_ptr<Progress> progress) override;

 private:
  void build();

  Positions V_;
  Triangles F_;
  Vector3 view_;
  std::vector<Vector3> families_;
  ShapeOptions shape_;
  Mask held_;  // #V or empty: at the beginning
  std::unique_ptr<ShapeOptimizer> optimizer_;
};

class CageControlledSurface : public ControlledSurface {
 public:
  // Throws InvalidInput as CageOptimizer does.
  CageControlledSurface(Cage cage, const Positions& V, const Vector3& view, std::vector<Vector3> families,
                        CageOptions options);

  ShapeOptimizer& optimizer() override { return optimizer_->surface(); }
  const Positions& positions() const override { return surface_; }
  const Triangles& triangles() const override { return optimizer_->triangles(); }
  const Positions& control_positions() const override { return V_; }
  Mask control_free() const override { return optimizer_->cage_free(); }
  Vector control_move() const override;
  bool can_limit() const override { return false; }
  bool controls_every_vertex() const override { return false; }
  Vector surface_move(const Vector& control_move) const override { return optimizer_->influence() * control_move; }
  Mask controls_of(const Mask& vertices) const override;
  Vector gather_faces(const Vector& values) const override;

  // Returns the moves of the free control vertices (#C) that make the surface move most nearly as wanted (#V), by least
  // squares over its area.
  Vector fit(const Vector& surface_move);
  void hold(const Mask& vertices) override;
  void rebuild() override;
  void watch(std::shared_ptr<Progress> progress) override;

 private:
  void build();

  Cage cage_;
  Positions V_, surface_;
  Vector3 view_;
  std::vector<Vector3> families_;
  CageOptions options_;
  Mask held_;  // #C or empty: at the beginning
  std::unique_ptr<CageOptimizer> optimizer_;
};

}  // namespace reflines
