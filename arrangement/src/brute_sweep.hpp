/// The rectangle cut into cells by all curves that matter, by a sweep over the critical abscissae.
///
/// Between two critical abscissae lies a *strip*; the curves that bound something cross it as
/// *sections*, one above the other, with *cells* between them. On a critical abscissa lie *points*
/// (where sections end) and open *intervals* between them.
#pragma once

#include <memory>
#include <stdexcept>
#include <vector>

#include "brute_fiber.hpp"

namespace blum::brute {

/// Two critical abscissae lie too close to find a number between them: nothing is decided.
struct PrecisionSpent : std::runtime_error {
  using std::runtime_error::runtime_error;
};

/// The rectangle is in bad position; what() says why.
struct BadPosition : std::runtime_error {
  using std::runtime_error::runtime_error;
};

struct Element {
  enum class Kind { kPoint, kSection, kInterval, kCell };
  Kind kind = Kind::kCell;
  int column = 0;             ///< index of the strip or critical abscissa
  int place = 0;              ///< point: its number on the fiber; section: on the strip's sample
  bool inside = false;        ///< in the open solid
  unsigned sides = 0;         ///< bit k: on Side k of the rectangle
  std::vector<int> triangle;  ///< boundary triangles through it, indices in Setting::triangle
  std::vector<int> governor;  ///< where inside, or on the boundary; indices in Setting::site
  /// Elements of its boundary and neighbours: section: first and last point, cells below and above
  /// (-1: outside the rectangle); interval: points below and above, cells to the left and right.
  std::vector<int> beside;
};

struct Sweep {
  std::vector<Element> element;
  std::vector<std::unique_ptr<Fiber>> critical, sample;
};

/// Throws BadPosition if a part of the boundary's plane or edges lies along a curve of the sweep.
[[nodiscard]] Sweep sweep(const Setting& setting);

}  // namespace blum::brute
