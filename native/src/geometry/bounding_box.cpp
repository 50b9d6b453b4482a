#include "geometry/bounding_box.h"

namespace reflines {

double bounding_box_diagonal(const Positions& V) { return (V.colwise().maxCoeff() - V.colwise().minCoeff()).norm(); }

}  // namespace reflines
