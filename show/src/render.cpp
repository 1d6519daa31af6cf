#include "blum/show/render.hpp"

#include <cairo/cairo.h>

#include <algorithm>
#include <cmath>
#include <cstdio>
#include <utility>
#include <vector>

#include "blum/kernel/parallel.hpp"
#include "blum/show/colours.hpp"
#include "blum/show/visible.hpp"
#include "png_picture.hpp"
#include "projection.hpp"
#include "raster.hpp"

namespace blum {
namespace {

using detail::Raster;
using detail::RasterTriangle;
using detail::RasterVertex;
using detail::Rgb;

constexpr int kMostPixels = 16384;
constexpr int kBandRows = 32;
constexpr Rgb kBackground = {1, 1, 1}, kSeam = {0.10F, 0.10F, 0.10F}, kRim = {0.48F, 0.48F, 0.48F},
              kModelFace = {0.56F, 0.64F, 0.72F}, kModelEdge = {0.35F, 0.42F, 0.49F},
              kUndecided = {0.84F, 0.15F, 0.16F};
constexpr float kModelFaceAlpha = 0.13F, kModelEdgeAlpha = 0.55F, kUndecidedAlpha = 0.15F;

Rgb rgb(const Colour& c) { return {c[0] / 255.0F, c[1] / 255.0F, c[2] / 255.0F}; }
Rgb shaded(const Rgb& c, double light) {
  const auto l = static_cast<float>(light);
  return {c.r * l, c.g * l, c.b * l};
}

struct Translucent {
  RasterTriangle triangle;
  float alpha = 0;
};

/// Everything as triangles on the screen.
class Drawing {
 public:
  Drawing(const Scene& scene, const RenderOptions& options, const ScalarField* field)
      : s_(scene), options_(options), project_(scene, options), field_(field) {
    visible_ = visible_cells(scene, options.theta_deg);
    if (options.sheets) surface();
    if (options.seams) lines(visible_.seam, 2.4, kSeam);
    if (options.rims) lines(visible_.rim, 1.6, kRim);
    if (options.model) model();
    if (options.undecided) undecided();
  }

  [[nodiscard]] std::size_t triangles() const { return visible_.triangle.size(); }

  [[nodiscard]] std::vector<Rgb> band(int first_row, int rows, std::size_t& hit) const {
    Raster raster(options_.width, first_row, rows);
    for (const RasterTriangle& t : opaque_) raster.opaque(t);
    for (const Translucent& t : translucent_) raster.translucent(t.triangle, t.alpha);
    return raster.finish(kBackground, hit);
  }

 private:
  [[nodiscard]] RasterTriangle projected(const Point3& a, const Point3& b, const Point3& c) const {
    return {project_(a), project_(b), project_(c)};
  }
  static void paint(RasterTriangle& t, const Rgb& colour) {
    for (RasterVertex& v : t) v.colour = colour;
  }

  void surface() {
    const ValueRange range = field_ != nullptr ? range_of(*field_) : ValueRange{};
    for (const std::uint32_t i : visible_.triangle) {
      const auto& corner = s_.triangle[i];
      const Point3 &a = s_.point[corner[0]], &b = s_.point[corner[1]], &c = s_.point[corner[2]];
      RasterTriangle t = projected(a, b, c);
      const double light = project_.light(a, b, c);
      for (int k = 0; k < 3; ++k) {
        const Colour colour =
            field_ == nullptr
                ? Colour{170, 180, 190}
                : colour_in(*field_, range, field_->value[field_->per_triangle ? i : corner[k]]);
        t[k].colour = shaded(rgb(colour), light);
      }
      opaque_.push_back(t);
    }
  }

  /// Two triangles as wide as the line on the screen.
  [[nodiscard]] std::array<RasterTriangle, 2> strip(const Point3& p, const Point3& q, double width,
                                                    const Rgb& colour) const {
    const RasterVertex a = project_.nearer(project_(p)), b = project_.nearer(project_(q));
    const double length = std::hypot(b.x - a.x, b.y - a.y);
    const double half = width / 2;
    const double tx = length > 0 ? half * (b.x - a.x) / length : half;
    const double ty = length > 0 ? half * (b.y - a.y) / length : 0;
    std::array<RasterVertex, 4> corner = {a, a, b, b};
    const std::array<double, 4> along = {-0.5, -0.5, 0.5, 0.5}, across = {1, -1, 1, -1};
    for (int k = 0; k < 4; ++k) {
      corner[k].x += along[k] * tx - across[k] * ty;
      corner[k].y += along[k] * ty + across[k] * tx;
      corner[k].colour = colour;
    }
    return {RasterTriangle{corner[0], corner[1], corner[2]},
            RasterTriangle{corner[1], corner[3], corner[2]}};
  }
  void lines(const std::vector<std::uint32_t>& list, double width, const Rgb& colour) {
    for (const std::uint32_t i : list) {
      for (const auto& t : strip(s_.point[s_.line[i][0]], s_.point[s_.line[i][1]], width, colour)) {
        opaque_.push_back(t);
      }
    }
  }

  void model() {
    for (const auto& corner : s_.model_triangle) {
      const Point3 &a = s_.model_point[corner[0]], &b = s_.model_point[corner[1]],
                   &c = s_.model_point[corner[2]];
      RasterTriangle t = projected(a, b, c);
      paint(t, shaded(kModelFace, project_.light(a, b, c)));
      translucent_.push_back({t, kModelFaceAlpha});
    }
    for (const auto& end : s_.model_line) {
      for (const auto& t : strip(s_.model_point[end[0]], s_.model_point[end[1]], 1.2, kModelEdge)) {
        translucent_.push_back({t, kModelEdgeAlpha});
      }
    }
  }

