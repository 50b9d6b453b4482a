// What a ShapeOptimizer's region looks like now: the pieces' shapes and lines, gathered by the region's own numbers.
#include "native/errors.h"
#include "native/piece_problem.h"
#include "native/shape_optimizer.h"

namespace reflines {

Vector ShapeOptimizer::heights() const {
  Vector result = frame_.heights(V_);
  for (const auto& piece : pieces_) {
    const std::vector<int>& vertex = piece->piece().vertex;
    for (size_t v = 0; v < vertex.size(); ++v) {
      result(vertex[v]) += piece->heights()(static_cast<int>(v)) - piece->piece().field.z(static_cast<int>(v));
    }
  }
  return result;
}

Positions ShapeOptimizer::positions() const {
  Positions result = V_;
  for (const auto& piece : pieces_) {
    const std::vector<int>& vertex = piece->piece().vertex;
    for (int v = 0; v < static_cast<int>(vertex.size()); ++v) {
      const double move = piece->heights()(v) - piece->piece().field.z(v);
      if (piece->piece().field.role[v] == VertexRole::kFree && move != 0)
        result.row(vertex[v]) += move * frame_.z().transpose();
    }
  }
  return result;
}

Mask ShapeOptimizer::free() const {
  Mask result = Mask::Constant(V_.rows(), false);
  for (const auto& piece : pieces_) {
    for (size_t v = 0; v < piece->piece().vertex.size(); ++v) {
      if (piece->piece().field.role[v] == VertexRole::kFree) result(piece->piece().vertex[v]) = true;
    }
  }
  return result;
}

Mask ShapeOptimizer::active() const {
  Mask result = Mask::Constant(triangle_count_, false);
  for (const auto& piece : pieces_) {
    for (int t : piece->piece().field.source) result(t) = true;
  }
  return result;
}

Mask ShapeOptimizer::changeable() const {
  Mask result = Mask::Constant(triangle_count_, false);
  for (const auto& piece : pieces_) {
    const Mask own = piece->changeable();
    for (int t = 0; t < own.size(); ++t) result(piece->piece().field.source[t]) = own(t);
  }
  return result;
}

PlanePositions ShapeOptimizer::xy() const { return frame_.project(V_); }

PlanePositions ShapeOptimizer::centers() const {
  const PlanePositions xy = this->xy();
  PlanePositions result(triangle_count_, 2);
  for (int t = 0; t < triangle_count_; ++t)
    result.row(t) = (xy.row(F_(t, 0)) + xy.row(F_(t, 1)) + xy.row(F_(t, 2))) / 3.0;
  return result;
}

Vector ShapeOptimizer::area() const {
  Vector result = Vector::Zero(triangle_count_);
  for (const auto& piece : pieces_) {
    const HeightField& own = piece->piece().field;
    for (int t = 0; t < own.triangle_count(); ++t) result(own.source[t]) = own.area(t);
  }
  return result;
}

Vector ShapeOptimizer::theta(int family) const {
  Vector result = Vector::Zero(triangle_count_);
  for (const auto& piece : pieces_) {
    const Vector& own = piece->field(family).theta;
    for (int t = 0; t < own.size(); ++t) result(piece->piece().field.source[t]) = own(t);
  }
  return result;
}

PlaneVectors ShapeOptimizer::field(int family) const {
  PlaneVectors result = PlaneVectors::Zero(triangle_count_, 2);
  for (const auto& piece : pieces_) {
    const PlaneVectors own = piece->field(family).gradient;
    for (int t = 0; t < own.rows(); ++t) result.row(piece->piece().field.source[t]) = own.row(t);
  }
  return result;
}

const RegionField& ShapeOptimizer::region_field(int family) {
  check_family(family);
  if (!region_field_ || region_field_->family != family) region_field_ = make_region_field(family);
  return *region_field_;
}

RegionField ShapeOptimizer::make_region_field(int family) {
  RegionField result{xy(),
                     F_,
                     Eigen::VectorXi::Constant(triangle_count_, -1),
                     Mask::Constant(triangle_count_, false),
                     area(),
                     centers(),
                     theta(family),
                     field(family),
                     Vector::Zero(V_.rows()),
                     PlaneVectors::Zero(V_.rows(), 2),
                     PlaneVectors::Zero(V_.rows(), 2),
                     family};
  for (size_t k = 0; k < pieces_.size(); ++k) {
    pieces_[k]->add_vertex_field(result);
    const Mask feature = pieces_[k]->features(feature_length_, family);
    for (int t = 0; t < feature.size(); ++t) {
      const int row = pieces_[k]->piece().field.source[t];
      result.piece(row) = static_cast<int>(k);
      result.feature(row) = feature(t);
    }
  }
  return result;
}

ShapeOptimizer::Lines ShapeOptimizer::lines_of(const Vector& heights, const Vector& weight, int family) {
  check_family(family);
  if (heights.size() != V_.rows() || weight.size() != V_.rows()) {
    throw InvalidInput("There are " + std::to_string(heights.size()) + " heights and " + std::to_string(weight.size()) +
                       " weights; the surface has " + std::to_string(V_.rows()) + " vertices.");
  }
  Lines lines{{field(family), Vector::Zero(triangle_count_), {}, family}, theta(family)};
  const Vector now = this->heights();
  for (const auto& piece : pieces_) {
    const std::vector<int>& vertex = piece->piece().vertex;
    const Vector known = weight(vertex);
    const Vector z = (known.array() > 0).select(piece->heights() + heights(vertex) - now(vertex), piece->heights());
    const ReflectionField own = piece->field_of(z, family);
    for (int t = 0; t < own.theta.size(); ++t) {
      const int row = piece->piece().field.source[t];
      if (!piece->depends_only_on(t, known)) continue;
      lines.target.weight(row) = 1;
      lines.target.gradient.row(row) = own.gradient.row(t);
      lines.theta(row) = own.theta(t);
    }
  }
  return lines;
}

}  // namespace reflines
