#include "slice_picture.hpp"

#include <png.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <string>
#include <vector>

#include "blum/kernel/output_files.hpp"
#include "blum/show/colours.hpp"

namespace blum::app {
namespace {

class Slice {
 public:
  Slice(const FieldImage& image, int axis, std::uint32_t index)
      : image_(image),
        axis_(axis),
        index_(index),
        right_(axis == 0 ? 1 : 0),
        up_(axis == 2 ? 1 : 2) {}

  [[nodiscard]] std::uint32_t width() const { return image_.grid.size[right_]; }
  [[nodiscard]] std::uint32_t height() const { return image_.grid.size[up_]; }

  [[nodiscard]] std::vector<std::uint8_t> pixels() const {
    double largest = 0;
    for (std::uint32_t r = 0; r < height(); ++r) {
      for (std::uint32_t c = 0; c < width(); ++c) {
        const double d = std::abs(distance(c, r));
        if (std::isfinite(d)) largest = std::max(largest, d);
      }
    }
    std::vector<std::uint8_t> rgb;
    rgb.reserve(std::size_t{3} * width() * height());
    for (std::uint32_t r = height(); r-- > 0;) {
      for (std::uint32_t c = 0; c < width(); ++c) {
        const Colour pixel = colour(c, r, largest);
        rgb.insert(rgb.end(), pixel.begin(), pixel.end());
      }
    }
    return rgb;
  }

 private:
  [[nodiscard]] double distance(std::uint32_t c, std::uint32_t r) const {
    std::array<std::uint32_t, 3> p{};
    p[axis_] = index_;
    p[right_] = c;
    p[up_] = r;
    return image_.distance[image_.order * image_.grid.index(p[0], p[1], p[2])];
  }
  [[nodiscard]] Colour colour(std::uint32_t c, std::uint32_t r, double largest) const {
    const double d = distance(c, r);
    if (!std::isfinite(d)) return {128, 128, 128};
    // The last voxel inside beside one that is not.
    if (d < 0 && ((c > 0 && distance(c - 1, r) >= 0) || (r > 0 && distance(c, r - 1) >= 0) ||
                  (c + 1 < width() && distance(c + 1, r) >= 0) ||
                  (r + 1 < height() && distance(c, r + 1) >= 0))) {
      return {255, 255, 255};
    }
    return colour_of(largest > 0 ? std::abs(d) / largest : 0);
  }

  const FieldImage& image_;
  int axis_;
  std::uint32_t index_;
  int right_, up_;
};

}  // namespace

std::optional<Error> write_slice(const FieldImage& image, int axis, std::uint32_t index,
                                 const std::filesystem::path& file) {
  const Slice slice(image, axis, index);
  const std::vector<std::uint8_t> pixels = slice.pixels();
  png_image png{};
  png.version = PNG_IMAGE_VERSION;
  png.format = PNG_FORMAT_RGB;
  png.width = slice.width();
  png.height = slice.height();
  png_alloc_size_t bytes = PNG_IMAGE_PNG_SIZE_MAX(png);
  std::string encoded(bytes, '\0');
  if (png_image_write_to_memory(&png, encoded.data(), &bytes, 0, pixels.data(), 0, nullptr) == 0) {
    return Error{ErrorCode::kOutputNotWritten, std::string("libpng: ") + png.message, file.string(),
                 std::nullopt};
  }
  encoded.resize(bytes);
  const detail::OutputFile output = {file, [&](detail::OutputStream& out) { out << encoded; }};
  return detail::write_files(std::span(&output, 1));
}

}  // namespace blum::app
