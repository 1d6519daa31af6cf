/// Vectors of any number type, for points in more than double precision.
#pragma once

#include <array>
#include <type_traits>

#include "blum/kernel/point.hpp"

namespace blum::test {

template <class Real>
using SmallVector = std::array<Real, 3>;

template <class Real>
SmallVector<Real> vector_of(const Point3& p) {
  return {p.x, p.y, p.z};
}
template <class Real>
Real dot3(const SmallVector<Real>& a, const SmallVector<Real>& b) {
  return a[0] * b[0] + a[1] * b[1] + a[2] * b[2];
}
template <class Real>
SmallVector<Real> combined(const SmallVector<Real>& a, std::type_identity_t<Real> s,
                           const SmallVector<Real>& b) {
  return {a[0] + s * b[0], a[1] + s * b[1], a[2] + s * b[2]};
}

}  // namespace blum::test