  void undecided() {
    for (const auto& box : s_.undecided) {
      const auto corner = [&](int m) {
        return Point3{box[m & 1].x, box[m >> 1 & 1].y, box[m >> 2 & 1].z};
      };
      for (int axis = 0; axis < 3; ++axis) {
        const int u = 1 << (axis + 1) % 3, v = 1 << (axis + 2) % 3;
        for (const int base : {0, 1 << axis}) {
          for (const auto& [p, q] : {std::pair(u, u | v), std::pair(u | v, v)}) {
            RasterTriangle t = projected(corner(base), corner(base | p), corner(base | q));
            paint(t, kUndecided);
            translucent_.push_back({t, kUndecidedAlpha});
          }
        }
        for (const int start : {0, u, v, u | v}) {
          for (const auto& t : strip(corner(start), corner(start | 1 << axis), 1.2, kUndecided)) {
            opaque_.push_back(t);
          }
        }
      }
    }
  }

  const Scene& s_;
  const RenderOptions& options_;
  detail::Projection project_;
  const ScalarField* field_;
  VisibleCells visible_;
  std::vector<RasterTriangle> opaque_;
  std::vector<Translucent> translucent_;
};

void put_legend(cairo_t* cairo, const RenderOptions& options, const ScalarField& field) {
  const double unit = std::min(options.width, options.height) / 900.0 * 15;
  const double width = 18 * unit, height = 0.9 * unit;
  const double x = options.width - width - 2 * unit, y = options.height - 3.2 * unit;
  cairo_select_font_face(cairo, "sans-serif", CAIRO_FONT_SLANT_NORMAL, CAIRO_FONT_WEIGHT_NORMAL);
  cairo_set_font_size(cairo, 1.1 * unit);
  cairo_pattern_t* const gradient = cairo_pattern_create_linear(x, 0, x + width, 0);
  const auto stops = colour_stops();
  for (std::size_t i = 0; i < stops.size(); ++i) {
    const Rgb c = rgb(stops[i]);
    cairo_pattern_add_color_stop_rgb(
        gradient, static_cast<double>(i) / static_cast<double>(stops.size() - 1), c.r, c.g, c.b);
  }
  if (!field.is_label) {
    cairo_rectangle(cairo, x, y, width, height);
    cairo_set_source(cairo, gradient);
    cairo_fill(cairo);
  }
  cairo_pattern_destroy(gradient);
  cairo_set_source_rgb(cairo, 0.15, 0.15, 0.15);
  if (field.is_label) {
    detail::put_text(cairo, x + width, y + 2.2 * unit, 1, ("one colour a " + field.name).c_str());
    return;
  }
  const ValueRange range = range_of(field);
  const bool is_angle = field.name == "angle";
  const auto put_number = [&](double value, double align) {
    std::array<char, 32> text;
    std::snprintf(text.data(), text.size(), is_angle ? "%.4g°" : "%.4g", value);
    detail::put_text(cairo, x + align * width, y + 2.2 * unit, align, text.data());
  };
  put_number(range.least, 0);
  put_number(range.most, 1);
  detail::put_text(cairo, x + width / 2, y - 0.5 * unit, 0.5, field.name.c_str());
}

Error bad(const std::string& message) {
  return {ErrorCode::kBadArgument, message, "", std::nullopt};
}

}  // namespace

Result<RenderReport> render_png(const Scene& scene, const RenderOptions& options,
                                const std::filesystem::path& file) {
  if (options.width < 16 || options.height < 16 || options.width > kMostPixels ||
      options.height > kMostPixels) {
    return bad("a picture has from 16 to 16384 pixels on each side");
  }
  if (!(options.zoom > 0 && options.zoom <= 1000)) return bad("zoom is not in (0, 1000]");
  if (options.section && !(options.section->at >= 0 && options.section->at <= 1)) {
    return bad("a section is at a fraction from 0 to 1 of the box");
  }
  const ScalarField* field = scene.field.empty() ? nullptr : &scene.field.front();
  if (!options.colour.empty()) {
    std::string known;
    field = nullptr;
    for (const ScalarField& f : scene.field) {
      if (f.name == options.colour) field = &f;
      known += (known.empty() ? "" : ", ") + f.name;
    }
    if (field == nullptr) {
      return bad("this result has no '" + options.colour + "' to colour by; it has: " + known);
    }
  }
  const Drawing drawing(scene, options, field);
  const auto width = static_cast<std::size_t>(options.width),
             height = static_cast<std::size_t>(options.height);
  std::vector<Rgb> pixels(width * height);
  const std::size_t bands = (height + kBandRows - 1) / kBandRows;
  std::vector<std::size_t> hit(bands, 0);
  for_each_in_parallel(std::max(options.threads, 1), bands, [&](int, std::size_t k) {
    const int first = static_cast<int>(k) * kBandRows;
    const int rows = std::min(kBandRows, options.height - first);
    const std::vector<Rgb> band = drawing.band(first, rows, hit[k]);
    std::copy(
        band.begin(), band.end(),
        pixels.begin() + static_cast<std::ptrdiff_t>(static_cast<std::size_t>(first) * width));
  });
  RenderReport report;
  report.triangles = drawing.triangles();
  std::size_t all = 0;
  for (const std::size_t h : hit) all += h;
  report.covered_fraction = static_cast<double>(all) /
                            static_cast<double>(width * height * Raster::kSide * Raster::kSide);
  const auto decorate = [&](cairo_t* cairo) {
    if (options.legend && options.sheets && field != nullptr) put_legend(cairo, options, *field);
  };
  if (auto error = detail::write_png(pixels, options.width, options.height, decorate, file)) {
    return *error;
  }
  return report;
}

}  // namespace blum
