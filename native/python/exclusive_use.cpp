#include "python/exclusive_use.h"

#include <map>
#include <mutex>
#include <string>

#include "reflines/errors.h"

namespace reflines {
namespace {

constexpr int kChanged = -1;

// Guards the table during each look-up only, with or without the GIL.
std::mutex table_mutex;
std::map<const void*, int> table;  // number of readers of each object, or kChanged

}  // namespace

ExclusiveUse::ExclusiveUse(const void* object, Use use, const char* name) : object_(object) {
  const std::scoped_lock lock(table_mutex);
  const auto [place, is_first] = table.try_emplace(object, 0);
  if (!is_first && (use == Use::kChanges || place->second == kChanged)) {
    throw InvalidInput(std::string("The ") + name +
                       " is in use by another thread; wait until that has done, or give each thread one of its own.");
  }
  place->second = use == Use::kChanges ? kChanged : place->second + 1;
}

ExclusiveUse::~ExclusiveUse() {
  const std::scoped_lock lock(table_mutex);
  const auto place = table.find(object_);
  if (place->second == kChanged || --place->second == 0) table.erase(place);
}

}  // namespace reflines
