#include "blum/show/chart.hpp"

#include <cairo/cairo.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <cstdio>
#include <vector>

#include "blum/show/colours.hpp"
#include "png_picture.hpp"

namespace blum {
namespace {

/// 1, 2 or 5 times a power of ten: about five steps up to `most`.
double nice_step(double most) {
  const double raw = most / 5, power = std::pow(10, std::floor(std::log10(raw)));
  for (const double factor : {1.0, 2.0, 5.0}) {
    if (factor * power >= raw) return factor * power;
  }
  return 10 * power;
}

class Bars {
 public:
  Bars(const BarChart& chart, cairo_t* cairo) : chart_(chart), c_(cairo) {
    right_value_ = chart.bin_width * static_cast<double>(chart.height.size());
    for (const double h : chart.height) top_value_ = std::max(top_value_, h);
    if (!(top_value_ > 0)) top_value_ = 1;
    if (!(right_value_ > 0)) right_value_ = 1;
  }

  void draw() {
    cairo_select_font_face(c_, "sans-serif", CAIRO_FONT_SLANT_NORMAL, CAIRO_FONT_WEIGHT_NORMAL);
    cairo_set_font_size(c_, 15);
    grid();
    for (std::size_t i = 0; i < chart_.height.size(); ++i) bar(i);
    cairo_set_source_rgb(c_, 0.15, 0.15, 0.15);
    cairo_set_line_width(c_, 1.2);
    cairo_move_to(c_, kLeft, kTop);
    cairo_line_to(c_, kLeft, bottom());
    cairo_line_to(c_, right(), bottom());
    cairo_stroke(c_);
    detail::put_text(c_, (kLeft + right()) / 2, bottom() + 46, 0.5, chart_.x_label.c_str());
    detail::put_text(c_, kLeft - 55, kTop - 14, 0, chart_.y_label.c_str());
    cairo_set_font_size(c_, 17);
    detail::put_text(c_, (kLeft + right()) / 2, kTop - 32, 0.5, chart_.title.c_str());
  }

 private:
  static constexpr double kLeft = 80, kTop = 64;
  [[nodiscard]] double right() const { return chart_.width_px - 30; }
  [[nodiscard]] double bottom() const { return chart_.height_px - 66; }
  [[nodiscard]] double x(double value) const {
    return kLeft + (right() - kLeft) * value / right_value_;
  }
  [[nodiscard]] double y(double value) const {
    return bottom() - (bottom() - kTop) * value / top_value_;
  }
  static std::string number(double value) {
    std::array<char, 32> text;
    std::snprintf(text.data(), text.size(), "%.4g", value);
    return text.data();
  }

  void grid() {
    cairo_set_line_width(c_, 1);
    const double dy = nice_step(top_value_), dx = nice_step(right_value_);
    for (int i = 0; i * dy <= top_value_ * (1 + 1e-9); ++i) {
      cairo_set_source_rgb(c_, 0.88, 0.88, 0.88);
      cairo_move_to(c_, kLeft, y(i * dy));
      cairo_line_to(c_, right(), y(i * dy));
      cairo_stroke(c_);
      cairo_set_source_rgb(c_, 0.15, 0.15, 0.15);
      detail::put_text(c_, kLeft - 8, y(i * dy) + 5, 1, number(i * dy).c_str());
    }
    for (int i = 0; i * dx <= right_value_ * (1 + 1e-9); ++i) {
      detail::put_text(c_, x(i * dx), bottom() + 21, 0.5, number(i * dx).c_str());
    }
  }

  void bar(std::size_t i) {
    const double from = static_cast<double>(i) * chart_.bin_width;
    const Colour colour = colour_of((from + chart_.bin_width / 2) / right_value_);
    cairo_set_source_rgb(c_, colour[0] / 255.0, colour[1] / 255.0, colour[2] / 255.0);
    const double x0 = x(from), x1 = x(from + chart_.bin_width), top = y(chart_.height[i]);
    cairo_rectangle(c_, x0 + 0.5, top, std::max(1.0, x1 - x0 - 1), bottom() - top);
    cairo_fill(c_);
  }

  const BarChart& chart_;
  cairo_t* c_;
  double right_value_ = 0, top_value_ = 0;
};

}  // namespace

std::optional<Error> write_bar_chart(const BarChart& chart, const std::filesystem::path& file) {
  const std::vector<detail::Rgb> white(
      static_cast<std::size_t>(chart.width_px) * static_cast<std::size_t>(chart.height_px),
      {1, 1, 1});
  return detail::write_png(
      white, chart.width_px, chart.height_px, [&](cairo_t* cairo) { Bars(chart, cairo).draw(); },
      file);
}

}  // namespace blum
