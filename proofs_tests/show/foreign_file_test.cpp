// Values that no result of ours has, and coordinates near the ends of what a model may have.

#include <gtest/gtest.h>

#include <cmath>
#include <filesystem>
#include <fstream>
#include <iterator>
#include <limits>
#include <map>
#include <string>
#include <vector>

#include "blum/kernel/output_files.hpp"
#include "blum/kernel/point_algebra.hpp"
#include "blum/kernel/vtk_xml.hpp"
#include "blum/medial/io.hpp"
#include "blum/show/colours.hpp"
#include "blum/show/page.hpp"
#include "blum/show/render.hpp"
#include "blum/show/visible.hpp"
#include "blum/show/vtp_file.hpp"
#include "subdivision/solid_scenes.hpp"
#include "test_folder.hpp"

namespace blum {
namespace {

namespace fs = std::filesystem;
constexpr double kInfinity = std::numeric_limits<double>::infinity();
constexpr double kNan = std::numeric_limits<double>::quiet_NaN();

class ForeignFile : public testing::Test {
 protected:
  [[nodiscard]] fs::path file(const char* name) const { return folder_.path() / name; }
  /// Writes x.vtp.
  void write(const PolygonMesh& mesh) {
    const Solid solid = test::solid_of(mesh);
    AngleOptions angles;
    angles.wanted = true;
    const MedialResult axis = compute_medial_axis(solid, test::seeded(1), angles).value();
    ASSERT_FALSE(write_medial(axis, solid, file("x")).has_value());
  }
  /// The picture's bytes.
  std::string shown(const Scene& scene, const std::string& colour) {
    RenderOptions options;
    options.width = 32;
    options.height = 24;
    options.colour = colour;
    options.legend = false;
    EXPECT_TRUE(render_png(scene, options, file("x.png")).ok());
    return test::bytes_of(file("x.png"));
  }

