// The names of changes in Python.
#pragma once

#include <string>
#include <vector>

#include "reflines/check_panel.h"

namespace reflines {

inline std::string change_name(Change change) {
  if (change == Change::kUnchanged) return "unchanged";
  return change == Change::kWorse ? "worse" : "better";
}

inline std::vector<std::string> change_names(const std::vector<Change>& changes) {
  std::vector<std::string> names;
  for (const Change change : changes) names.push_back(change_name(change));
  return names;
}

}  // namespace reflines
