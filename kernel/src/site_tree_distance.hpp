/// The exact squared distance from a point to a triangle, as a fraction.
#pragma once

#include <array>

#include "blum/kernel/point.hpp"
#include "exact_geometry_number.hpp"

namespace blum {

struct ExactSquaredDistance {
  exact::Dyadic numerator;
  exact::Dyadic denominator;  ///< > 0
};

[[nodiscard]] ExactSquaredDistance exact_squared_distance(const Point3& q,
                                                          const std::array<Point3, 3>& triangle);
[[nodiscard]] int compare(const ExactSquaredDistance& a, const ExactSquaredDistance& b);
[[nodiscard]] int compare(const ExactSquaredDistance& a, double b);

}  // namespace blum
