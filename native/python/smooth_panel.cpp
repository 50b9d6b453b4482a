#include "reflines/smooth_panel.h"

#include <pybind11/stl.h>

#include <optional>
#include <string>

#include "python/array_arguments.h"
#include "python/bind.h"
#include "python/border_codes.h"
#include "python/cage_arrays.h"
#include "python/exclusive_use.h"
#include "python/index_arrays.h"
#include "python/native_call.h"
#include "python/press_arguments.h"
#include "python/surroundings.h"
#include "reflines/panel_smoother.h"

namespace py = pybind11;

namespace reflines {
namespace {

using BuildSmoother = std::function<std::unique_ptr<PanelSmoother>()>;

BuildSmoother prepare_smoother(const Positions& V, const Indices& F, const Vector3& view_direction,
                               const Vector3& line_direction, const Codes& border, const std::optional<Mask>& fixed,
                               const std::optional<Indices>& partner, const Around& around,
                               const std::optional<Indices>& face_of_triangle, const std::optional<Mask>& fair_border,
                               const std::optional<double>& parts_gap, const std::string& lights,
                               const std::optional<LightSet>& set, const std::optional<LightSet>& judges,
                               const std::optional<double>& length, double flaw_size, bool symmetric, bool even_flush) {
  SmoothPanelOptions options = options_of(lights, set, judges, length, flaw_size, symmetric);
  options.border = border_codes(border, V.rows());
  if (fixed) options.held = *fixed;
  if (partner) options.partner = index_vector(*partner);
  options.around = surroundings_of(around);
  if (face_of_triangle) options.face_of_triangle = index_vector(*face_of_triangle);
  if (fair_border) options.fair_border = *fair_border;
  options.parts_gap = given(parts_gap, "The gap between parts");
  options.even_flush = even_flush;
  return [=, triangles = triangles_of(F)] {
    return std::make_unique<PanelSmoother>(V, triangles, view_direction, line_direction, options);
  };
}

BuildSmoother prepare_cage_smoother(const Positions& V, const Indices& face_offsets, const Indices& face_vertices,
                                    const Vector3& view_direction, const Vector3& line_direction,
                                    const std::optional<Mask>& region, const Codes& border,
                                    const std::optional<Mask>& fixed, const std::optional<Indices>& partner,
                                    const std::optional<Indices>& image_of, int level, const std::string& scheme,
                                    const std::string& boundary, const Indices& creases,
                                    const Numbers& crease_sharpness, const Indices& corners,
                                    const Numbers& corner_sharpness, bool limit_surface, const std::string& lights,
                                    const std::optional<LightSet>& set, const std::optional<LightSet>& judges,
                                    const std::optional<double>& length, double flaw_size, bool symmetric) {
  const Cage cage = cage_of({face_offsets, face_vertices, creases, crease_sharpness, corners, corner_sharpness},
                            static_cast<int>(V.rows()));
  CageOptions cage_options = cage_options_of(region, border, V.rows(), fixed, partner);
  if (image_of) cage_options.image_of = index_vector(*image_of);
  cage_options.subdivision = subdivision_options(level, scheme, boundary, limit_surface);
  return [=, options = options_of(lights, set, judges, length, flaw_size, symmetric)] {
    return std::make_unique<PanelSmoother>(cage, V, view_direction, line_direction, cage_options, options);
  };
}

py::object convert_result(SmoothPanelResult result) {
  return py::make_tuple(std::move(result.positions), std::move(result.report));
}

py::object press(PanelSmoother& smoother, double strength, const std::optional<double>& limit,
                 const LimitRange& limit_range, std::shared_ptr<Progress> progress, bool judged) {
  PressAmount amount = amount_of(strength, limit, limit_range, std::move(progress));
  amount.judged = judged;
  check_single_call();
  const auto exclusive_use = std::make_shared<const ExclusiveUse>(smoother, ExclusiveUse::Use::kChanges);
  return run_native([exclusive_use, &smoother, amount] { return smoother.press(amount); }, convert_result);
}

// Makes a function of the arguments of `prepare` and of a press, which presses once.
template <typename... Arguments>
auto press_once(BuildSmoother (*prepare)(Arguments...)) {
  return [prepare](Arguments... arguments, double strength, const std::optional<double>& limit,
                   const LimitRange& limit_range, std::shared_ptr<Progress> progress) {
    const PressAmount amount = amount_of(strength, limit, limit_range, std::move(progress));
    const BuildSmoother build = prepare(std::forward<Arguments>(arguments)...);
    return run_native([build, amount] { return build()->press(amount); }, convert_result);
  };
}

void bind_press_report(py::module_& module) {
  using Result = SmoothPanelReport;
  py::class_<WorsePlace>(module, "WorsePlace", py::module_local())
      .def_readonly("light", &WorsePlace::light)
      .def_readonly("before", &WorsePlace::before)
      .def_readonly("after", &WorsePlace::after)
      .def_readonly("place", &WorsePlace::place);
  py::class_<HealedFlaws>(module, "HealedFlaws", py::module_local())
      .def_readonly("area", &HealedFlaws::area)
      .def_readonly("worst_before", &HealedFlaws::worst_before)
      .def_readonly("worst_after", &HealedFlaws::worst_after)
      .def_readonly("mean_before", &HealedFlaws::mean_before)
      .def_readonly("mean_after", &HealedFlaws::mean_after)
      .def_readonly("worse", &HealedFlaws::worse)
      .def_readonly("worse_for_judges", &HealedFlaws::worse_for_judges);
  py::class_<PressWork>(module, "PressWork", py::module_local())
      .def_readonly("factorizations", &PressWork::factorizations)
      .def_readonly("solves", &PressWork::solves);
  py::class_<Result>(module, "SmoothPanelReport", py::module_local())
      .def_readonly("solve", &Result::solve)
      .def_readonly("work", &Result::work)
      .def_readonly("length", &Result::length)
      .def_readonly("limit", &Result::limit)
      .def_readonly("largest_move", &Result::largest_move)
      .def_readonly("largest_control_move", &Result::largest_control_move)
      .def_readonly("limited", &Result::limited)
      .def_readonly("bumps", &Result::bumps)
      .def_readonly("mirrored", &Result::mirrored)
      .def_readonly("held_faces", &Result::held_faces)
      .def_readonly("longer_waves", &Result::longer_waves)
      .def_readonly("score_before", &Result::score_before)
      .def_readonly("score_after", &Result::score_after)
      .def_readonly("unevenness_before", &Result::unevenness_before)
      .def_readonly("unevenness_after", &Result::unevenness_after)
      .def_readonly("seen", &Result::seen)
      .def_readonly("healed", &Result::healed)
      .def_readonly("line_deviation", &Result::line_deviation)
      .def_readonly("verdict", &Result::verdict)
      .def_readonly("region", &Result::region)
      .def_readonly("flush_before", &Result::flush_before)
      .def_readonly("flush_after", &Result::flush_after)
      .def_readonly("applied", &Result::applied)
      .def_readonly("notes", &Result::notes);
}

}  // namespace

void bind_smooth_panel(py::module_& module) {
  bind_press_report(module);
  module.attr("AUTOMATIC_LENGTH") = kAutomaticLength;
  module.attr("AUTOMATIC_LIMIT") = kAutomaticLimit;
  module.attr("FAIR_MARGIN") = kFairMargin;
  py::class_<PanelSmoother> smoother(module, "PanelSmoother", py::module_local());
  const SmoothPanelOptions defaults;
  const PressAmount whole;
  const auto define_press = [&](const auto& define, const auto&... own) {
    define(own..., py::arg("strength") = whole.strength, py::arg("limit") = py::none(),
           py::arg("limit_range") = py::none(), py::arg("progress") = py::none());
  };
  const auto define_mesh = [&](const auto& define) {
    define(py::arg("V"), py::arg("F"), py::kw_only(), py::arg("view_direction"), py::arg("line_direction"),
           py::arg("border") = "clamped", py::arg("fixed") = py::none(), py::arg("partner") = py::none(),
           py::arg("around") = py::none(), py::arg("face_of_triangle") = py::none(),
           py::arg("fair_border") = py::none(), py::arg("parts_gap") = py::none(), py::arg("lights") = "crossed",
           py::arg("light_set") = py::none(), py::arg("judges") = py::none(), py::arg("length") = py::none(),
           py::arg("flaw_size") = defaults.flaw_size, py::arg("symmetric") = defaults.symmetric,
           py::arg("even_flush") = defaults.even_flush);
  };
  const SubdivisionOptions subdivision;
  const auto define_cage = [&](const auto& define) {
    define(py::arg("V"), py::arg("face_offsets"), py::arg("face_vertices"), py::kw_only(), py::arg("view_direction"),
           py::arg("line_direction"), py::arg("region") = py::none(), py::arg("border") = "clamped",
           py::arg("fixed") = py::none(), py::arg("partner") = py::none(), py::arg("image_of") = py::none(),
           py::arg("level") = subdivision.level, py::arg("scheme") = "catmull_clark", py::arg("boundary") = "all",
           py::arg("creases") = Indices(), py::arg("crease_sharpness") = Numbers(), py::arg("corners") = Indices(),
           py::arg("corner_sharpness") = Numbers(), py::arg("limit_surface") = subdivision.limit,
           py::arg("lights") = "crossed", py::arg("light_set") = py::none(), py::arg("judges") = py::none(),
           py::arg("length") = py::none(), py::arg("flaw_size") = defaults.flaw_size,
           py::arg("symmetric") = defaults.symmetric);
  };
  define_mesh([&](const auto&... own) {
    smoother.def(py::init(construct(&prepare_smoother)), own...);
    smoother.def_static("create", create(&prepare_smoother), own...);
    define_press([&](const auto&... all) { module.def("smooth_panel", press_once(&prepare_smoother), all...); },
                 own...);
  });
  define_cage([&](const auto&... own) {
    smoother.def_static("create_for_cage", create(&prepare_cage_smoother), own...);
    define_press(
        [&](const auto&... all) { module.def("smooth_cage_panel", press_once(&prepare_cage_smoother), all...); },
        own...);
  });
  define_press([&](const auto&... all) {
    smoother.def("press", &press, py::kw_only(), all..., py::arg("judged") = whole.judged);
  });
}

}  // namespace reflines
