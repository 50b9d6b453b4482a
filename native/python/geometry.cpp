
#include <memory>
#include <utility>

#include "geometry/crease.h"
#include "geometry/crease_split.h"
#include "geometry/mesh.h"
#include "geometry/normal_fit.h"
#include "python/array_arguments.h"
#include "python/bind.h"
#include "python/exclusive_use.h"
#include "python/index_arrays.h"
#include "python/native_call.h"
#include "reflection/reflection_function.h"
#include "reflines/errors.h"
#include "reflines/image_plane.h"
#include "reflines/rasterize.h"

namespace py = pybind11;

namespace reflines {
namespace {

Eigen::Matrix3d image_plane(const Vector3& view_direction, const Vector3& line_direction) {
  const ImagePlane frame(view_direction, line_direction);
  Eigen::Matrix3d rows;
  rows << frame.x().transpose(), frame.y().transpose(), frame.z().transpose();
  return rows;
}

void check_normals(const Positions& normals) {
  int bad = 0;
  for (const auto& normal : normals.rowwise()) bad += !normal.allFinite() || normal.isZero(0);
  if (bad == 0) return;
  throw InvalidInput(std::to_string(bad) + " normals are 0 or not finite; give the direction of each.");
}

Vector theta_of_normals(const Positions& normals, const Positions& views, const Vector3& line_direction) {
  if (views.rows() != 1 && views.rows() != normals.rows()) {
    throw InvalidInput("There are " + std::to_string(views.rows()) + " view directions for " +
                       std::to_string(normals.rows()) + " normals; give one, or one for each.");
  }
  check_normals(normals);
  Vector result(normals.rows());
  for (Eigen::Index k = 0; k < normals.rows(); ++k) {
    const Vector3 view = views.row(views.rows() == 1 ? 0 : k);
    const ImagePlane frame(view, line_direction);
    result(k) = ReflectionFunction(frame, view, line_direction).theta(frame.to_frame(normals.row(k)));
  }
  return result;
}

std::function<std::unique_ptr<NormalFit>()> prepare_fit(const Positions& V, const Indices& F, double refit_angle) {
  return
      [V, triangles = triangles_of(F), refit_angle] { return std::make_unique<NormalFit>(V, triangles, refit_angle); };
}

// Returns (F, vertex); see split_at_creases.
py::object split(const Positions& V, const Indices& F, double angle) {
  return run_native([V, triangles = triangles_of(F), angle] {
    const SplitSurface result = split_at_creases(V, triangles, angle);
    const Eigen::VectorXi vertex = Eigen::Map<const Eigen::VectorXi>(result.vertex.data(), result.vertex.size());
    return std::pair(result.F, vertex);
  });
}

Edges find_creases(const Positions& V, const Triangles& triangles, double angle) {
  check_surface(V, triangles);
  const Triangles neighbors = edge_neighbors(triangles);
  const EdgeMask crease = crease_edges(V, triangles, neighbors, {.angle = angle});
  Edges result(crease.count() / 2, 2);
  int count = 0;
  for (int t = 0; t < triangles.rows(); ++t) {
    for (int i = 0; i < 3; ++i) {
      if (crease(t, i) && neighbors(t, i) > t) {
        result.row(count++) << triangles(t, (i + 1) % 3), triangles(t, (i + 2) % 3);
      }
    }
  }
  return result;
}

// Returns #E x 2; see crease_edges.
py::object creases(const Positions& V, const Indices& F, double angle) {
  return run_native([V, triangles = triangles_of(F), angle] { return find_creases(V, triangles, angle); });
}

py::object copy(const NormalFit& fit) {
  return call_native(fit, ExclusiveUse::Use::kReads, [&fit] { return NormalFit(fit); });
}

}  // namespace

void bind_geometry(py::module_& module) {
  module.def("image_plane", &image_plane, py::arg("view_direction"), py::arg("line_direction"));
  module.def("theta", &theta_of_normals, py::arg("normals"), py::arg("view_direction"), py::arg("line_direction"));
  module.def(
      "theta",
      [](const Positions& normals, const Vector3& view, const Vector3& line) {
        return theta_of_normals(normals, view.transpose(), line);
      },
      py::arg("normals"), py::arg("view_direction"), py::arg("line_direction"));
  module.def("crease_edges", &creases, py::arg("V"), py::arg("F"), py::kw_only(), py::arg("angle") = kCreaseAngle);
  module.def("split_at_creases", &split, py::arg("V"), py::arg("F"), py::kw_only(), py::arg("angle") = kCreaseAngle);
  module.def(
      "rasterize",
      [](const Positions& points, const Indices& F, int width, int height) {
        return run_native(
            [points, triangles = triangles_of(F), width, height] {
              return rasterize(points, triangles, width, height);
            },
            [](const Raster& found) { return py::make_tuple(found.triangle, found.second, found.third); });
      },
      py::arg("points"), py::arg("F"), py::kw_only(), py::arg("width"), py::arg("height"));
  py::class_<NormalFit> fit(module, "NormalFit", py::module_local());
  const auto define = [&](const auto&... arguments) {
    fit.def(py::init(construct(&prepare_fit)), arguments...);
    fit.def_static("create", create(&prepare_fit), arguments...);
  };
  define(py::arg("V"), py::arg("F"), py::kw_only(), py::arg("refit_angle") = 0.35);
  fit.def("copy", &copy)
      .def("kept_normals", bind_method(&NormalFit::kept_normals), py::arg("V"))
      .def("normals", bind_method(&NormalFit::normals), py::arg("V"))
      .def_property_readonly("refit_count", &NormalFit::refit_count);
}

}  // namespace reflines
