// The names of enumerators in Python, and the look-up of one by its name.
#pragma once

#include <map>
#include <string>

#include "reflines/errors.h"
#include "reflines/shape_optimizer.h"
#include "reflines/subdivision.h"

namespace reflines {

// Returns the enumerator of a name; throws InvalidInput that lists the names.
template <typename Enum>
Enum find_named(const std::map<std::string, Enum>& names, const std::string& name, const std::string& what) {
  const auto found = names.find(name);
  if (found != names.end()) return found->second;
  std::string list;
  for (const auto& entry : names) list += (list.empty() ? "" : ", ") + entry.first;
  throw InvalidInput("There is no " + what + " named '" + name + "'; choose one of " + list + ".");
}

inline const std::map<std::string, Border> kBorders = {{"free", Border::kFree},       {"fixed", Border::kFixed},
                                                       {"clamped", Border::kClamped}, {"curvature", Border::kCurvature},
                                                       {"flow", Border::kFlow},       {"follow", Border::kFollow}};
inline const std::map<std::string, StencilKind> kStencils = {{"averaged", StencilKind::kAveraged},
                                                             {"quadratic", StencilKind::kQuadratic},
                                                             {"hybrid", StencilKind::kHybrid},
                                                             {"consistent", StencilKind::kConsistent}};
inline const std::map<std::string, LinearSolverKind> kSolvers = {{"cholmod", LinearSolverKind::kCholmod},
                                                                 {"umfpack", LinearSolverKind::kUmfpack}};
inline const std::map<std::string, CreaseRule> kCreaseRules = {
    {"automatic", CreaseRule::kAutomatic}, {"marked", CreaseRule::kMarked}, {"none", CreaseRule::kNone}};
inline const std::map<std::string, SubdivisionScheme> kSchemes = {{"catmull_clark", SubdivisionScheme::kCatmullClark},
                                                                  {"loop", SubdivisionScheme::kLoop}};
inline const std::map<std::string, SubdivisionBoundary> kBoundaries = {
    {"all", SubdivisionBoundary::kAll}, {"preserve_corners", SubdivisionBoundary::kPreserveCorners}};

}  // namespace reflines
