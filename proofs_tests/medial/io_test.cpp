// The writers: what a reader gets back bit by bit, and what is left behind when writing fails.

#include "blum/medial/io.hpp"

#include <gtest/gtest.h>
#include <sys/resource.h>

#include <algorithm>
#include <charconv>
#include <cmath>
#include <csignal>
#include <cstring>
#include <filesystem>
#include <fstream>
#include <limits>
#include <map>
#include <sstream>
#include <string>
#include <vector>

#include "medial/parts_builder.hpp"
#include "test_folder.hpp"

namespace blum {
namespace {

namespace fs = std::filesystem;

/// A fresh directory that goes with the test.
class IoTest : public testing::Test {
 protected:
  [[nodiscard]] std::vector<std::string> files() const {
    std::vector<std::string> names;
    for (const auto& entry : fs::directory_iterator(directory_)) {
      names.push_back(entry.path().filename().string());
    }
    std::sort(names.begin(), names.end());
    return names;
  }

  const test::Folder folder_;
  const fs::path directory_ = folder_.path();
};

const std::vector<double> kAwkward = {
    0.1, -0.0, 1e-300, 5e-324, 1.0 / 3, 0x1.fffffffffffffp199, std::nextafter(1.0, 2.0)};

/// A seam with three sheets; awkward positions and radii.
MedialResult seam_result() {
  fixtures::ConeComplexBuilder b;
  const auto p = b.node(ComplexVertex::Kind::kEvent), q = b.node(ComplexVertex::Kind::kEvent);
  b.cone({b.arc(p, q), b.arc(p, q), b.arc(p, q)});
  MedialResult r;
  r.certified = true;
  r.seed = 17;
  r.complex = b.complex();
  for (std::size_t i = 0; i < r.complex.vertex.size(); ++i) {
    ComplexVertex& v = r.complex.vertex[i];
    v.position = {kAwkward[i], kAwkward[i + 1], kAwkward[i + 2]};
    v.radius = kAwkward[i + 3];
    for (std::uint32_t g = 0; g < i; ++g) v.governors.push_back({g + 5});
  }
  for (std::uint32_t t = 0; t < 3; ++t) r.complex.triangle[t].governors = {SiteId{t}, SiteId{9}};
  r.parts = read_parts(r.complex);
  r.undecided.push_back({{{0, 0, 0}, {1, 2, 3}}, UndecidedReason::kTime});
  return r;
}

Solid tetrahedron() {
  Solid s;
  s.frame.exponent = 1;
  s.frame.origin = {8, 0, 0};
  s.point = {{0, 0, 0}, {0.5, 0, 0}, {0, 0.5, 0}, {0, 0, 0.5}};
  s.edge.resize(6);
  s.edge[5].vertex = {2, 3};
  s.triangle.resize(4);
  s.triangle[3].vertex = {1, 2, 3};
  return s;
}

double number(const std::string& text) {
  double value = std::numeric_limits<double>::quiet_NaN();
  std::from_chars(text.data(), text.data() + text.size(), value);
  return value;
}

bool same_bits(double a, double b) { return std::memcmp(&a, &b, sizeof a) == 0; }

TEST_F(IoTest, Ma_ReadsBackBitIdentical) {
  const MedialResult r = seam_result();
  ASSERT_FALSE(write_ma(r, directory_ / "x.ma"));
  std::istringstream in(test::bytes_of(directory_ / "x.ma"));
  std::size_t nv, ne, nf;
  in >> nv >> ne >> nf;
  ASSERT_EQ(nv, r.complex.vertex.size());
  ASSERT_EQ(ne, r.complex.edge.size());
  ASSERT_EQ(nf, r.complex.triangle.size());
  for (const ComplexVertex& v : r.complex.vertex) {
    std::string tag, x, y, z, radius;
    in >> tag >> x >> y >> z >> radius;
    EXPECT_EQ(tag, "v");
    EXPECT_TRUE(same_bits(number(x), v.position.x) && same_bits(number(y), v.position.y) &&
                same_bits(number(z), v.position.z) && same_bits(number(radius), v.radius));
  }
  std::string tag;
  std::uint32_t i, j, k;
  for (const ComplexEdge& e : r.complex.edge) {
    in >> tag >> i >> j;
    EXPECT_EQ(tag, "e");
    EXPECT_EQ((std::array{i, j}), e.vertex);
  }
  for (std::size_t t = 0; t < nf; ++t) {
    in >> tag >> i >> j >> k;
    EXPECT_EQ(tag, "f");
    EXPECT_EQ((std::array{i, j, k}), (std::array{0u, 1u, 2u}));
  }
  EXPECT_TRUE(in);
  EXPECT_FALSE(in >> tag);
}

TEST_F(IoTest, Obj_DrawsSeamsAsLines) {
  const MedialResult r = seam_result();
  ASSERT_FALSE(write_obj(r, directory_ / "x.obj"));
  const std::string text = test::bytes_of(directory_ / "x.obj");
  EXPECT_NE(text.find("f 1 2 3\nf 1 2 3\nf 1 2 3\n"), std::string::npos);
  EXPECT_NE(text.find("l 1 3\n"), std::string::npos);
  EXPECT_NE(text.find("l 2 3\n"), std::string::npos);
  EXPECT_EQ(std::count(text.begin(), text.end(), 'l'), 5);  // the base arcs are free here
}

/// Just enough of a reader: name -> decoded bytes without the length, which is checked.
std::map<std::string, std::string> vtp_arrays(const std::string& text) {
  const std::string digits = "ABCDEFGHIJKLMNOPQRSTUVWXYZabcdefghijklmnopqrstuvwxyz0123456789+/";
  std::map<std::string, std::string> arrays;
  std::string scope;
  std::istringstream lines(text);
  for (std::string line; std::getline(lines, line);) {
    if (line == "<Lines>" || line == "<Polys>") scope = line;
    if (line.rfind("<DataArray", 0) != 0) continue;
    const std::size_t from = line.find("Name=\"") + 6;
    std::string name = line.substr(from, line.find('"', from) - from);
    if (name == "connectivity" || name == "offsets") name = scope + name;
    std::string data, bytes;
    std::getline(lines, data);
    EXPECT_EQ(data.size() % 4, 0u);
    for (std::size_t i = 0; i < data.size(); i += 4) {
      std::uint32_t group = 0;
      int kept = 3;
      for (std::size_t j = i; j < i + 4; ++j) {
        group <<= 6;
        if (data[j] == '=') {
          --kept;
        } else {
          group |= static_cast<std::uint32_t>(digits.find(data[j]));
        }
      }
      for (int j = 0; j < kept; ++j) bytes += static_cast<char>(group >> (16 - 8 * j) & 255);
    }
    std::uint64_t length = 0;
    std::memcpy(&length, bytes.data(), 8);
    EXPECT_EQ(length + 8, bytes.size()) << name;
    arrays[name] = bytes.substr(8);
  }
  return arrays;
}

template <class T>
std::vector<T> values(const std::string& bytes) {
  std::vector<T> out(bytes.size() / sizeof(T));
  std::memcpy(out.data(), bytes.data(), out.size() * sizeof(T));
  return out;
}

TEST_F(IoTest, Vtp_ReadsBackBitIdentical) {
  const MedialResult r = seam_result();
  ASSERT_FALSE(write_vtp(r, tetrahedron(), directory_ / "x.vtp"));
  auto arrays = vtp_arrays(test::bytes_of(directory_ / "x.vtp"));
  const auto points = values<double>(arrays.at("Points"));
  const auto radius = values<double>(arrays.at("radius"));
  ASSERT_EQ(points.size(), 9u);
  ASSERT_EQ(radius.size(), 3u);
  for (std::size_t i = 0; i < 3; ++i) {
    const ComplexVertex& v = r.complex.vertex[i];
    for (int axis = 0; axis < 3; ++axis) {
      EXPECT_TRUE(same_bits(points[3 * i + static_cast<std::size_t>(axis)], v.position[axis]));
    }
    EXPECT_TRUE(same_bits(radius[i], v.radius));
  }
  EXPECT_EQ(values<std::uint8_t>(arrays.at("on_axis")), (std::vector<std::uint8_t>{1, 1, 0}));
  EXPECT_EQ(values<std::uint8_t>(arrays.at("kind")), (std::vector<std::uint8_t>{1, 1, 5}));
  using Ints = std::vector<std::int64_t>;
  EXPECT_EQ(values<std::int64_t>(arrays.at("governor_offset")), (Ints{0, 0, 1, 3}));
  EXPECT_EQ(values<std::int64_t>(arrays.at("governor")), (Ints{5, 5, 6}));
  EXPECT_EQ(values<std::int64_t>(arrays.at("site_counts")), (Ints{4, 6, 4}));
  EXPECT_EQ(values<double>(arrays.at("solid_points")),
            (std::vector<double>{8, 0, 0, 9, 0, 0, 8, 1, 0, 8, 0, 1}));
  EXPECT_EQ(values<std::int64_t>(arrays.at("solid_edges")).back(), 3);
  EXPECT_EQ(values<std::int64_t>(arrays.at("solid_triangles")).size(), 12u);
  EXPECT_EQ(values<double>(arrays.at("undecided_box")), (std::vector<double>{0, 0, 0, 1, 2, 3}));
  EXPECT_EQ(values<std::uint8_t>(arrays.at("undecided_reason")), (std::vector<std::uint8_t>{2}));
  EXPECT_EQ(values<std::uint64_t>(arrays.at("seed")), (std::vector<std::uint64_t>{17}));
  // Lines: the three free base arcs, then the two seam edges.
  EXPECT_EQ(values<std::int64_t>(arrays.at("<Lines>connectivity")),
            (Ints{0, 1, 0, 1, 0, 1, 0, 2, 1, 2}));
  EXPECT_EQ(values<std::int64_t>(arrays.at("<Lines>offsets")), (Ints{2, 4, 6, 8, 10}));
  EXPECT_EQ(values<std::int64_t>(arrays.at("<Polys>connectivity")),
            (Ints{0, 1, 2, 0, 1, 2, 0, 1, 2}));
  EXPECT_EQ(values<std::int64_t>(arrays.at("<Polys>offsets")), (Ints{3, 6, 9}));
  EXPECT_EQ(values<std::int32_t>(arrays.at("sheet")),
            (std::vector<std::int32_t>{-1, -1, -1, -1, -1, 0, 1, 2}));
  EXPECT_EQ(values<std::int32_t>(arrays.at("seam")),
            (std::vector<std::int32_t>{-1, -1, -1, 0, 0, -1, -1, -1}));
  EXPECT_EQ(values<std::int64_t>(arrays.at("governor_a")), (Ints{0, 1, 2, -1, -1, 0, 1, 2}));
  EXPECT_EQ(values<std::int64_t>(arrays.at("governor_b")), (Ints{9, 9, 9, -1, -1, 9, 9, 9}));
}

TEST_F(IoTest, Vtp_SaysWhatItHolds) {
  MedialResult r = seam_result();
  r.betti = {1, 2, 0};
  r.hausdorff_bound = 0.1;
  r.parts.junctions = 4;
  r.parts.clusters = 5;
  const auto arrays_of = [&] {
    EXPECT_FALSE(write_vtp(r, tetrahedron(), directory_ / "x.vtp"));
    return vtp_arrays(test::bytes_of(directory_ / "x.vtp"));
  };
  const auto number = [](const auto& arrays, const char* name) {
    return values<std::int64_t>(arrays.at(name)).at(0);
  };
  using Ints = std::vector<std::int64_t>;
  auto arrays = arrays_of();
  EXPECT_EQ(values<std::uint8_t>(arrays.at("pruned")), std::vector<std::uint8_t>{0});
  EXPECT_EQ(values<std::int64_t>(arrays.at("betti")), (Ints{1, 2, 0}));
  EXPECT_EQ(number(arrays, "sheets"), 3);
  EXPECT_EQ(number(arrays, "seams"), 1);
  EXPECT_EQ(number(arrays, "junctions"), 4);
  EXPECT_EQ(number(arrays, "clusters"), 5);
  EXPECT_EQ(values<double>(arrays.at("hausdorff_bound")), std::vector<double>{0.1});

  r.smoothed = true;
  arrays = arrays_of();
  EXPECT_FALSE(arrays.contains("hausdorff_bound"));
  EXPECT_EQ(number(arrays, "sheets"), 3);
  r.smoothed = false;
  r.hausdorff_bound = std::numeric_limits<double>::infinity();
  EXPECT_FALSE(arrays_of().contains("hausdorff_bound"));
  r.hausdorff_bound = 0.1;
  r.certified = false;
  arrays = arrays_of();
  EXPECT_FALSE(arrays.contains("hausdorff_bound"));
  EXPECT_FALSE(arrays.contains("betti"));

  // A sheet less, as simplified() leaves it: the two that are left are one.
  r.certified = true;
  r.complex.triangle.pop_back();
  r.parts.triangle_sheet.pop_back();
  arrays = arrays_of();
  EXPECT_EQ(values<std::uint8_t>(arrays.at("pruned")), std::vector<std::uint8_t>{1});
  EXPECT_EQ(values<std::uint8_t>(arrays.at("certified")), std::vector<std::uint8_t>{1});
  EXPECT_EQ(number(arrays, "sheets"), 1);
  EXPECT_EQ(number(arrays, "seams"), 0);
  EXPECT_FALSE(arrays.contains("clusters"));
  EXPECT_FALSE(arrays.contains("hausdorff_bound"));
}

TEST_F(IoTest, Vtp_OfAnEmptyResult_IsWellFormed) {
  ASSERT_FALSE(write_vtp(MedialResult{}, Solid{}, directory_ / "x.vtp"));
  const auto arrays = vtp_arrays(test::bytes_of(directory_ / "x.vtp"));
  EXPECT_EQ(arrays.at("Points"), "");
  EXPECT_EQ(values<std::int64_t>(arrays.at("governor_offset")), std::vector<std::int64_t>{0});
}

TEST_F(IoTest, Undecided_AreBoxesOfSixQuadrilateralsFacingOutwards) {
  const std::vector<UndecidedCell> cells{{{{0, 0, 0}, {1, 2, 3}}, UndecidedReason::kTime, 7},
                                         {{{4, 5, 6}, {8, 8, 8}}, UndecidedReason::kDepth, 96}};
  ASSERT_FALSE(write_undecided(cells, directory_ / "x.undecided.vtp"));
  const auto arrays = vtp_arrays(test::bytes_of(directory_ / "x.undecided.vtp"));
  const auto reason = values<std::uint8_t>(arrays.at("reason"));
  const auto depth = values<std::int32_t>(arrays.at("depth"));
  const auto cell = values<std::int64_t>(arrays.at("cell"));
  const auto point = values<double>(arrays.at("Points"));
  const auto corner = values<std::int64_t>(arrays.at("<Polys>connectivity"));
  ASSERT_EQ(point.size(), 2u * 8 * 3);
  ASSERT_EQ(corner.size(), 2u * 6 * 4);
  EXPECT_EQ(values<std::int64_t>(arrays.at("<Polys>offsets")).back(), 48);
  for (std::size_t q = 0; q < 12; ++q) {
    EXPECT_EQ(reason.at(q), static_cast<std::uint8_t>(cells[q / 6].reason));
    EXPECT_EQ(depth.at(q), cells[q / 6].depth);
    EXPECT_EQ(cell.at(q), static_cast<std::int64_t>(q / 6));
  }
  // The volume by the divergence theorem: sum of corner . (area vector) / 3.
  for (std::size_t c = 0; c < 2; ++c) {
    double volume = 0;
    for (std::size_t q = 6 * c; q < 6 * c + 6; ++q) {
      const auto at = [&](std::size_t k) {
        const auto p = static_cast<std::size_t>(corner[4 * q + k]);
        return Point3{point[3 * p], point[3 * p + 1], point[3 * p + 2]};
      };
      const Point3 a = at(0), b = at(1), d = at(3);
      const Point3 u{b.x - a.x, b.y - a.y, b.z - a.z}, v{d.x - a.x, d.y - a.y, d.z - a.z};
      volume += (a.x * (u.y * v.z - u.z * v.y) + a.y * (u.z * v.x - u.x * v.z) +
                 a.z * (u.x * v.y - u.y * v.x)) /
                3;
    }
    EXPECT_DOUBLE_EQ(volume, c == 0 ? 6 : 24);
  }
}

TEST_F(IoTest, WriteMedial_UndecidedFileIsThereIfAndOnlyIfNotCertified) {
  MedialResult r = seam_result();
  r.certified = false;
  ASSERT_FALSE(write_medial(r, tetrahedron(), directory_ / "x"));
  EXPECT_EQ(files(), (std::vector<std::string>{"x.ma", "x.obj", "x.undecided.vtp", "x.vtp"}));
  r.certified = true;
  r.undecided.clear();
  ASSERT_FALSE(write_medial(r, tetrahedron(), directory_ / "x"));
  EXPECT_EQ(files(), (std::vector<std::string>{"x.ma", "x.obj", "x.vtp"}));
}

TEST_F(IoTest, WriteMedial_AppendsSuffixesAndLeavesNothingElse) {
  ASSERT_FALSE(write_medial(seam_result(), tetrahedron(), directory_ / "part.v2"));
  EXPECT_EQ(files(), (std::vector<std::string>{"part.v2.ma", "part.v2.obj", "part.v2.vtp"}));
}

TEST_F(IoTest, WriteMedial_WritesTextsAlongOrNothing) {
  const MedialResult r = seam_result();
  const std::vector<TextFile> bad = {{directory_ / "no" / "s.json", "{}"}};
  const auto error = write_medial(r, tetrahedron(), directory_ / "x", bad);
  ASSERT_TRUE(error);
  EXPECT_EQ(error->file, bad[0].path.string());
  EXPECT_TRUE(files().empty());
  const std::vector<TextFile> good = {{directory_ / "s.json", "{}"}};
  ASSERT_FALSE(write_medial(r, tetrahedron(), directory_ / "x", good));
  EXPECT_EQ(test::bytes_of(directory_ / "s.json"), "{}");
  EXPECT_EQ(files().size(), 4u);
}

TEST_F(IoTest, MissingDirectory_IsAnErrorThatNamesTheFile) {
  const auto error = write_medial(seam_result(), tetrahedron(), directory_ / "no" / "x");
  ASSERT_TRUE(error);
  EXPECT_EQ(error->code, ErrorCode::kOutputNotWritten);
  EXPECT_EQ(error->file, (directory_ / "no" / "x.ma").string());
  EXPECT_NE(error->message.find("No such file"), std::string::npos);
}

TEST_F(IoTest, OneNameTakenByADirectory_WritesNoneOfTheThree) {
  fs::create_directory(directory_ / "x.obj");
  const auto error = write_medial(seam_result(), tetrahedron(), directory_ / "x");
  ASSERT_TRUE(error);
  EXPECT_EQ(error->code, ErrorCode::kOutputNotWritten);
  EXPECT_EQ(files(), std::vector<std::string>{"x.obj"});
}

/// No file may grow beyond the limit while this lives: a full disk, as far as write() can tell.
class FileSizeLimit {
 public:
  explicit FileSizeLimit(rlim_t bytes) {
    getrlimit(RLIMIT_FSIZE, &before_);
    rlimit now = before_;
    now.rlim_cur = bytes;
    handler_ = std::signal(SIGXFSZ, SIG_IGN);
    setrlimit(RLIMIT_FSIZE, &now);
  }
  ~FileSizeLimit() {
    setrlimit(RLIMIT_FSIZE, &before_);
    std::signal(SIGXFSZ, handler_);
  }

