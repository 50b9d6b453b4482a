#include "python/press_arguments.h"

#include <map>
#include <utility>

#include "python/option_names.h"
#include "reflines/errors.h"

namespace reflines {
namespace {

const std::map<std::string, Lights> kLights = {{"crossed", Lights::kCrossed}, {"single", Lights::kSingle}};

}  // namespace

double given(const std::optional<double>& length, const char* name) {
  if (length && !(*length > 0))
    throw InvalidInput(std::string(name) + " must be a positive length, or None for automatic.");
  return length.value_or(0.0);
}

PressAmount amount_of(double strength, const std::optional<double>& limit, const LimitRange& limit_range,
                      std::shared_ptr<Progress> progress) {
  PressAmount amount{strength, given(limit, "The limit"), {}, std::move(progress)};
  if (limit_range) amount.limit_range = {limit_range->col(0), limit_range->col(1)};
  return amount;
}

SmoothPanelOptions options_of(const std::string& lights, const std::optional<LightSet>& set,
                              const std::optional<LightSet>& judges, const std::optional<double>& length,
                              double flaw_size, bool symmetric) {
  SmoothPanelOptions options;
  options.lights = find_named(kLights, lights, "choice of lights");
  if (set) options.set = *set;
  if (judges) options.judges = *judges;
  options.length = given(length, "The length");
  options.flaw_size = flaw_size;
  options.symmetric = symmetric;
  return options;
}

}  // namespace reflines
