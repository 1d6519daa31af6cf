#include "blum/show/colours.hpp"

#include <algorithm>
#include <cmath>
#include <limits>

namespace blum {
namespace {

constexpr Colour kGrey = {128, 128, 128};
constexpr std::size_t kLabels = 64;

/// Hues a golden section apart, with three lightnesses; chroma low enough for every screen.
std::array<Colour, kLabels> make_labels() {
  std::array<Colour, kLabels> list;
  for (std::size_t i = 0; i < kLabels; ++i) {
    const double hue = 2 * M_PI * std::fmod(0.61803398875 * static_cast<double>(i) + 0.6, 1.0);
    const double lightness = 0.62 + 0.11 * static_cast<double>(i % 3), chroma = 0.125;
    const double a = chroma * std::cos(hue), b = chroma * std::sin(hue);
    // OKLab to linear sRGB (B. Ottosson, 2020).
    const double l = std::pow(lightness + 0.3963377774 * a + 0.2158037573 * b, 3);
    const double m = std::pow(lightness - 0.1055613458 * a - 0.0638541728 * b, 3);
    const double s = std::pow(lightness - 0.0894841775 * a - 1.2914855480 * b, 3);
    const std::array<double, 3> linear = {4.0767416621 * l - 3.3077115913 * m + 0.2309699292 * s,
                                          -1.2684380046 * l + 2.6097574011 * m - 0.3413193965 * s,
                                          -0.0041960863 * l - 0.7034186147 * m + 1.7076147010 * s};
    for (int k = 0; k < 3; ++k) {
      const double c = std::clamp(linear[k], 0.0, 1.0);
      const double srgb = c <= 0.0031308 ? 12.92 * c : 1.055 * std::pow(c, 1 / 2.4) - 0.055;
      list[i][k] = static_cast<std::uint8_t>(std::lround(255 * srgb));
    }
  }
  return list;
}

}  // namespace

std::span<const Colour> colour_stops() {
  static constexpr std::array<Colour, 9> kStops = {{{68, 1, 84},
                                                    {71, 44, 122},
                                                    {59, 81, 139},
                                                    {44, 113, 142},
                                                    {33, 144, 141},
                                                    {39, 173, 129},
                                                    {92, 200, 99},
                                                    {170, 220, 50},
                                                    {253, 231, 37}}};
  return kStops;
}

Colour colour_of(double t) {
  const std::span<const Colour> stops = colour_stops();
  if (std::isnan(t)) return kGrey;
  const double x = std::clamp(t, 0.0, 1.0) * static_cast<double>(stops.size() - 1);
  const auto k = std::min(static_cast<std::size_t>(x), stops.size() - 2);
  Colour c;
  for (int i = 0; i < 3; ++i) {
    const double low = stops[k][i], high = stops[k + 1][i];
    c[i] =
        static_cast<std::uint8_t>(std::lround(low + (x - static_cast<double>(k)) * (high - low)));
  }
  return c;
}

std::span<const Colour> label_colours() {
  static const std::array<Colour, kLabels> kList = make_labels();
  return kList;
}

Colour label_colour(double label) {
  if (!(label >= 0) || std::isinf(label)) return kGrey;
  return label_colours()[static_cast<std::size_t>(std::fmod(label, kLabels))];
}

ValueRange range_of(const ScalarField& field) {
  if (field.name == "angle") return {0, 180};
  ValueRange range{std::numeric_limits<double>::infinity(),
                   -std::numeric_limits<double>::infinity()};
  for (const double v : field.value) {
    if (!std::isfinite(v)) continue;
    if (v < range.least) range.least = v;
    if (v > range.most) range.most = v;
  }
  return range.least <= range.most ? range : ValueRange{};
}

Colour colour_in(const ScalarField& field, const ValueRange& range, double value) {
  if (field.is_label) return label_colour(value);
  if (!std::isfinite(value)) return kGrey;
  const double width = range.most - range.least;
  return colour_of(width > 0 ? (value - range.least) / width : 0);
}

}  // namespace blum
