#include "reflines/report.h"

#include <pybind11/stl.h>

#include <sstream>
#include <string>

#include "python/bind.h"
#include "reflines/progress.h"
#include "reflines/shape_optimizer.h"

namespace py = pybind11;

namespace reflines {
namespace {

void bind_region(py::module_& module) {
  py::class_<Region>(module, "Region", py::module_local())
      .def_readonly("triangles", &Region::triangles)
      .def_readonly("free", &Region::free)
      .def_readonly("fixed", &Region::fixed)
      .def_readonly("clamped", &Region::clamped)
      .def_readonly("pieces", &Region::pieces)
      .def_readonly("silhouettes", &Region::silhouettes)
      .def_readonly("turned_away", &Region::turned_away)
      .def_readonly("unused_pieces", &Region::unused_pieces)
      .def_readonly("creases", &Region::creases)
      .def_readonly("marked_creases", &Region::marked_creases)
      .def_readonly("features", &Region::features)
      .def_readonly("hidden", &Region::hidden)
      .def_readonly("closed", &Region::closed)
      .def_readonly("notes", &Region::notes);
}

// Writes a note for developers, as "limited(count=30)".
std::string repr(const Note& note) {
  std::ostringstream text;
  text << to_string(note.kind) << "(";
  if (note.count != 0) text << "count=" << note.count;
  if (note.after != 0) text << (note.count != 0 ? ", " : "") << "before=" << note.before << ", after=" << note.after;
  text << ")";
  return text.str();
}

void bind_note(py::module_& module) {
  py::class_<Note>(module, "Note", py::module_local())
      .def_property_readonly("kind", [](const Note& note) { return to_string(note.kind); })
      .def_readonly("count", &Note::count)
      .def_readonly("before", &Note::before)
      .def_readonly("after", &Note::after)
      .def("__eq__", [](const Note& one, const Note& other) { return one == other; })
      .def("__repr__", &repr);
}

}  // namespace

void bind_report(py::module_& module) {
  bind_note(module);
  bind_region(module);
  py::class_<LineScore>(module, "LineScore", py::module_local())
      .def_readonly("shift", &LineScore::shift)
      .def_readonly("turn", &LineScore::turn);
  py::class_<Progress, std::shared_ptr<Progress>>(module, "Progress", py::module_local())
      .def(py::init<>())
      .def_property_readonly("fraction", &Progress::fraction)
      .def_property_readonly("stage", &Progress::stage)
      .def_property_readonly("cancelled", &Progress::cancelled)
      .def("cancel", &Progress::cancel);
  py::class_<Report>(module, "Report", py::module_local())
      .def_property_readonly("termination", [](const Report& r) { return to_string(r.termination); })
      .def_property_readonly("strategy", [](const Report& r) { return to_string(r.strategy); })
      .def_property_readonly("linear_solver", [](const Report& r) { return to_string(r.linear_solver); })
      .def_property_readonly("converged", &Report::converged)
      .def_readonly("message", &Report::message)
      .def_readonly("unknowns", &Report::unknowns)
      .def_readonly("iterations", &Report::iterations)
      .def_readonly("evaluations", &Report::evaluations)
      .def_readonly("assemblies", &Report::assemblies)
      .def_readonly("analyses", &Report::analyses)
      .def_readonly("factorizations", &Report::factorizations)
      .def_readonly("solves", &Report::solves)
      .def_readonly("energy_before", &Report::energy_before)
      .def_readonly("energy_after", &Report::energy_after)
      .def_readonly("gradient_before", &Report::gradient_before)
      .def_readonly("gradient_after", &Report::gradient_after)
      .def_readonly("seconds", &Report::seconds)
      .def_readonly("put_back", &Report::put_back)
      .def_readonly("limited", &Report::limited)
      .def_readonly("limited_fraction", &Report::limited_fraction)
      .def_readonly("largest_move", &Report::largest_move)
      .def_readonly("residual_rms", &Report::residual_rms);
}

}  // namespace reflines
