#include "png_picture.hpp"

#include <cairo/cairo.h>

#include <algorithm>
#include <cmath>
#include <cstdint>
#include <memory>
#include <string>

#include "blum/kernel/check.hpp"
#include "blum/kernel/output_files.hpp"

namespace blum::detail {
namespace {

std::uint32_t byte(float c) {
  return static_cast<std::uint32_t>(std::lround(255 * std::clamp(c, 0.0F, 1.0F)));
}

cairo_status_t append(void* text, const unsigned char* bytes, unsigned length) {
  static_cast<std::string*>(text)->append(reinterpret_cast<const char*>(bytes), length);
  return CAIRO_STATUS_SUCCESS;
}

}  // namespace

std::optional<Error> write_png(std::span<const Rgb> pixels, int width, int height,
                               const std::function<void(cairo_t*)>& decorate,
                               const std::filesystem::path& file) {
  const std::unique_ptr<cairo_surface_t, decltype(&cairo_surface_destroy)> surface(
      cairo_image_surface_create(CAIRO_FORMAT_RGB24, width, height), &cairo_surface_destroy);
  BLUM_CHECK(cairo_surface_status(surface.get()) == CAIRO_STATUS_SUCCESS);
  unsigned char* const data = cairo_image_surface_get_data(surface.get());
  const int stride = cairo_image_surface_get_stride(surface.get());
  for (int y = 0; y < height; ++y) {
    auto* row = reinterpret_cast<std::uint32_t*>(data + static_cast<std::ptrdiff_t>(y) * stride);
    for (int x = 0; x < width; ++x) {
      const Rgb& p = pixels[static_cast<std::size_t>(y) * static_cast<std::size_t>(width) +
                            static_cast<std::size_t>(x)];
      row[x] = byte(p.r) << 16 | byte(p.g) << 8 | byte(p.b);
    }
  }
  cairo_surface_mark_dirty(surface.get());
  cairo_t* const cairo = cairo_create(surface.get());
  decorate(cairo);
  cairo_destroy(cairo);
  cairo_surface_flush(surface.get());
  std::string encoded;
  if (cairo_surface_write_to_png_stream(surface.get(), append, &encoded) != CAIRO_STATUS_SUCCESS) {
    return Error{ErrorCode::kOutputNotWritten, "cairo could not encode the picture", file.string(),
                 std::nullopt};
  }
  const OutputFile output = {file, [&](OutputStream& out) { out << encoded; }};
  return write_files(std::span(&output, 1));
}

void put_text(cairo_t* cairo, double x, double y, double align, const char* text) {
  cairo_text_extents_t extents;
  cairo_text_extents(cairo, text, &extents);
  cairo_move_to(cairo, x - align * extents.x_advance, y);
  cairo_show_text(cairo, text);
}

}  // namespace blum::detail