 private:
  rlimit before_{};
  void (*handler_)(int) = nullptr;
};

TEST_F(IoTest, DiskFull_KeepsTheOldFilesAndRemovesTemporaries) {
  for (const char* name : {"x.ma", "x.vtp", "x.obj"}) std::ofstream(directory_ / name) << "old";
  std::optional<Error> error;
  {
    const FileSizeLimit limit(1000);  // enough for .ma, not for .vtp
    error = write_medial(seam_result(), tetrahedron(), directory_ / "x");
  }
  ASSERT_TRUE(error);
  EXPECT_EQ(error->code, ErrorCode::kOutputNotWritten);
  EXPECT_EQ(error->file, (directory_ / "x.vtp").string());
  EXPECT_EQ(files(), (std::vector<std::string>{"x.ma", "x.obj", "x.vtp"}));
  for (const char* name : {"x.ma", "x.vtp", "x.obj"})
    EXPECT_EQ(test::bytes_of(directory_ / name), "old");
}

TEST_F(IoTest, Text_ReplacesAnOldFileAsAWhole) {
  std::ofstream(directory_ / "s.json") << std::string(500000, 'x');
  const std::string text = std::string(200000, 'y') + "end\n";  // longer than the writer's buffer
  ASSERT_FALSE(write_text(text, directory_ / "s.json"));
  EXPECT_EQ(test::bytes_of(directory_ / "s.json"), text);
  EXPECT_EQ(files(), std::vector<std::string>{"s.json"});
}

TEST_F(IoTest, RelativeName_IsWrittenInTheWorkingDirectory) {
  const fs::path before = fs::current_path();
  fs::current_path(directory_);
  const auto error = write_text("a", "plain");
  fs::current_path(before);
  EXPECT_FALSE(error);
  EXPECT_EQ(files(), std::vector<std::string>{"plain"});
}

}  // namespace
}  // namespace blum
