#include <pybind11/stl.h>

#include <optional>

#include "python/array_arguments.h"
#include "python/bind.h"
#include "python/exclusive_use.h"
#include "reflines/errors.h"
#include "reflines/kept_target.h"
#include "reflines/pattern_target.h"
#include "reflines/shape_optimizer.h"
#include "reflines/smooth_target.h"
#include "reflines/uniform_target.h"
#include "reflines/warp_target.h"
#include "targets/dense_heights.h"

namespace py = pybind11;

namespace reflines {
namespace {

using Maybe = std::optional<Vector>;

Target set_weight(Target target, const Maybe& weight) {
  if (weight) target.weight = *weight;
  return target;
}

py::object smooth(ShapeOptimizer& optimizer, double length, double strength, bool directional, int family,
                  const Maybe& weight) {
  return call_native(optimizer, [=, &optimizer] {
    return set_weight(build_smooth_target(optimizer.field(family), optimizer.smoother(family), {length, directional},
                                          strength, family),
                      weight);
  });
}

py::object uniform(ShapeOptimizer& optimizer, const Vector2& direction, double density, bool relative,
                   double density_end, const Vector2& axis, const Maybe& influence, const Maybe& weight, int family) {
  const UniformOptions options{direction, density, relative, density_end, axis};
  return call_native(optimizer, [=, &optimizer] {
    return set_weight(build_uniform_target(optimizer.region_field(family), options, influence.value_or(Vector())),
                      weight);
  });
}

py::object median_gradient(ShapeOptimizer& optimizer, int family) {
  return call_native(optimizer, [=, &optimizer] { return optimizer.region_field(family).median_gradient(); });
}

py::object turn(ShapeOptimizer& optimizer, double angle, double density, double density_end, const Vector2& axis,
                const Maybe& influence, const Maybe& weight, int family) {
  const TurnOptions options{angle, density, density_end, axis};
  return call_native(optimizer, [=, &optimizer] {
    return set_weight(build_turned_target(optimizer.region_field(family), options, influence.value_or(Vector())),
                      weight);
  });
}

py::object keep(ShapeOptimizer& optimizer, int family) {
  return call_native(optimizer, [&optimizer, family] { return build_kept_target(optimizer.field(family), family); });
}

py::object falloff_at(ShapeOptimizer& optimizer, const Vector2& centre, double radius, const Vector& curve) {
  return call_native(optimizer,
                     [=, &optimizer] { return Vector(falloff(optimizer.region_field(0), centre, radius, curve)); });
}

py::object warp(ShapeOptimizer& optimizer, const Vector2& low, const Vector2& high, int columns, int rows,
                const PlanePositions& position, bool by_value, int family) {
  return call_native(optimizer, [=, &optimizer] {
    WarpResult result =
        build_warp_target(optimizer.region_field(family), {low, high, columns, rows, position}, by_value);
    return std::pair(std::move(result.target), result.outside);
  });
}

py::object pattern(ShapeOptimizer& optimizer, const Eigen::MatrixXd& image, double strength, double blur, double keep,
                   const Vector2& centre, double width, double angle, bool by_value, const Maybe& weight, int family) {
  const PatternOptions options{strength, blur, keep, centre, width, angle, by_value};
  return call_native(optimizer, [=, &optimizer] {
    return set_weight(build_pattern_target(optimizer.region_field(family), image, options), weight);
  });
}

// Throws where the frames differ: the dense panel is evaluated at the region's vertices in their common image plane.
void check_same_view(const ImagePlane& one, const ImagePlane& other) {
  constexpr double kSame = 1e-9;
  if ((one.z() - other.z()).norm() < kSame && (one.x() - other.x()).norm() < kSame) return;
  throw InvalidInput(
      "The optimizer and that of the dense mesh have different views or line directions; give both the same.");
}

py::object match_dense(ShapeOptimizer& optimizer, ShapeOptimizer& dense, int family) {
  std::shared_ptr<const ExclusiveUse> dense_use;
  if (&dense != &optimizer) dense_use = std::make_shared<ExclusiveUse>(dense, ExclusiveUse::Use::kChanges);
  return call_native(optimizer, [&optimizer, &dense, dense_use, family] {
    check_same_view(optimizer.frame(), dense.frame());
    DenseHeights wanted =
        sample_dense_heights(optimizer.region_field(family), dense.region_field(family), dense.heights());
    ShapeOptimizer::Lines lines = optimizer.evaluate_lines(wanted.height, wanted.area, family);
    return std::tuple(std::move(lines.target), std::move(lines.theta), std::move(wanted.height),
                      std::move(wanted.area));
  });
}

void bind_image_tools(py::module_& module) {
  const PatternOptions pattern_defaults;
  module.def("warp", &warp, py::arg("optimizer"), py::kw_only(), py::arg("low"), py::arg("high"), py::arg("columns"),
             py::arg("rows"), py::arg("position"), py::arg("by_value") = false, py::arg("family") = 0);
  module.def("pattern", &pattern, py::arg("optimizer"), py::kw_only(), py::arg("image"),
             py::arg("strength") = pattern_defaults.strength, py::arg("blur") = pattern_defaults.blur,
             py::arg("keep") = pattern_defaults.keep, py::arg("centre") = pattern_defaults.centre,
             py::arg("width") = pattern_defaults.width, py::arg("angle") = pattern_defaults.angle,
             py::arg("by_value") = pattern_defaults.by_value, py::arg("weight") = py::none(), py::arg("family") = 0);
  module.def("match_dense", &match_dense, py::arg("optimizer"), py::arg("dense"), py::kw_only(), py::arg("family") = 0);
}

}  // namespace

void bind_builders(py::module_& module) {
  const UniformOptions uniform_defaults;
  module.def("smooth", &smooth, py::arg("optimizer"), py::kw_only(), py::arg("length"), py::arg("strength") = 1.0,
             py::arg("directional") = SmoothOptions().directional, py::arg("family") = 0,
             py::arg("weight") = py::none());
  module.def("uniform", &uniform, py::arg("optimizer"), py::kw_only(),
             py::arg("direction") = uniform_defaults.direction, py::arg("density") = uniform_defaults.density,
             py::arg("relative") = uniform_defaults.relative, py::arg("density_end") = uniform_defaults.density_end,
             py::arg("axis") = uniform_defaults.axis, py::arg("influence") = py::none(), py::arg("weight") = py::none(),
             py::arg("family") = 0);
  module.def("median_gradient", &median_gradient, py::arg("optimizer"), py::kw_only(), py::arg("family") = 0);
  const TurnOptions turn_defaults;
  module.def("turn", &turn, py::arg("optimizer"), py::kw_only(), py::arg("angle") = turn_defaults.angle,
             py::arg("density") = turn_defaults.density, py::arg("density_end") = turn_defaults.density_end,
             py::arg("axis") = turn_defaults.axis, py::arg("influence") = py::none(), py::arg("weight") = py::none(),
             py::arg("family") = 0);
  module.def("keep", &keep, py::arg("optimizer"), py::kw_only(), py::arg("family"));
  module.def("falloff", &falloff_at, py::arg("optimizer"), py::kw_only(), py::arg("centre"), py::arg("radius"),
             py::arg("curve"));
  bind_image_tools(module);
}

}  // namespace reflines
