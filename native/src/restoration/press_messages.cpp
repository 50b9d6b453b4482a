#include "restoration/press_messages.h"

#include <cstdio>

namespace reflines {
namespace {

std::string format_degrees(double value, int digits) {
  char text[32];
  std::snprintf(text, sizeof text, "%.*g", digits, value);
  return text;
}

// Formats two numbers with three digits, or with as many as tell one from the other.
std::string format_change(double before, double after) {
  int digits = 3;
  while (digits < 17 && format_degrees(before, digits) == format_degrees(after, digits)) ++digits;
  return format_degrees(before, digits) + " to " + format_degrees(after, digits);
}

std::string count_of(int count, const std::string& one, const std::string& many) {
  return std::to_string(count) + " " + (count == 1 ? one : many);
}

}  // namespace

std::string explain_turned_faces() {
  return "Nothing was changed: faces would have turned by more than 45 degrees. Select less.";
}

std::string explain_worse_light(double before, double after) {
  return "Nothing was changed: the lines would have become less even in one light (" + format_change(before, after) +
         " degrees). Select less, or give a Length.";
}

std::vector<std::string> describe_result(const SmoothPanelReport& report) {
  std::vector<std::string> result;
  if (report.limited > 0) {
    result.push_back("The limit of the move holds back " + count_of(report.limited, "vertex", "vertices") +
                     "; what is deeper is left.");
  } else if (report.largest_control_move == 0) {
    result.emplace_back("No noise, ripples or dents were found: nothing was changed. Give a Length to smooth more.");
  }
  if (report.longer_waves) {
    result.emplace_back(
        "Longer waves were left, for they may be design: with twice the Flaw Size they count as flaws, too.");
  }
  if (!report.solve.converged()) {
    result.emplace_back(
        "The solver stopped before its end; the lines are more even in every light all the same. Select less to let it "
        "finish.");
  }
  if (report.held_faces > 0) {
    result.push_back(count_of(report.held_faces, "face was", "faces were") +
                     " left alone that would have turned by more than 45 degrees.");
  }
  return result;
}

}  // namespace reflines
