#include "blum/show/page.hpp"

#include <algorithm>
#include <cmath>
#include <limits>
#include <nlohmann/json.hpp>
#include <span>
#include <string>
#include <string_view>
#include <type_traits>
#include <utility>
#include <vector>

#include "blum/kernel/check.hpp"
#include "blum/kernel/output_files.hpp"
#include "blum/kernel/point_algebra.hpp"
#include "blum/show/colours.hpp"
#include "embedded_page.hpp"

namespace blum {
namespace {

using Json = nlohmann::ordered_json;
using detail::OutputStream;

constexpr std::string_view kDataMark = "<!-- blum:data -->";

template <class T>
constexpr const char* short_type() {
  if constexpr (std::is_same_v<T, float>) return "f32";
  if constexpr (std::is_same_v<T, double>) return "f64";
  if constexpr (std::is_same_v<T, std::uint32_t>) return "u32";
  if constexpr (std::is_same_v<T, std::int32_t>) return "i32";
  if constexpr (std::is_same_v<T, std::uint8_t>) return "u8";
}

/// Text inside a script element: "<" could begin its end.
std::string for_element(std::string json) {
  for (std::size_t at = 0; (at = json.find('<', at)) != std::string::npos; at += 6) {
    json.replace(at, 1, "\\u003c");
  }
  return json;
}

/// Whether floats keep what is to be seen of the values: what is far smaller than others may
/// vanish.
bool fit_floats(std::span<const double> values) {
  double most = 0;
  for (const double v : values) {
    if (std::isfinite(v)) most = std::max(most, std::abs(v));
  }
  return most == 0 ||
         (most >= std::numeric_limits<float>::min() && most <= std::numeric_limits<float>::max());
}

class Page {
 public:
  Page(const Scene& scene, const Camera& camera) : s_(scene) {
    centre();
    header_["title"] = s_.title;
    header_["facts"] = s_.fact;
    header_["siteCounts"] = s_.site_counts;
    header_["colours"] = {{"map", list(colour_stops())}, {"labels", list(label_colours())}};
    header_["camera"] = {{"azimuth", camera.azimuth_deg}, {"elevation", camera.elevation_deg}};
    header_["origin"] = {origin_.x, origin_.y, origin_.z};
    header_["unit"] = unit_;
    header_["fields"] = Json::array();
    for (const ScalarField& f : s_.field) {
      header_["fields"].push_back(
          {{"name", f.name}, {"perTriangle", f.per_triangle}, {"isLabel", f.is_label}});
    }
    header_["arrays"] = Json::object();
  }

  void write(OutputStream& out) {
    const std::string_view page = detail::embedded_page();
    const std::size_t mark = page.find(kDataMark);
    BLUM_CHECK(mark != std::string_view::npos);
    out << page.substr(0, mark);
    arrays(out);
    out << "<script type=\"application/json\" id=\"blum-header\">"
        << for_element(header_.dump(-1, ' ', true, Json::error_handler_t::replace)) << "</script>\n"
        << page.substr(mark + kDataMark.size());
  }

 private:
  static Json list(std::span<const Colour> colours) {
    Json result = Json::array();
    for (const Colour& c : colours) result.push_back({c[0], c[1], c[2]});
    return result;
  }

  /// Floats are fine near 0 alone, and pages are drawn with floats: coordinates are those about a
  /// point, in a unit (a power of two, so that it costs no digits) as large as the scene.
  void centre() {
    const Box3 box = bounds_of(s_);
    origin_ = middle(box.lo, box.hi);
    int exponent = 0;
    std::frexp(diameter(box), &exponent);
    unit_ = std::ldexp(1.0, exponent);
  }

  template <class T, class Values>
  void array(OutputStream& out, const std::string& name, const Values& values) {
    header_["arrays"][name] = short_type<T>();
    out << "<script type=\"application/base64\" id=\"blum-" << name << "\">";
    detail::Base64 base64(out);
    for (const auto& v : values) put<T>(base64, v);
    base64.end();
    out << "</script>\n";
  }
  template <class T, class Value>
  void put(detail::Base64& base64, const Value& v) const {
    if constexpr (std::is_same_v<Value, Point3>) {
      for (int k = 0; k < 3; ++k) base64.put(static_cast<T>((v[k] - origin_[k]) / unit_));
    } else if constexpr (std::is_arithmetic_v<Value>) {
      base64.put(static_cast<T>(v));
    } else {
      for (const auto& part : v) put<T>(base64, part);
    }
  }

  void values(OutputStream& out, const std::string& name, std::span<const double> values) {
    if (fit_floats(values)) {
      array<float>(out, name, values);
    } else {
      array<double>(out, name, values);
    }
  }

  void arrays(OutputStream& out) {
    array<float>(out, "point", s_.point);
    array<std::uint32_t>(out, "triangle", s_.triangle);
    array<std::uint32_t>(out, "line", s_.line);
    array<std::int32_t>(out, "line_seam", s_.line_seam);
    array<float>(out, "model_point", s_.model_point);
    array<std::uint32_t>(out, "model_triangle", s_.model_triangle);
    array<std::uint32_t>(out, "model_edge", s_.model_edge);
    array<std::uint32_t>(out, "model_line", s_.model_line);
    array<float>(out, "undecided", s_.undecided);
    for (std::size_t i = 0; i < s_.field.size(); ++i) {
      values(out, "field_" + std::to_string(i), s_.field[i].value);
    }
    // The rest is there or is not: the page asks.
    if (!s_.triangle_theta.empty()) {
      array<double>(out, "triangle_theta", s_.triangle_theta);
      array<double>(out, "line_theta", s_.line_theta);
    }
    if (!s_.triangle_edge.empty()) {
      array<std::uint32_t>(out, "triangle_edge", s_.triangle_edge);
      array<std::uint32_t>(out, "line_edge", s_.line_edge);
    }
    if (!s_.triangle_angle.empty()) array<double>(out, "triangle_angle", s_.triangle_angle);
    if (!s_.triangle_governor.empty()) {
      array<std::int32_t>(out, "triangle_governor", s_.triangle_governor);
    }
    if (!s_.radius.empty()) values(out, "radius", s_.radius);
    if (!s_.on_axis.empty()) array<std::uint8_t>(out, "on_axis", s_.on_axis);
    if (!s_.governor_begin.empty()) {
      array<std::uint32_t>(out, "governor_begin", s_.governor_begin);
      array<std::uint32_t>(out, "governor", s_.governor);
    }
  }

  const Scene& s_;
  Point3 origin_;
  double unit_ = 1;
  Json header_;
};

}  // namespace

std::optional<Error> write_page(const Scene& scene, const Camera& camera,
                                const std::filesystem::path& file) {
  const detail::OutputFile output = {file,
                                     [&](OutputStream& out) { Page(scene, camera).write(out); }};
  return detail::write_files(std::span(&output, 1));
}

}  // namespace blum
