#include "reflines/joint_smoother.h"

#include <pybind11/stl.h>

#include <memory>
#include <optional>
#include <string>
#include <utility>
#include <vector>

#include "python/array_arguments.h"
#include "python/bind.h"
#include "python/border_codes.h"
#include "python/cage_arrays.h"
#include "python/exclusive_use.h"
#include "python/index_arrays.h"
#include "python/native_call.h"
#include "python/press_arguments.h"
#include "python/surroundings.h"

namespace py = pybind11;

namespace reflines {
namespace {

JointPanel make_panel(const Positions& V, const Indices& F, const Vector3& view_direction,
                      const Vector3& line_direction, const Codes& border, const std::optional<Mask>& fixed,
                      const std::optional<Indices>& partner, const Around& around,
                      const std::optional<Indices>& face_of_triangle, const std::string& lights,
                      const std::optional<LightSet>& set, const std::optional<LightSet>& judges,
                      const std::optional<double>& length, double flaw_size, bool symmetric, const Around& beside,
                      const std::optional<double>& gap, const std::optional<double>& margin, bool even_flush) {
  JointPanel panel{V, triangles_of(F), view_direction, line_direction,
                   options_of(lights, set, judges, length, flaw_size, symmetric)};
  panel.options.border = border_codes(border, V.rows());
  if (fixed) panel.options.held = *fixed;
  if (partner) panel.options.partner = index_vector(*partner);
  panel.options.around = surroundings_of(around);
  if (face_of_triangle) panel.options.face_of_triangle = index_vector(*face_of_triangle);
  const Surroundings still = surroundings_of(beside);
  panel.V_beside = still.V;
  panel.F_beside = still.F;
  panel.gap = {given(gap, "The gap"), given(margin, "The margin")};
  panel.options.even_flush = even_flush;
  return panel;
}

JointPanel make_cage_panel(const Positions& V, const Indices& face_offsets, const Indices& face_vertices,
                           const Vector3& view_direction, const Vector3& line_direction,
                           const std::optional<Mask>& region, const Codes& border, const std::optional<Mask>& fixed,
                           const std::optional<Indices>& partner, const std::optional<Indices>& image_of, int level,
                           const std::string& scheme, const std::string& boundary, const Indices& creases,
                           const Numbers& crease_sharpness, const Indices& corners, const Numbers& corner_sharpness,
                           bool limit_surface, const std::string& lights, const std::optional<LightSet>& set,
                           const std::optional<LightSet>& judges, const std::optional<double>& length, double flaw_size,
                           bool symmetric, const std::optional<double>& gap, const std::optional<double>& margin,
                           bool even_flush) {
  JointCage own{cage_of({face_offsets, face_vertices, creases, crease_sharpness, corners, corner_sharpness},
                        static_cast<int>(V.rows())),
                V, cage_options_of(region, border, V.rows(), fixed, partner)};
  if (image_of) own.options.image_of = index_vector(*image_of);
  own.options.subdivision = subdivision_options(level, scheme, boundary, limit_surface);
  JointPanel panel{
      {}, {}, view_direction, line_direction, options_of(lights, set, judges, length, flaw_size, symmetric)};
  panel.gap = {given(gap, "The gap"), given(margin, "The margin")};
  panel.options.even_flush = even_flush;
  panel.cage = std::make_shared<const JointCage>(std::move(own));
  return panel;
}

std::function<std::unique_ptr<JointSmoother>()> prepare_smoother(const std::vector<JointPanel>& panels) {
  return [panels] { return std::make_unique<JointSmoother>(panels); };
}

py::object convert_results(std::vector<SmoothPanelResult> results) {
  py::list all;
  for (SmoothPanelResult& result : results)
    all.append(py::make_tuple(std::move(result.positions), std::move(result.report)));
  return all;
}

py::object press(JointSmoother& smoother, const std::vector<double>& strengths,
                 const std::vector<std::optional<double>>& limits, const std::vector<LimitRange>& limit_ranges,
                 const std::shared_ptr<Progress>& progress) {
  if (limits.size() != strengths.size() || limit_ranges.size() != strengths.size())
    throw InvalidInput("Each panel needs a strength, a limit and shares of it, or None.");
  std::vector<PressAmount> amounts;
  for (size_t k = 0; k < strengths.size(); ++k)
    amounts.push_back(amount_of(strengths[k], limits[k], limit_ranges[k], progress));
  check_single_call();
  const auto exclusive_use = std::make_shared<const ExclusiveUse>(smoother, ExclusiveUse::Use::kChanges);
  return run_native([exclusive_use, &smoother, amounts] { return smoother.press(amounts); }, convert_results);
}

}  // namespace

void bind_joint_smoother(py::module_& module) {
  const SmoothPanelOptions defaults;
  const SubdivisionOptions subdivision;
  py::class_<JointPanel>(module, "JointPanel", py::module_local())
      .def(py::init(&make_panel), py::arg("V"), py::arg("F"), py::kw_only(), py::arg("view_direction"),
           py::arg("line_direction"), py::arg("border") = "follow", py::arg("fixed") = py::none(),
           py::arg("partner") = py::none(), py::arg("around") = py::none(), py::arg("face_of_triangle") = py::none(),
           py::arg("lights") = "crossed", py::arg("light_set") = py::none(), py::arg("judges") = py::none(),
           py::arg("length") = py::none(), py::arg("flaw_size") = defaults.flaw_size,
           py::arg("symmetric") = defaults.symmetric, py::arg("beside") = py::none(), py::arg("gap") = py::none(),
           py::arg("margin") = py::none(), py::arg("even_flush") = defaults.even_flush)
      .def_static("for_cage", &make_cage_panel, py::arg("V"), py::arg("face_offsets"), py::arg("face_vertices"),
                  py::kw_only(), py::arg("view_direction"), py::arg("line_direction"), py::arg("region") = py::none(),
                  py::arg("border") = "follow", py::arg("fixed") = py::none(), py::arg("partner") = py::none(),
                  py::arg("image_of") = py::none(), py::arg("level") = subdivision.level,
                  py::arg("scheme") = "catmull_clark", py::arg("boundary") = "all", py::arg("creases") = Indices(),
                  py::arg("crease_sharpness") = Numbers(), py::arg("corners") = Indices(),
                  py::arg("corner_sharpness") = Numbers(), py::arg("limit_surface") = subdivision.limit,
                  py::arg("lights") = "crossed", py::arg("light_set") = py::none(), py::arg("judges") = py::none(),
                  py::arg("length") = py::none(), py::arg("flaw_size") = defaults.flaw_size,
                  py::arg("symmetric") = defaults.symmetric, py::arg("gap") = py::none(),
                  py::arg("margin") = py::none(), py::arg("even_flush") = defaults.even_flush);
  py::class_<JointSmoother>(module, "JointSmoother", py::module_local())
      .def(py::init(construct(&prepare_smoother)), py::arg("panels"))
      .def_static("create", create(&prepare_smoother), py::arg("panels"))
      .def("press", &press, py::kw_only(), py::arg("strengths"), py::arg("limits"), py::arg("limit_ranges"),
           py::arg("progress") = py::none());
}

}  // namespace reflines
