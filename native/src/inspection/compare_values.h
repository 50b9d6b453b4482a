// Says how values changed that are the better the smaller they are.
#pragma once

#include <initializer_list>

#include "reflines/check_panel.h"

namespace reflines {

// Returns worse where a value is no longer within the mark or has grown by more than that, better the other way round.
Change compare_values(double before, double after, double mark);

// Returns the most telling of changes: one for the worse, else one for the better.
Change sum_up(std::initializer_list<Change> changes);

}  // namespace reflines
