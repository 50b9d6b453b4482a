#include "reflines/cage_optimizer.h"

#include <pybind11/stl.h>

#include <optional>

#include "python/array_arguments.h"
#include "python/bind.h"
#include "python/cage_arrays.h"
#include "python/exclusive_use.h"
#include "python/eyes.h"
#include "python/line_directions.h"
#include "python/native_call.h"
#include "python/option_names.h"
#include "reflines/mirror_pairs.h"
#include "threads/abandonable_work.h"

namespace reflines {

// An attribute of the Python class: its base is the C++ object's surface.
struct BaseIsSurface {};

}  // namespace reflines

namespace pybind11::detail {

// Makes a CageOptimizer of Python a ShapeOptimizer, too, so that builders and readings take it: where one is asked for,
// pybind11 passes the surface. It needs the attribute multiple_inheritance, for the two have different addresses.
template <>
struct process_attribute<reflines::BaseIsSurface> : process_attribute_default<reflines::BaseIsSurface> {
  static void init(const reflines::BaseIsSurface& /*attribute*/, type_record* record) {
    record->add_base(typeid(reflines::ShapeOptimizer),
                     [](void* cage) -> void* { return &static_cast<reflines::CageOptimizer*>(cage)->surface(); });
  }
};

}  // namespace pybind11::detail

namespace reflines {
namespace {

namespace py = pybind11;
using py::literals::operator""_a;

// The crease angle of a cage's surface, which is smooth except at the cage's own creases.
constexpr double kCageCreaseAngle = 1.5 * kCreaseAngle;

std::function<std::unique_ptr<CageOptimizer>()> prepare_cage_optimizer(
    const Positions& V, const Indices& face_offsets, const Indices& face_vertices, const Vector3& view_direction,
    const Eigen::MatrixXd& line_direction, const EyeDirections& eye_directions, const Blockers& blockers,
    const std::optional<Mask>& region, const Codes& border, const std::optional<Mask>& fixed,
    const std::optional<Indices>& partner, const std::optional<Indices>& image_of, int level, const std::string& scheme,
    const std::string& boundary, const Indices& creases, const Numbers& crease_sharpness, const Indices& corners,
    const Numbers& corner_sharpness, bool limit, bool sparse, const std::string& stencil,
    const std::string& linear_solver, const std::string& crease_rule, double crease_angle, double proximity,
    const Indices& bridge, const Indices& bridge_parent, const std::optional<Mask>& left_out,
    std::shared_ptr<Progress> progress) {
  const Cage cage = cage_of({face_offsets, face_vertices, creases, crease_sharpness, corners, corner_sharpness},
                            static_cast<int>(V.rows()));
  CageOptions options = cage_options_of(region, border, V.rows(), fixed, partner);
  if (image_of) options.image_of = index_vector(*image_of);
  options.subdivision = subdivision_options(level, scheme, boundary, limit);
  options.sparse = sparse;
  options.bridge = {triangles_of(bridge), index_vector(bridge_parent), left_out.value_or(Mask())};
  options.shape.stencil = find_named(kStencils, stencil, "stencil");
  options.shape.linear_solver = find_named(kSolvers, linear_solver, "linear solver");
  options.shape.creases = {find_named(kCreaseRules, crease_rule, "rule of creases"), crease_angle, {}};
  options.shape.proximity = proximity;
  options.shape.eyes = eyes_of(eye_directions, blockers);
  options.shape.progress = std::move(progress);
  const std::vector<Vector3> lines = read_line_directions(line_direction);
  return [=] {
    const auto made = std::make_shared<std::unique_ptr<CageOptimizer>>();
    run_abandonable(options.shape.progress.get(),
                    [=] { *made = std::make_unique<CageOptimizer>(cage, V, view_direction, lines, options); });
    return std::move(*made);
  };
}

}  // namespace

void bind_cage_optimizer(py::module_& module) {
  const CageOptions defaults;
  py::class_<CageOptimizer> optimizer(module, "CageOptimizer", BaseIsSurface(), py::multiple_inheritance(),
                                      py::module_local());
  const auto define = [&](const auto&... arguments) {
    optimizer.def(py::init(construct(&prepare_cage_optimizer)), arguments...);
    optimizer.def_static("create", create(&prepare_cage_optimizer), arguments...);
  };
  define("V"_a, "face_offsets"_a, "face_vertices"_a, py::kw_only(), "view_direction"_a, "line_direction"_a,
         "eye_directions"_a = py::none(), "blockers"_a = py::none(), "region"_a = py::none(), "border"_a = "clamped",
         "fixed"_a = py::none(), "partner"_a = py::none(), "image_of"_a = py::none(),
         "level"_a = defaults.subdivision.level, "scheme"_a = "catmull_clark", "boundary"_a = "all",
         "creases"_a = Indices(), "crease_sharpness"_a = Numbers(), "corners"_a = Indices(),
         "corner_sharpness"_a = Numbers(), "limit"_a = defaults.subdivision.limit, "sparse"_a = defaults.sparse,
         "stencil"_a = "consistent", "linear_solver"_a = "cholmod", "crease_rule"_a = "automatic",
         "crease_angle"_a = kCageCreaseAngle, "proximity"_a = defaults.shape.proximity, "bridge"_a = Indices(),
         "bridge_parent"_a = Indices(), "left_out"_a = py::none(), "progress"_a = py::none());
  optimizer.def_property_readonly("region", py::cpp_function(bind_method(&CageOptimizer::region)))
      .def_property_readonly("cage_positions", py::cpp_function(bind_method(&CageOptimizer::cage_positions)))
      .def_property_readonly("cage_free", &CageOptimizer::cage_free)
      .def_property_readonly("triangles", &CageOptimizer::triangles)
      .def_property_readonly("parent", &CageOptimizer::parent)
      .def_property_readonly("refined", &CageOptimizer::refined)
      .def("fit", bind_method(&CageOptimizer::fit), "heights"_a, "weight"_a);
  module.def(
      "mirror_pairs",
      [](const Positions& V, const Vector3& point, const Vector3& normal, double tolerance) {
        return mirror_pairs(V, {point, normal}, tolerance);
      },
      "V"_a, py::kw_only(), "point"_a, "normal"_a, "tolerance"_a);
}

}  // namespace reflines