 private:
  test::Folder folder_;
};

/// The file with the (last) array of that name in doubles instead, its value `at` changed.
std::string with_value(const std::string& text, const std::string& name, std::vector<double> values,
                       int components, std::size_t at, double value, const fs::path& scratch) {
  values.at(at) = value;
  const std::size_t named = text.rfind("Name=\"" + name + "\""), begin = text.rfind('<', named);
  const std::size_t end = text.find("</DataArray>", named) + std::string("</DataArray>\n").size();
  const detail::OutputFile output = {
      scratch, [&](detail::OutputStream& out) {
        detail::DataArray<double> array(
            out, name, values.size() / static_cast<std::size_t>(components), components);
        for (const double v : values) array.put(v);
      }};
  EXPECT_FALSE(detail::write_files(std::span(&output, 1)).has_value());
  std::ifstream in(scratch, std::ios::binary);
  return text.substr(0, begin) + std::string(std::istreambuf_iterator<char>(in), {}) +
         text.substr(end);
}

TEST_F(ForeignFile, EveryArrayWithABadValue_IsRefusedOrShown) {
  write(shapes::cuboid(1, 2, 3));
  const std::string whole = test::bytes_of(file("x.vtp"));
  const VtpFile read = read_vtp(file("x.vtp")).value();
  std::map<std::string, VtpArray> arrays = {{"Points", {3, {}}}};
  for (const Point3& p : read.point)
    for (int k = 0; k < 3; ++k) arrays["Points"].value.push_back(p[k]);
  for (const VtpArrays& part : {read.cell_data, read.point_data, read.field_data})
    arrays.insert(part.begin(), part.end());
  const auto is_refused = [&](const std::string& name, double value) {
    const VtpArray& array = arrays.at(name);
    // The last cell is a triangle; lines come first.
    std::ofstream(file("x.vtp"), std::ios::binary) << with_value(
        whole, name, array.value, array.components, array.value.size() - 1, value, file("array"));
    const Result<Scene> scene = read_scene(file("x"));
    if (!scene) {
      EXPECT_EQ(scene.error().code, ErrorCode::kMalformedFile);
      return true;
    }
    for (const ScalarField& field : scene.value().field) (void)shown(scene.value(), field.name);
    EXPECT_FALSE(write_page(scene.value(), {}, file("x.html")).has_value());
    (void)visible_cells(scene.value(), 60);
    return false;
  };
  const double biggest = std::numeric_limits<double>::max();
  int arrays_seen = 0;
  for (const auto& [name, array] : arrays) {
    if (array.value.empty()) continue;
    ++arrays_seen;
    EXPECT_FALSE(is_refused(name, array.value.back())) << name;
    for (const double v : {kNan, kInfinity, -kInfinity, biggest, -biggest, -2.0, 0.5, 1e-320})
      (void)is_refused(name, v);
  }
  EXPECT_GT(arrays_seen, 20);
  for (const char* name : {"Points", "solid_points"})
    for (const double v : {kNan, kInfinity, biggest}) EXPECT_TRUE(is_refused(name, v)) << name << v;
  for (const char* name :
       {"sheet", "governor_a", "governor_b", "governor", "governor_offset", "solid_triangles",
        "solid_edges", "site_counts", "triangle_edge", "line_edge"})
    for (const double v : {kNan, kInfinity, -kInfinity, biggest, -biggest, -2.0, 0.5})
      EXPECT_TRUE(is_refused(name, v)) << name << ' ' << v;
  for (const char* name : {"radius", "angle_lo", "angle_hi", "theta"})
    for (const double v : {kNan, kInfinity, -kInfinity})
      EXPECT_TRUE(is_refused(name, v)) << name << ' ' << v;
}

TEST_F(ForeignFile, DeepXml_IsRefused) {
  std::string text;
  for (int i = 0; i < 1000000; ++i) text += "<a>";
  std::ofstream(file("x.vtp")) << text;
  EXPECT_FALSE(read_scene(file("x")).ok());
  for (int i = 0; i < 1000000; ++i) text += "</a>";
  std::ofstream(file("x.vtp")) << text;
  EXPECT_FALSE(read_scene(file("x")).ok());
}

/// Powers of two change no digits, so pictures and the page's coordinates are the same.
TEST_F(ForeignFile, HugeAndTinyModels_LookAlike) {
  const auto base64 = [](const std::string& page, const std::string& name) {
    const std::size_t begin = page.find("id=\"blum-" + name + "\"");
    EXPECT_NE(begin, std::string::npos);
    return page.substr(begin, page.find("</script>", begin) - begin);
  };
  std::string picture, page;
  std::size_t lines = 0;
  for (const int power : {0, 60, 190, -60, -190}) {
    PolygonMesh mesh = shapes::lbracket();
    for (Point3& p : mesh.points) p = std::ldexp(1.0, power) * p;
    write(mesh);
    const Scene scene = read_scene(file("x")).value();
    const std::string now = shown(scene, "radius");
    EXPECT_FALSE(write_page(scene, {}, file("x.html")).has_value());
    const std::string now_page = test::bytes_of(file("x.html"));
    if (power == 0) {
      picture = now;
      page = now_page;
      lines = scene.model_line.size();
      continue;
    }
    EXPECT_EQ(now, picture) << power;
    EXPECT_EQ(scene.model_line.size(), lines) << power;
    for (const char* name : {"point", "model_point"})
      EXPECT_EQ(base64(now_page, name), base64(page, name)) << power << ' ' << name;
    EXPECT_EQ(now_page.find("\"radius\":\"f64\"") != std::string::npos, std::abs(power) > 100);
  }
}

TEST(Colours, NoNumber_IsGrey) {
  const Colour grey = {128, 128, 128};
  EXPECT_EQ(colour_of(kNan), grey);
  EXPECT_EQ(colour_of(kInfinity), colour_of(1));
  EXPECT_EQ(colour_of(-kInfinity), colour_of(0));
  for (const double v : {kNan, kInfinity, -kInfinity, -1.0}) EXPECT_EQ(label_colour(v), grey);
  const std::size_t labels = label_colours().size();
  EXPECT_EQ(label_colour(static_cast<double>(labels) + 1), label_colours()[1]);
  EXPECT_EQ(label_colour(0x1p300), label_colours()[0]);  // a multiple of all powers of two below
  ScalarField field{"thickness", true, false, {1, kNan, 3, kInfinity, -kInfinity}};
  EXPECT_EQ(range_of(field).least, 1);
  EXPECT_EQ(range_of(field).most, 3);
  for (const double v : {kNan, kInfinity}) EXPECT_EQ(colour_in(field, {1, 3}, v), grey);
  EXPECT_EQ(colour_in(field, {1, 3}, 3), colour_of(1));
  field.value = {kNan, kInfinity};
  EXPECT_EQ(range_of(field).most, 1);
}

}  // namespace
}  // namespace blum
