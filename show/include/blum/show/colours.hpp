/// Colours of numbers, the same in pictures, pages and slices.
#pragma once

#include <array>
#include <cstddef>
#include <cstdint>
#include <span>

#include "blum/show/scene.hpp"

namespace blum {

using Colour = std::array<std::uint8_t, 3>;

/// Every eighth of matplotlib's viridis (CC0): perceptually uniform, safe for the colour-blind.
[[nodiscard]] std::span<const Colour> colour_stops();
/// t in [0, 1] (else clamped), linear between the stops. Grey for NaN.
[[nodiscard]] Colour colour_of(double t);

/// Of things that have numbers but no order: neighbours in the list differ well, and after the last
/// comes the first again.
[[nodiscard]] std::span<const Colour> label_colours();
/// By the whole part. Grey below 0, for NaN and for infinity.
[[nodiscard]] Colour label_colour(double label);

struct ValueRange {
  double least = 0, most = 1;
};
/// What the map's ends stand for: 0 and 180 for angles, else the least and largest finite value; 0
/// and 1 if there is none.
[[nodiscard]] ValueRange range_of(const ScalarField& field);
/// Grey where there is no finite value.
[[nodiscard]] Colour colour_in(const ScalarField& field, const ValueRange& range, double value);

}  // namespace blum
