#include "reflines/shape_optimizer.h"

#include <pybind11/stl.h>

#include <optional>
#include <variant>

#include "python/array_arguments.h"
#include "python/bind.h"
#include "python/border_codes.h"
#include "python/exclusive_use.h"
#include "python/eyes.h"
#include "python/index_arrays.h"
#include "python/line_directions.h"
#include "python/native_call.h"
#include "python/option_names.h"
#include "python/surroundings.h"
#include "reflines/errors.h"
#include "reflines/progress.h"
#include "threads/abandonable_work.h"

namespace py = pybind11;

namespace reflines {
namespace {

using Limit =
    std::variant<double, PlanePositions>;  // one length for both directions, or each vertex's lowest and highest move
using Targets = std::variant<Target, std::vector<Target>>;

const std::map<std::string, Strategy> kStrategies = {{"adaptive", Strategy::kAdaptive},
                                                     {"linearized", Strategy::kLinearized},
                                                     {"gauss_newton", Strategy::kGaussNewton},
                                                     {"newton", Strategy::kNewton}};

std::vector<Target> list_targets(const Targets& targets) {
  if (std::holds_alternative<Target>(targets)) return {std::get<Target>(targets)};
  return std::get<std::vector<Target>>(targets);
}

using BuildOptimizer = std::function<std::unique_ptr<ShapeOptimizer>()>;

BuildOptimizer prepare_shape_optimizer(const Positions& V, const Indices& F, const Vector3& view_direction,
                                       const Eigen::MatrixXd& line_direction, const EyeDirections& eye_directions,
                                       const Blockers& blockers, const Codes& border, const std::optional<Mask>& fixed,
                                       const std::optional<Indices>& partner, const Around& around,
                                       const std::optional<Indices>& face_of_triangle, const std::string& stencil,
                                       const std::string& linear_solver, const std::string& crease_rule,
                                       const Indices& marked_creases, double crease_angle, double proximity,
                                       std::shared_ptr<Progress> progress) {
  ShapeOptions options;
  options.border = border_codes(border, V.rows());
  if (fixed) options.held = *fixed;
  if (partner) options.partner = index_vector(*partner);
  options.around = surroundings_of(around);
  if (face_of_triangle) options.face_of_triangle = index_vector(*face_of_triangle);
  options.stencil = find_named(kStencils, stencil, "stencil");
  options.linear_solver = find_named(kSolvers, linear_solver, "linear solver");
  options.creases = {find_named(kCreaseRules, crease_rule, "rule of creases"), crease_angle, edges_of(marked_creases)};
  options.proximity = proximity;
  options.eyes = eyes_of(eye_directions, blockers);
  options.progress = std::move(progress);
  const std::vector<Vector3> lines = read_line_directions(line_direction);
  const Triangles triangles = triangles_of(F);
  return [=] {
    const auto made = std::make_shared<std::unique_ptr<ShapeOptimizer>>();
    run_abandonable(options.progress.get(),
                    [=] { *made = std::make_unique<ShapeOptimizer>(V, triangles, view_direction, lines, options); });
    return std::move(*made);
  };
}

MoveLimit move_limit(const std::optional<Limit>& limit, const ShapeOptimizer& optimizer) {
  if (!limit) return MoveLimit::none();
  if (std::holds_alternative<double>(*limit)) {
    return MoveLimit::within(std::get<double>(*limit), static_cast<int>(optimizer.xy().rows()));
  }
  const PlanePositions& ends = std::get<PlanePositions>(*limit);
  return {ends.col(0), ends.col(1)};
}

py::object solve(ShapeOptimizer& optimizer, const Targets& targets, const std::string& strategy,
                 double gradient_tolerance, int max_iterations, const std::optional<Limit>& limit,
                 const std::shared_ptr<Progress>& progress) {
  MinimizerOptions options;
  options.strategy = find_named(kStrategies, strategy, "strategy");
  options.gradient_tolerance = gradient_tolerance;
  options.max_iterations = max_iterations;
  return call_native(optimizer, [&optimizer, list = list_targets(targets), options, limit, progress] {
    return optimizer.solve(list, options, progress.get(), move_limit(limit, optimizer));
  });
}

Eigen::Matrix3d frame_rows(const ShapeOptimizer& optimizer) {
  Eigen::Matrix3d rows;
  rows << optimizer.frame().x().transpose(), optimizer.frame().y().transpose(), optimizer.frame().z().transpose();
  return rows;
}

int check_family(const ShapeOptimizer& optimizer, int family) {
  if (family >= 0 && family < optimizer.family_count()) return family;
  throw InvalidInput("There is no family " + std::to_string(family) + " of light lines; there are " +
                     std::to_string(optimizer.family_count()) + ".");
}

py::object theta(const ShapeOptimizer& optimizer, int family) {
  return call_native(optimizer, ExclusiveUse::Use::kReads,
                     [&optimizer, family] { return Vector(optimizer.theta(check_family(optimizer, family))); });
}

py::object field(const ShapeOptimizer& optimizer, int family) {
  return call_native(optimizer, ExclusiveUse::Use::kReads,
                     [&optimizer, family] { return PlaneVectors(optimizer.field(check_family(optimizer, family))); });
}

py::object energy(ShapeOptimizer& optimizer, const Targets& targets) {
  return call_native(optimizer, [&optimizer, list = list_targets(targets)] { return optimizer.energy(list); });
}

py::object score(ShapeOptimizer& optimizer, double length, int family) {
  return call_native(optimizer,
                     [&optimizer, length, family] { return optimizer.score(length, check_family(optimizer, family)); });
}

}  // namespace

void bind_optimizer(py::module_& module) {
  const MinimizerOptions minimizer;
  const ShapeOptions shape;
  using Shape = ShapeOptimizer;
  using Release = py::call_guard<ReleaseGil>;
  py::class_<ShapeOptimizer> optimizer(module, "ShapeOptimizer", py::module_local());
  const auto define = [&](const auto&... arguments) {
    optimizer.def(py::init(construct(&prepare_shape_optimizer)), arguments...);
    optimizer.def_static("create", create(&prepare_shape_optimizer), arguments...);
  };
  define(py::arg("V"), py::arg("F"), py::kw_only(), py::arg("view_direction"), py::arg("line_direction"),
         py::arg("eye_directions") = py::none(), py::arg("blockers") = py::none(), py::arg("border") = "clamped",
         py::arg("fixed") = py::none(), py::arg("partner") = py::none(), py::arg("around") = py::none(),
         py::arg("face_of_triangle") = py::none(), py::arg("stencil") = "consistent",
         py::arg("linear_solver") = "cholmod", py::arg("crease_rule") = "automatic",
         py::arg("marked_creases") = Indices(), py::arg("crease_angle") = shape.creases.angle,
         py::arg("proximity") = shape.proximity, py::arg("progress") = py::none());
  optimizer.def_property_readonly("region", py::cpp_function(bind_method(&Shape::region)))
      .def_property_readonly("frame", &frame_rows)
      .def_property_readonly("heights", py::cpp_function(bind_method(&Shape::heights)))
      .def_property_readonly("positions", py::cpp_function(bind_method(&Shape::positions)))
      .def_property_readonly("at_limit", py::cpp_function(bind_method(&Shape::at_limit)))
      .def_property_readonly("free", py::cpp_function(&ShapeOptimizer::free, Release()))
      .def_property_readonly("active", py::cpp_function(&ShapeOptimizer::active, Release()))
      .def_property_readonly("changeable", py::cpp_function(&ShapeOptimizer::changeable, Release()))
      .def_property_readonly("xy", py::cpp_function(&ShapeOptimizer::xy, Release()))
      .def_property_readonly("centers", py::cpp_function(&ShapeOptimizer::centers, Release()))
      .def_property_readonly("area", py::cpp_function(&ShapeOptimizer::area, Release()))
      .def("theta", &theta, py::arg("family") = 0)
      .def("field", &field, py::arg("family") = 0)
      .def("sight", bind_method(&Shape::sight), py::arg("family") = 0)
      .def("energy", &energy, py::arg("target"))
      .def("residual", bind_method(&Shape::residual), py::arg("target"))
      .def("score", &score, py::arg("length"), py::arg("family") = 0)
      .def("solve", &solve, py::arg("target"), py::kw_only(), py::arg("strategy") = to_string(minimizer.strategy),
           py::arg("gradient_tolerance") = minimizer.gradient_tolerance,
           py::arg("max_iterations") = minimizer.max_iterations, py::arg("limit") = py::none(),
           py::arg("progress") = py::none())
      .def("watch", bind_method(&Shape::watch), py::arg("progress"))
      .def("scale_move", bind_method(&Shape::scale_move), py::arg("fraction"))
      .def("keep_within", bind_method(&Shape::keep_within), py::arg("limit"))
      .def("reset", bind_method(&Shape::reset));
}

}  // namespace reflines
