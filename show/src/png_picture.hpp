/// Pixels with text on them as PNG, by cairo.
#pragma once

#include <filesystem>
#include <functional>
#include <optional>
#include <span>

#include "blum/kernel/result.hpp"
#include "raster.hpp"

struct _cairo;

namespace blum::detail {

/// Writes width x height pixels after `decorate` has drawn on them. Error: kOutputNotWritten.
[[nodiscard]] std::optional<Error> write_png(std::span<const Rgb> pixels, int width, int height,
                                             const std::function<void(_cairo*)>& decorate,
                                             const std::filesystem::path& file);

/// Baseline from (x, y): `align` of the text's width to the left (0: begins there, 1: ends there).
void put_text(_cairo* cairo, double x, double y, double align, const char* text);

}  // namespace blum::detail
