#include "restoration/controlled_surface.h"

#include <utility>

#include "reflines/solve_panel.h"

namespace reflines {
MeshSurface::MeshSurface(const Positions& V, const Triangles& F, const Vector3& view, std::vector<Vector3> families,
                         ShapeOptions shape)
    : V_(V), F_(F), view_(view), families_(std::move(families)), shape_(std::move(shape)), held_(shape_.held) {
  build();
}

void MeshSurface::build() { optimizer_ = std::make_unique<ShapeOptimizer>(V_, F_, view_, families_, shape_); }

Vector MeshSurface::control_move() const {
  const ImagePlane& frame = optimizer_->frame();
  Vector move = frame.heights(optimizer_->positions()) - frame.heights(V_);
  // Heights at two places are rounded differently: of mirror images the second gets the bits of the first.
  for (int v = 0; v < shape_.partner.size(); ++v) {
    if (shape_.partner(v) > v) move(shape_.partner(v)) = move(v);
  }
  return move;
}

bool MeshSurface::can_limit() const { return optimizer_->region().free <= kMostBounded; }

void MeshSurface::hold(const Mask& vertices) {
  shape_.held = shape_.held.size() > 0 ? Mask(shape_.held || vertices) : vertices;
  build();
}

void MeshSurface::rebuild() {
  shape_.held = held_;
  build();
}

void MeshSurface::watch(std::shared_ptr<Progress> progress) {
  shape_.progress = std::move(progress);
  optimizer_->watch(shape_.progress);
}

CageControlledSurface::CageControlledSurface(Cage cage, const Positions& V, const Vector3& view,
                                             std::vector<Vector3> families, CageOptions options)
    : cage_(std::move(cage)),
      V_(V),
      view_(view),
      families_(std::move(families)),
      options_(std::move(options)),
      held_(options_.held) {
  build();
  surface_ = optimizer_->surface().positions();
}

void CageControlledSurface::build() {
  optimizer_ = std::make_unique<CageOptimizer>(cage_, V_, view_, families_, options_);
}

Vector CageControlledSurface::control_move() const {
  const ImagePlane& frame = optimizer_->surface().frame();
  return frame.heights(optimizer_->cage_positions()) - frame.heights(V_);
}

Vector CageControlledSurface::gather_faces(const Vector& values) const {
  const IndexVector& parent = optimizer_->parent();
  const Vector area = optimizer_->surface().area();
  Vector squares = Vector::Zero(cage_.face_offsets.size() - 1), areas = squares;
  for (Eigen::Index t = 0; t < values.size(); ++t) {
    squares(parent(t)) += area(t) * values(t) * values(t);
    areas(parent(t)) += area(t);
  }
  return (squares.array() / areas.array().max(1e-300)).sqrt();
}

Vector CageControlledSurface::fit(const Vector& surface_move) {
  optimizer().reset();
  const Vector area = optimizer().area();
  Vector weight = Vector::Zero(surface_move.size());
  for (Eigen::Index t = 0; t < area.size(); ++t) {
    for (const int v : triangles().row(t)) weight(v) += area(t) / 3;
  }
  optimizer_->fit(optimizer().heights() + surface_move, weight);
  const Vector move = control_move();
  optimizer().reset();
  return move;
}

Mask CageControlledSurface::controls_of(const Mask& vertices) const {
  return (optimizer_->influence().transpose() * vertices.cast<double>().matrix()).array() > 0;
}

void CageControlledSurface::hold(const Mask& vertices) {
  const Mask controls = controls_of(vertices);
  options_.held = options_.held.size() > 0 ? Mask(options_.held || controls) : controls;
  build();
}

void CageControlledSurface::rebuild() {
  options_.held = held_;
  build();
}

void CageControlledSurface::watch(std::shared_ptr<Progress> progress) {
  options_.shape.progress = std::move(progress);
  optimizer().watch(options_.shape.progress);
}

}  // namespace reflines
