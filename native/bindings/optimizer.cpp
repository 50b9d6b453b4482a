#include <pybind11/eigen.h>
#include <pybind11/stl.h>

#include <optional>
#include <variant>

#include "native/bindings/bind.h"
#include "native/bindings/in_use.h"
#include "native/bindings/indices.h"
#include "native/bindings/line_directions.h"
#include "native/bindings/names.h"
#include "native/bindings/turn.h"
#include "native/errors.h"
#include "native/optimization/progress.h"
#include "native/shape_optimizer.h"

namespace py = pybind11;

namespace reflines {
namespace {

using Codes = std::variant<std::string, Indices>;  // one name for all, or a code each
using Targets = std::variant<Target, std::vector<Target>>;

const std::map<std::string, Strategy> kStrategies = {{"adaptive", Strategy::kAdaptive},
                                                     {"linearized", Strategy::kLinearized},
                                                     {"gauss_newton", Strategy::kGaussNewton},
                                                     {"newton", Strategy::kNewton}};

std::vector<Border> border_codes(const Codes& border, Eigen::Index vertex_count) {
  if (std::holds_alternative<std::string>(border)) {
    return std::vector<Border>(vertex_count, named(kBorders, std::get<std::string>(border), "border"));
  }
  const IndexVector codes = index_vector(std::get<Indices>(border));
  if (codes.size() > 0 && (codes.minCoeff() < 0 || codes.maxCoeff() > 2)) {
    throw InvalidInput("Border codes are 0 (free), 1 (fixed) and 2 (clamped); one is " +
                       std::to_string(codes.minCoeff() < 0 ? codes.minCoeff() : codes.maxCoeff()) + ".");
  }
  std::vector<Border> result;
  for (int code : codes) result.push_back(static_cast<Border>(code));
  return result;
}

std::vector<Target> listed(const Targets& targets) {
  if (std::holds_alternative<Target>(targets)) return {std::get<Target>(targets)};
  return std::get<std::vector<Target>>(targets);
}

std::unique_ptr<ShapeOptimizer> make(const Positions& V, const Indices& F, const Vector3& view_direction,
                                     const Eigen::MatrixXd& line_direction, const Codes& border,
                                     const std::optional<Mask>& fixed, const std::string& stencil,
                                     const std::string& linear_solver, double crease_angle, double proximity,
                                     std::shared_ptr<Progress> progress) {
  ShapeOptions options;
  options.border = border_codes(border, V.rows());
  if (fixed) options.held = *fixed;
  options.stencil = named(kStencils, stencil, "stencil");
  options.linear_solver = named(kSolvers, linear_solver, "linear solver");
  options.crease_angle = crease_angle;
  options.proximity = proximity;
  options.progress = std::move(progress);
  const std::vector<Vector3> lines = directions(line_direction);
  const Triangles triangles = triangles_of(F);
  const ReleaseGil release;
  return std::make_unique<ShapeOptimizer>(V, triangles, view_direction, lines, options);
}

Report solve(ShapeOptimizer& optimizer, const Targets& targets, const std::string& strategy, double gradient_tolerance,
             int max_iterations, const std::shared_ptr<Progress>& progress) {
  MinimizerOptions options;
  options.strategy = named(kStrategies, strategy, "strategy");
  options.gradient_tolerance = gradient_tolerance;
  options.max_iterations = max_iterations;
  const std::vector<Target> list = listed(targets);
  const At at(optimizer);
  return optimizer.solve(list, options, progress.get());
}

Eigen::Matrix3d frame_rows(const ShapeOptimizer& optimizer) {
  Eigen::Matrix3d rows;
  rows << optimizer.frame().x().transpose(), optimizer.frame().y().transpose(), optimizer.frame().z().transpose();
  return rows;
}

int checked_family(const ShapeOptimizer& optimizer, int family) {
  if (family >= 0 && family < optimizer.family_count()) return family;
  throw InvalidInput("There is no family " + std::to_string(family) + " of light lines; there are " +
                     std::to_string(optimizer.family_count()) + ".");
}

Vector theta(const ShapeOptimizer& optimizer, int family) {
  const At at(optimizer, InUse::Use::kReads);
  return optimizer.theta(checked_family(optimizer, family));
}

PlaneVectors field(const ShapeOptimizer& optimizer, int family) {
  const At at(optimizer, InUse::Use::kReads);
  return optimizer.field(checked_family(optimizer, family));
}

double energy(ShapeOptimizer& optimizer, const Targets& targets) {
  const std::vector<Target> list = listed(targets);
  const At at(optimizer);
  return optimizer.energy(list);
}

double score(ShapeOptimizer& optimizer, double length, int family) {
  const At at(optimizer);
  return optimizer.score(length, checked_family(optimizer, family));
}

}  // namespace

void bind_optimizer(py::module_& module) {
  const MinimizerOptions minimizer;
  const ShapeOptions shape;
  using Shape = ShapeOptimizer;
  using Release = py::call_guard<ReleaseGil>;
  py::class_<ShapeOptimizer>(module, "ShapeOptimizer", py::module_local())
      .def(py::init(&make), py::arg("V"), py::arg("F"), py::kw_only(), py::arg("view_direction"),
           py::arg("line_direction"), py::arg("border") = "clamped", py::arg("fixed") = py::none(),
           py::arg("stencil") = "consistent", py::arg("linear_solver") = "cholmod",
           py::arg("crease_angle") = shape.crease_angle, py::arg("proximity") = shape.proximity,
           py::arg("progress") = py::none())
      .def_property_readonly("region", py::cpp_function(native(&Shape::region)))
      .def_property_readonly("frame", &frame_rows)
      .def_property_readonly("heights", py::cpp_function(native(&Shape::heights)))
      .def_property_readonly("positions", py::cpp_function(native(&Shape::positions)))
      .def_property_readonly("free", py::cpp_function(&ShapeOptimizer::free, Release()))
      .def_property_readonly("active", py::cpp_function(&ShapeOptimizer::active, Release()))
      .def_property_readonly("changeable", py::cpp_function(&ShapeOptimizer::changeable, Release()))
      .def_property_readonly("xy", py::cpp_function(&ShapeOptimizer::xy, Release()))
      .def_property_readonly("centers", py::cpp_function(&ShapeOptimizer::centers, Release()))
      .def_property_readonly("area", py::cpp_function(&ShapeOptimizer::area, Release()))
      .def("theta", &theta, py::arg("family") = 0)
      .def("field", &field, py::arg("family") = 0)
      .def("energy", &energy, py::arg("target"))
      .def("residual", native(&Shape::residual), py::arg("target"))
      .def("score", &score, py::arg("length"), py::arg("family") = 0)
      .def("solve", &solve, py::arg("target"), py::kw_only(), py::arg("strategy") = to_string(minimizer.strategy),
           py::arg("gradient_tolerance") = minimizer.gradient_tolerance,
           py::arg("max_iterations") = minimizer.max_iterations, py::arg("progress") = py::none())
      .def("watch", native(&Shape::watch), py::arg("progress"))
      .def("reset", native(&Shape::reset));
}

}  // namespace reflines
