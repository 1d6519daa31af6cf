/// Upper bounds on distance from outside (e.g. a discrete distance field): a plain value, so that
/// whoever uses it does not know where it comes from.
#pragma once

#include <functional>

#include "blum/kernel/point.hpp"

namespace blum {

/// Gives, for a point of the working frame, an upper bound on its distance to the boundary
/// (working units; infinity where nothing is known). An empty function: no hints.
using DistanceHint = std::function<double(const Point3&)>;

}  // namespace blum
