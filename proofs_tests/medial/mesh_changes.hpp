/// Changes of a mesh after which its axis must be certified just the same.
#pragma once

#include <cmath>
#include <functional>
#include <string>
#include <vector>

#include "kernel/turn_by_quaternion.hpp"
#include "subdivision/solid_scenes.hpp"

namespace blum::test {

struct Change {
  std::string name;
  std::function<PolygonMesh(const PolygonMesh&)> of;
};

inline Change as_it_is() {
  return {"as it is", [](const PolygonMesh& m) { return m; }};
}

inline Change turned(std::uint64_t seed) {
  return {"turned at random " + std::to_string(seed),
          [seed](const PolygonMesh& m) { return rotated(m, seed); }};
}

inline std::string quaternion_name(const std::array<int, 4>& q) {
  std::string name = "quaternion";
  for (const int x : q) name += " " + std::to_string(x);
  return name;
}

/// Coordinates rounded to integers below 2^44, before a change that needs few digits. Vertical
/// walls and horizontal faces stay exactly planar.
inline PolygonMesh to_integers(PolygonMesh m) {
  double most = 0;
  for (const Point3& p : m.points)
    for (int k = 0; k < 3; ++k) most = std::max(most, std::abs(p[k]));
  const int exponent = 43 - std::ilogb(most);
  for (Point3& p : m.points)
    for (int k = 0; k < 3; ++k) p[k] = std::round(std::ldexp(p[k], exponent));
  return m;
}

/// A rotation without any rounding, of the solid rounded to integers; exact
/// for a quaternion of squared norm up to 256, so that all sums stay below 2^53.
inline Change turned_exactly(const std::array<int, 4>& q) {
  return {"to integers, turned exactly by " + quaternion_name(q),
          [q](const PolygonMesh& m) { return turn_by_quaternion(to_integers(m), q); }};
}

/// The same rotation of the coordinates as they are, rounded.
inline Change turned_and_rounded(const std::array<int, 4>& q) {
  return {"turned by " + quaternion_name(q),
          [q](const PolygonMesh& m) { return turn_by_quaternion(m, q); }};
}

inline Change far_away() {
  return {"moved by a million diagonals", [](const PolygonMesh& m) {
            const double far = 1e6 * extent(m.points);
            return translated(m, {far, -far, far});
          }};
}

inline Change scaled_by(int exponent) {
  return {"scaled by 2^" + std::to_string(exponent),
          [exponent](const PolygonMesh& m) { return scaled(m, exponent); }};
}

/// The last five are random rotations.
inline std::vector<Change> all_changes() {
  std::vector<Change> changes{as_it_is(),
                              turned_exactly({2, 1, 0, 0}),
                              turned_exactly({1, 2, 3, 4}),
                              far_away(),
                              scaled_by(100),
                              scaled_by(-100)};
  for (std::uint64_t seed = 1; seed <= 5; ++seed) changes.push_back(turned(seed));
  return changes;
}

}  // namespace blum::test
