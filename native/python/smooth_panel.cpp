#include "reflines/smooth_panel.h"

#include <pybind11/eigen.h>
#include <pybind11/stl.h>

#include <map>
#include <optional>
#include <string>

#include "python/bind.h"
#include "python/border_codes.h"
#include "python/cage_arrays.h"
#include "python/index_arrays.h"
#include "python/native_call.h"
#include "python/option_names.h"
#include "python/surroundings.h"

namespace py = pybind11;

namespace reflines {
namespace {

const std::map<std::string, Lights> kLights = {{"crossed", Lights::kCrossed}, {"single", Lights::kSingle}};

using Shares = std::optional<PlanePositions>;  // #V x 2, lowest and highest

// Refuses a given length that is not positive: in the C++ options 0 means automatic.
double given(const std::optional<double>& length, const char* name) {
  if (length && !(*length > 0))
    throw InvalidInput(std::string(name) + " must be a positive length, or None for automatic.");
  return length.value_or(0.0);
}

SmoothPanelOptions options_of(const std::string& lights, const std::optional<double>& length, double flaw_size,
                              double strength, const std::optional<double>& limit, const Shares& limit_share,
                              bool symmetric, std::shared_ptr<Progress> progress) {
  SmoothPanelOptions options;
  options.lights = find_named(kLights, lights, "choice of lights");
  options.length = given(length, "The length");
  options.flaw_size = flaw_size;
  options.strength = strength;
  options.limit = given(limit, "The limit");
  if (limit_share) options.limit_share = {limit_share->col(0), limit_share->col(1)};
  options.symmetric = symmetric;
  options.progress = std::move(progress);
  return options;
}

py::object convert_result(SmoothPanelResult result) {
  return py::make_tuple(std::move(result.positions), std::move(result.report));
}

py::object smooth_mesh(const Positions& V, const Indices& F, const Vector3& view_direction,
                       const Vector3& line_direction, const Codes& border, const std::optional<Mask>& fixed,
                       const std::optional<Indices>& partner, const Around& around,
                       const std::optional<Indices>& face_of_triangle, const std::optional<Mask>& fair_border,
                       const std::string& lights, const std::optional<double>& length, double flaw_size,
                       double strength, const std::optional<double>& limit, const Shares& limit_share, bool symmetric,
                       std::shared_ptr<Progress> progress) {
  SmoothPanelOptions options =
      options_of(lights, length, flaw_size, strength, limit, limit_share, symmetric, std::move(progress));
  options.border = border_codes(border, V.rows());
  if (fixed) options.held = *fixed;
  if (partner) options.partner = index_vector(*partner);
  options.around = surroundings_of(around);
  if (face_of_triangle) options.face_of_triangle = index_vector(*face_of_triangle);
  if (fair_border) options.fair_border = *fair_border;
  const Triangles triangles = triangles_of(F);
  return run_native([=] { return smooth_panel(V, triangles, view_direction, line_direction, options); },
                    convert_result);
}

py::object smooth_cage(const Positions& V, const Indices& face_offsets, const Indices& face_vertices,
                       const Vector3& view_direction, const Vector3& line_direction, const std::optional<Mask>& region,
                       const Codes& border, const std::optional<Mask>& fixed, const std::optional<Indices>& partner,
                       const std::optional<Indices>& image_of, int level, const std::string& scheme,
                       const std::string& boundary, const Indices& creases, const Numbers& crease_sharpness,
                       const Indices& corners, const Numbers& corner_sharpness, bool limit_surface,
                       const std::string& lights, const std::optional<double>& length, double flaw_size,
                       double strength, const std::optional<double>& limit, const Shares& limit_share, bool symmetric,
                       std::shared_ptr<Progress> progress) {
  const SmoothPanelOptions options =
      options_of(lights, length, flaw_size, strength, limit, limit_share, symmetric, std::move(progress));
  const Cage cage = cage_of({face_offsets, face_vertices, creases, crease_sharpness, corners, corner_sharpness},
                            static_cast<int>(V.rows()));
  CageOptions cage_options = cage_options_of(region, border, V.rows(), fixed, partner);
  if (image_of) cage_options.image_of = index_vector(*image_of);
  cage_options.subdivision = subdivision_options(level, scheme, boundary, limit_surface);
  return run_native([=] { return smooth_cage_panel(cage, V, view_direction, line_direction, cage_options, options); },
                    convert_result);
}

}  // namespace

void bind_smooth_panel(py::module_& module) {
  const SmoothPanelOptions defaults;
  using Told = SmoothPanelReport;
  py::class_<HealedFlaws>(module, "HealedFlaws", py::module_local())
      .def_readonly("area", &HealedFlaws::area)
      .def_readonly("worst_before", &HealedFlaws::worst_before)
      .def_readonly("worst_after", &HealedFlaws::worst_after)
      .def_readonly("mean_before", &HealedFlaws::mean_before)
      .def_readonly("mean_after", &HealedFlaws::mean_after);
  py::class_<Told>(module, "SmoothPanelReport", py::module_local())
      .def_readonly("solve", &Told::solve)
      .def_readonly("length", &Told::length)
      .def_readonly("limit", &Told::limit)
      .def_readonly("largest_move", &Told::largest_move)
      .def_readonly("largest_control_move", &Told::largest_control_move)
      .def_readonly("limited", &Told::limited)
      .def_readonly("bumps", &Told::bumps)
      .def_readonly("mirrored", &Told::mirrored)
      .def_readonly("held_faces", &Told::held_faces)
      .def_readonly("longer_waves", &Told::longer_waves)
      .def_readonly("score_before", &Told::score_before)
      .def_readonly("score_after", &Told::score_after)
      .def_readonly("unevenness_before", &Told::unevenness_before)
      .def_readonly("unevenness_after", &Told::unevenness_after)
      .def_readonly("healed", &Told::healed)
      .def_readonly("stray", &Told::stray)
      .def_readonly("region", &Told::region)
      .def_readonly("applied", &Told::applied)
      .def_readonly("messages", &Told::messages);
  module.attr("AUTOMATIC_LENGTH") = kAutomaticLength;
  module.attr("AUTOMATIC_LIMIT") = kAutomaticLimit;
  module.attr("FAIR_REACH") = kFairReach;
  module.attr("MOST_BOUNDED") = kMostBounded;
  module.def("smooth_panel", &smooth_mesh, py::arg("V"), py::arg("F"), py::kw_only(), py::arg("view_direction"),
             py::arg("line_direction"), py::arg("border") = "clamped", py::arg("fixed") = py::none(),
             py::arg("partner") = py::none(), py::arg("around") = py::none(), py::arg("face_of_triangle") = py::none(),
             py::arg("fair_border") = py::none(), py::arg("lights") = "crossed", py::arg("length") = py::none(),
             py::arg("flaw_size") = defaults.flaw_size, py::arg("strength") = defaults.strength,
             py::arg("limit") = py::none(), py::arg("limit_share") = py::none(),
             py::arg("symmetric") = defaults.symmetric, py::arg("progress") = py::none());
  const SubdivisionOptions subdivision;
  module.def(
      "smooth_cage_panel", &smooth_cage, py::arg("V"), py::arg("face_offsets"), py::arg("face_vertices"), py::kw_only(),
      py::arg("view_direction"), py::arg("line_direction"), py::arg("region") = py::none(),
      py::arg("border") = "clamped", py::arg("fixed") = py::none(), py::arg("partner") = py::none(),
      py::arg("image_of") = py::none(), py::arg("level") = subdivision.level, py::arg("scheme") = "catmull_clark",
      py::arg("boundary") = "all", py::arg("creases") = Indices(), py::arg("crease_sharpness") = Numbers(),
      py::arg("corners") = Indices(), py::arg("corner_sharpness") = Numbers(),
      py::arg("limit_surface") = subdivision.limit, py::arg("lights") = "crossed", py::arg("length") = py::none(),
      py::arg("flaw_size") = defaults.flaw_size, py::arg("strength") = defaults.strength, py::arg("limit") = py::none(),
      py::arg("limit_share") = py::none(), py::arg("symmetric") = defaults.symmetric, py::arg("progress") = py::none());
}

}  // namespace reflines
