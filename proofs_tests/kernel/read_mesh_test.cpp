// Readers: good files of every kind, and everything that can be wrong with a file.
#include <bit>
#include <cstring>
#include <limits>

#include "blum/kernel/mesh_or_points.hpp"
#include "mesh_test_tools.hpp"

namespace blum {
namespace {

using test::Folder;

constexpr std::string_view kTetrahedronOff =
    "OFF\n4 4 6\n0 0 0\n1 0 0\n0 1 0\n0 0 1\n3 0 2 1\n3 0 1 3\n3 0 3 2\n3 1 2 3\n";

Result<PolygonMesh> read(std::string_view bytes, const std::string& name = "mesh.off") {
  const Folder folder;
  return read_mesh(folder.write(name, bytes));
}

void expect_tetrahedron(const Result<PolygonMesh>& mesh) {
  ASSERT_TRUE(mesh.ok()) << mesh.error().message;
  EXPECT_EQ(mesh.value().points.size(), 4u);
  EXPECT_EQ(mesh.value().faces.size(), 4u);
  EXPECT_TRUE(build_solid(mesh.value()).ok());
}

void expect_error(const Result<PolygonMesh>& mesh, ErrorCode code,
                  std::optional<std::size_t> element = std::nullopt) {
  ASSERT_FALSE(mesh.ok());
  EXPECT_STREQ(error_code_name(mesh.error().code), error_code_name(code)) << mesh.error().message;
  EXPECT_FALSE(mesh.error().message.empty());
  EXPECT_FALSE(mesh.error().file.empty());
  if (element) {
    ASSERT_TRUE(mesh.error().element.has_value()) << mesh.error().message;
    EXPECT_EQ(*mesh.error().element, *element) << mesh.error().message;
  }
}

std::string replaced(std::string_view text, std::string_view what, std::string_view by) {
  std::string out(text);
  const std::size_t at = out.find(what);
  EXPECT_NE(at, std::string::npos) << what;
  return out.replace(at, what.size(), by);
}

template <class T>
void put(std::string& out, T x, bool big = false) {
  char b[sizeof(T)];
  std::memcpy(b, &x, sizeof x);
  if (big) std::reverse(b, b + sizeof b);
  out.append(b, sizeof b);
}

std::string binary_stl(const PolygonMesh& m, const std::string& title = "binary") {
  std::string out = title;
  out.resize(80, '\0');
  put(out, static_cast<std::uint32_t>(m.faces.size()));
  for (const auto& f : m.faces) {
    for (int k = 0; k < 3; ++k) put(out, 0.0f);
    for (const auto v : f) {
      for (int axis = 0; axis < 3; ++axis) put(out, static_cast<float>(m.points[v][axis]));
    }
    put(out, std::uint16_t{0});
  }
  return out;
}

std::string ascii_stl(const PolygonMesh& m) {
  std::ostringstream out;
  out << "solid a name with words\n";
  for (const auto& f : m.faces) {
    out << " facet normal 0 0 0\n  outer loop\n";
    for (const auto v : f) {
      out << "   vertex " << m.points[v].x << " " << m.points[v].y << " " << m.points[v].z << "\n";
    }
    out << "  endloop\n endfacet\n";
  }
  out << "endsolid a name with words\n";
  return out.str();
}

std::string binary_ply(const PolygonMesh& m, bool big, bool doubles = true) {
  std::string out = "ply\nformat ";
  out += big ? "binary_big_endian" : "binary_little_endian";
  out += " 1.0\ncomment made by a test\nelement vertex " + std::to_string(m.points.size()) + "\n";
  for (const char* axis : {"x", "y", "z"}) {
    out += std::string("property ") + (doubles ? "double " : "float ") + axis + "\n";
  }
  out += "property uchar red\nelement face " + std::to_string(m.faces.size()) +
         "\nproperty list uchar int vertex_indices\nproperty short quality\nend_header\n";
  for (const Point3& p : m.points) {
    for (int axis = 0; axis < 3; ++axis) {
      if (doubles)
        put(out, p[axis], big);
      else
        put(out, static_cast<float>(p[axis]), big);
    }
    put(out, std::uint8_t{200});
  }
  for (const auto& f : m.faces) {
    put(out, static_cast<std::uint8_t>(f.size()));
    for (const auto v : f) put(out, static_cast<std::int32_t>(v), big);
    put(out, std::int16_t{-3}, big);
  }
  return out;
}

TEST(ReadOff, PlainFile_IsReadExactly) {
  const auto mesh = read(kTetrahedronOff);
  expect_tetrahedron(mesh);
  EXPECT_EQ(mesh.value().points[3], (Point3{0, 0, 1}));
  EXPECT_EQ(mesh.value().faces[0], (std::vector<std::uint32_t>{0, 2, 1}));
}

TEST(ReadOff, CommentsBlankLinesAndDosEnds_AreSkipped) {
  expect_tetrahedron(
      read("# made by hand\nOFF # a comment\r\n\r\n4 4\r\n0 0 0 # origin\r\n"
           "1 0 0\r\n\n0 1 0\n0 0 1\n3 0 2 1\n3 0 1 3\n# faces\n3 0 3 2\n3 1 2 3"));
}

TEST(ReadOff, CountsOnTheKeywordLineAndFaceColours_AreAccepted) {
  expect_tetrahedron(
      read("OFF 4 4 6\n0 0 0\n1 0 0\n0 1 0\n0 0 1\n3 0 2 1 255 0 0\n"
           "3 0 1 3 0.5 0.5 0.5 1\n3 0 3 2\n3 1 2 3 7\n"));
}

TEST(ReadOff, ColoursAndNormalsAtVertices_AreIgnored) {
  expect_tetrahedron(
      read("COFF\n4 4 6\n0 0 0 255 0 0 255\n1 0 0 1 1 1 1\n0 1 0 0 0 0 0\n"
           "0 0 1 9 9 9 9\n3 0 2 1\n3 0 1 3\n3 0 3 2\n3 1 2 3\n"));
  expect_tetrahedron(
      read("NOFF\n4 4 6\n0 0 0 1 0 0\n1 0 0 1 0 0\n0 1 0 1 0 0\n0 0 1 1 0 0\n"
           "3 0 2 1\n3 0 1 3\n3 0 3 2\n3 1 2 3\n"));
  expect_error(read("OFF\n4 4 6\n0 0 0 1 0 0\n1 0 0 1 0 0\n0 1 0 1 0 0\n0 0 1 1 0 0\n"
                    "3 0 2 1\n3 0 1 3\n3 0 3 2\n3 1 2 3\n"),
               ErrorCode::kMalformedFile, 0);
}

TEST(ReadOff, Decimals_AreRoundedCorrectly) {
  const auto mesh = read(replaced(kTetrahedronOff, "1 0 0\n",
                                  "0.1000000000000000055511151231257827 +1.5e+002 -4.9e-324\n"));
  ASSERT_TRUE(mesh.ok()) << mesh.error().message;
  EXPECT_EQ(mesh.value().points[1], (Point3{0.1, 150, -5e-324}));
  const auto halfway = read(replaced(kTetrahedronOff, "1 0 0\n",
                                     "9007199254740993 9007199254740993.0000000001 1e-9999\n"));
  ASSERT_TRUE(halfway.ok()) << halfway.error().message;
  EXPECT_EQ(halfway.value().points[1], (Point3{9007199254740992.0, 9007199254740994.0, 0}));
}

TEST(ReadOff, BadCoordinates_NameTheVertex) {
  for (const char* word : {"nan", "-nan", "inf", "-inf", "1e999"}) {
    expect_error(read(replaced(kTetrahedronOff, "0 1 0", std::string("0 ") + word + " 0")),
                 ErrorCode::kNonFiniteCoordinate, 2);
  }
  expect_error(read(replaced(kTetrahedronOff, "0 1 0", "0 1e308 0")),
               ErrorCode::kCoordinateOutOfRange, 2);
  expect_error(read(replaced(kTetrahedronOff, "0 1 0", "0 1.0000000001 0x1")),
               ErrorCode::kMalformedFile, 2);
  expect_error(read(replaced(kTetrahedronOff, "0 1 0", "0 1,5 0")), ErrorCode::kMalformedFile, 2);
}

TEST(ReadOff, RangeEndsAtTwoToThe200) {
  const double limit = 0x1p200;
  std::ostringstream digits;
  digits.precision(17);
  digits << "0 " << limit << " 0";
  EXPECT_TRUE(read(replaced(kTetrahedronOff, "0 1 0", digits.str())).ok());
  digits.str("");
  digits << "0 " << std::nextafter(limit, 2 * limit) << " 0";
  expect_error(read(replaced(kTetrahedronOff, "0 1 0", digits.str())),
               ErrorCode::kCoordinateOutOfRange, 2);
}

TEST(ReadOff, BadFaces_NameTheFace) {
  expect_error(read(replaced(kTetrahedronOff, "3 0 3 2", "3 0 4 2")), ErrorCode::kIndexOutOfRange,
               2);
  expect_error(read(replaced(kTetrahedronOff, "3 0 3 2", "3 0 -1 2")), ErrorCode::kIndexOutOfRange,
               2);
  expect_error(read(replaced(kTetrahedronOff, "3 0 3 2", "3 0 99999999999999999999 2")),
               ErrorCode::kIndexOutOfRange, 2);
  expect_error(read(replaced(kTetrahedronOff, "3 0 3 2", "2 0 3")), ErrorCode::kMalformedFile, 2);
  expect_error(read(replaced(kTetrahedronOff, "3 0 3 2", "3 0 1.5 2")), ErrorCode::kMalformedFile,
               2);
  expect_error(read("OFF\n4 0 0\n0 0 0\n1 0 0\n0 1 0\n0 0 1\n"), ErrorCode::kNoFaces);
  expect_error(read("OFF\n0 0 0\n"), ErrorCode::kNoFaces);
}

TEST(ReadOff, AnyTruncation_IsRefused) {
  // The last two cuts leave a complete file: only the line end is missing.
  for (std::size_t n = 0; n + 2 < kTetrahedronOff.size(); ++n) {
    const auto mesh = read(kTetrahedronOff.substr(0, n));
    ASSERT_FALSE(mesh.ok()) << n;
    if (n == 0)
      expect_error(mesh, ErrorCode::kEmptyFile);
    else if (n >= 4)
      expect_error(mesh, ErrorCode::kTruncatedFile);
  }
}

TEST(ReadOff, TrailingData_IsRefused) {
  expect_error(read(std::string(kTetrahedronOff) + "3 0 1 2\n"), ErrorCode::kMalformedFile, 11);
}

TEST(ReadOff, HugeCounts_AreRefusedBeforeAllocation) {
  expect_error(read(replaced(kTetrahedronOff, "4 4 6", "4000000000000000000 4 0")),
               ErrorCode::kTruncatedFile);
  expect_error(read(replaced(kTetrahedronOff, "4 4 6", "4 99999999999999999999999 0")),
               ErrorCode::kTruncatedFile);
  expect_error(read(replaced(kTetrahedronOff, "3 0 3 2", "4000000000 0 3 2")),
               ErrorCode::kTruncatedFile, 2);
  expect_error(read(replaced(kTetrahedronOff, "4 4 6", "-4 4 6")), ErrorCode::kMalformedFile);
}

TEST(ReadOff, UnsupportedVariants_SaySo) {
  expect_error(read("4OFF\n1 1 0\n0 0 0 1\n"), ErrorCode::kMalformedFile);
  expect_error(read("OFF BINARY\n\x01\x02"), ErrorCode::kMalformedFile);
}

TEST(ReadObj, AllIndexForms_AreRead) {
  expect_tetrahedron(
      read("# x\nmtllib a.mtl\no thing\nv 0 0 0\nv 1 0 0\nv 0 1 0 1.0\nv 0 0 1\n"
           "vt 0 0\nvn 0 0 1\ng a\nusemtl b\ns off\nf 1 3 2\nf 1/1 2/1 4/1\n"
           "f 1//1 4//1 3//1\nf -3/1/1 -2/1/1 -1/1/1\n",
           "mesh.obj"));
}

TEST(ReadObj, FacesBeforeVerticesAndJoinedLines_AreRead) {
  expect_tetrahedron(
      read("f 1 3 2\nf 1 2 4\nf 1 4 \\\n 3\nf 2 3 4\nv 0 0 0\nv 1 0 0\nv 0 1 0\n"
           "v 0 0 1",
           "mesh.obj"));
}

TEST(ReadObj, BadFiles_AreRefused) {
  const std::string good = "v 0 0 0\nv 1 0 0\nv 0 1 0\nv 0 0 1\nf 1 3 2\nf 1 2 4\n";
  EXPECT_TRUE(read(good, "mesh.obj").ok());
  expect_error(read(replaced(good, "f 1 2 4", "f 1 2 5"), "m.obj"), ErrorCode::kIndexOutOfRange, 1);
  expect_error(read(replaced(good, "f 1 2 4", "f 0 2 4"), "m.obj"), ErrorCode::kIndexOutOfRange, 1);
  expect_error(read(replaced(good, "f 1 2 4", "f -5 2 4"), "m.obj"), ErrorCode::kIndexOutOfRange,
               1);
  expect_error(read(replaced(good, "f 1 2 4", "f 1 2"), "m.obj"), ErrorCode::kMalformedFile, 1);
  expect_error(read(replaced(good, "f 1 2 4", "f 1 2 x"), "m.obj"), ErrorCode::kMalformedFile, 1);
  expect_error(read(replaced(good, "v 0 1 0", "v 0 1"), "m.obj"), ErrorCode::kMalformedFile, 2);
  expect_error(read(replaced(good, "v 0 1 0", "v 0 nan 0"), "m.obj"),
               ErrorCode::kNonFiniteCoordinate, 2);
  expect_error(read("v 0 0 0\nv 1 0 0\n", "m.obj"), ErrorCode::kNoFaces);
  expect_error(read("v 0 0 0\nv 1 0", "m.obj"), ErrorCode::kTruncatedFile, 1);
}

TEST(ReadStl, AsciiAndBinary_MergeVertices) {
  const PolygonMesh m = test::tetrahedron({-1, 0, 0.5}, 2);
  expect_tetrahedron(read(ascii_stl(m), "mesh.stl"));
  expect_tetrahedron(read(binary_stl(m), "mesh.stl"));
  expect_tetrahedron(read(binary_stl(m, "solid but binary"), "mesh.stl"));
  EXPECT_EQ(read(binary_stl(m), "m.stl").value().points,
            read(ascii_stl(m), "m.stl").value().points);
}

TEST(ReadStl, NegativeZero_IsZero) {
  PolygonMesh m = test::tetrahedron();
  std::string bytes = binary_stl(m);
  const float minus = -0.0f;
  std::memcpy(bytes.data() + 84 + 12, &minus, 4);  // the first vertex of the first triangle only
  expect_tetrahedron(read(bytes, "mesh.stl"));
}

TEST(ReadStl, VerticesOneUlpApart_StayApart) {
  const PolygonMesh m = test::tetrahedron({1, 1, 1});
  std::string bytes = binary_stl(m);
  const float beside = std::nextafter(1.0f, 2.0f);
  std::memcpy(bytes.data() + 84 + 12, &beside, 4);
  const auto mesh = read(bytes, "mesh.stl");
  ASSERT_TRUE(mesh.ok());
  EXPECT_EQ(mesh.value().points.size(), 5u);
}

TEST(ReadStl, BadFiles_AreRefused) {
  const PolygonMesh m = test::tetrahedron();
  const std::string binary = binary_stl(m), ascii = ascii_stl(m);
  expect_error(read(binary.substr(0, 60), "m.stl"), ErrorCode::kTruncatedFile);
  expect_error(read(binary.substr(0, binary.size() - 1), "m.stl"), ErrorCode::kTruncatedFile, 3);
  expect_error(read(binary + "x", "m.stl"), ErrorCode::kMalformedFile);
  std::string huge = binary;
  std::memset(huge.data() + 80, 0xFF, 4);
  expect_error(read(huge, "m.stl"), ErrorCode::kTruncatedFile);
  expect_error(read(ascii.substr(0, ascii.size() / 2), "m.stl"), ErrorCode::kTruncatedFile);
  expect_error(read(ascii.substr(0, ascii.rfind("endsolid")), "m.stl"), ErrorCode::kTruncatedFile);
  expect_error(read("solid x\nendsolid x\n", "m.stl"), ErrorCode::kNoFaces);
  expect_error(read(replaced(ascii, "vertex 1 0 0", "vertex inf 0 0"), "m.stl"),
               ErrorCode::kNonFiniteCoordinate);
  expect_error(read(replaced(ascii, "endloop", "vertex 0 0 0 endloop"), "m.stl"),
               ErrorCode::kMalformedFile);
  std::string nan = binary;
  const float bad = std::numeric_limits<float>::quiet_NaN();
  std::memcpy(nan.data() + 84 + 50 + 12, &bad, 4);
  expect_error(read(nan, "m.stl"), ErrorCode::kNonFiniteCoordinate, 3);
}

TEST(ReadPly, AsciiAndBinary_AreReadExactly) {
  PolygonMesh m = test::tetrahedron({0.1, 1e-300, -0.3}, 0.7);
  for (const bool big : {false, true}) {
    const auto mesh = read(binary_ply(m, big), "mesh.ply");
    expect_tetrahedron(mesh);
    EXPECT_EQ(mesh.value().points, m.points);
    expect_tetrahedron(read(binary_ply(test::tetrahedron(), big, false), "mesh.ply"));
  }
  expect_tetrahedron(
      read("ply\nformat ascii 1.0\nobj_info x\nelement vertex 4\nproperty float nx\n"
           "property float x\nproperty float y\nproperty float z\nelement edge 1\n"
           "property int a\nelement face 4\nproperty uchar red\n"
           "property list uchar uint vertex_index\nend_header\n9 0 0 0\n9 1 0 0\n9 0 1 0\n"
           "9 0 0 1\n77\n1 3 0 2 1\n1 3 0 1 3\n1 3 0 3 2\n1 3 1 2 3\n",
           "mesh.ply"));
}

TEST(ReadPly, BadFiles_AreRefused) {
  const std::string good = binary_ply(test::tetrahedron(), false);
  for (std::size_t n = 4; n < good.size(); ++n) {
    expect_error(read(good.substr(0, n), "m.ply"), ErrorCode::kTruncatedFile);
    if (HasFatalFailure()) return;
  }
  expect_error(read(good + "more", "m.ply"), ErrorCode::kMalformedFile);
  expect_error(read(replaced(good, "vertex 4", "vertex 4000000000000000000"), "m.ply"),
               ErrorCode::kTruncatedFile);
  expect_error(read(replaced(good, "face 4", "face 0"), "m.ply"), ErrorCode::kNoFaces);
  expect_error(read(replaced(good, "double x", "double w"), "m.ply"), ErrorCode::kMalformedFile);
  expect_error(read(replaced(good, "double x", "quad x"), "m.ply"), ErrorCode::kMalformedFile);
  expect_error(read(replaced(good, "little", "middle"), "m.ply"), ErrorCode::kMalformedFile);
  PolygonMesh bad = test::tetrahedron();
  bad.faces[2][1] = 4;
  expect_error(read(binary_ply(bad, true), "m.ply"), ErrorCode::kIndexOutOfRange, 2);
  bad.faces[2][1] = ~0u;
  expect_error(read(binary_ply(bad, true), "m.ply"), ErrorCode::kIndexOutOfRange, 2);
  bad = test::tetrahedron();
  bad.faces[1] = {0, 1};
  expect_error(read(binary_ply(bad, true), "m.ply"), ErrorCode::kMalformedFile, 1);
  bad = test::tetrahedron();
  bad.points[3].y = std::numeric_limits<double>::quiet_NaN();
  expect_error(read(binary_ply(bad, true), "m.ply"), ErrorCode::kNonFiniteCoordinate, 3);
  bad.points[3].y = 1e308;
  expect_error(read(binary_ply(bad, false), "m.ply"), ErrorCode::kCoordinateOutOfRange, 3);
}

TEST(ReadMesh, ContentDecidesBeforeExtension) {
  const PolygonMesh m = test::tetrahedron();
  for (const char* name : {"m.off", "m.obj", "m.stl", "m.ply", "m", "m.xyz"}) {
    expect_tetrahedron(read(kTetrahedronOff, name));
    expect_tetrahedron(read(binary_stl(m), name));
    expect_tetrahedron(read(ascii_stl(m), name));
    expect_tetrahedron(read(binary_ply(m, true), name));
    expect_tetrahedron(
        read("v 0 0 0\nv 1 0 0\nv 0 1 0\nv 0 0 1\nf 1 3 2\nf 1 2 4\nf 1 4 3\nf 2 3 4\n", name));
  }
}

TEST(ReadMesh, MissingDirectoryAndEmpty_AreTold) {
  const Folder folder;
  expect_error(read_mesh(folder.path() / "nothing.off"), ErrorCode::kFileNotFound);
  expect_error(read_mesh(folder.path() / "nothing.off" / "below.off"), ErrorCode::kFileNotFound);
  expect_error(read_mesh(folder.path()), ErrorCode::kNotARegularFile);
  expect_error(read_mesh("/dev/null"), ErrorCode::kNotARegularFile);
  for (const char* extension : {".off", ".obj", ".stl", ".ply", ""}) {
    expect_error(read("", std::string("m") + extension), ErrorCode::kEmptyFile);
  }
}

TEST(ReadMesh, TenRandomBytesUnderAnyExtension_AreRefused) {
  std::mt19937 random(7);
  const Folder folder;
  for (int round = 0; round < 60; ++round) {
    std::string bytes;
    for (int k = 0; k < 10; ++k) bytes += static_cast<char>(random());
    for (const char* extension : {".off", ".obj", ".stl", ".ply", ".txt", ""}) {
      ASSERT_FALSE(read_mesh(folder.write(std::string("m") + extension, bytes)).ok());
    }
  }
}

TEST(ReadMesh, RandomDamage_NeverCrashes) {
  const PolygonMesh m = test::tetrahedron();
  const std::string good[] = {std::string(kTetrahedronOff), ascii_stl(m), binary_stl(m),
                              binary_ply(m, false)};
  std::mt19937 random(11);
  const Folder folder;
  for (int round = 0; round < 600; ++round) {
    std::string bytes = good[round % 4];
    for (int k = 0; k < 3; ++k) bytes[random() % bytes.size()] = static_cast<char>(random());
    const auto mesh = read_mesh(folder.write("m.ply", bytes));
    if (mesh.ok()) (void)validate_mesh(mesh.value());
  }
}

TEST(WriteOff, RoundTrip_IsBitIdentical) {
  const Folder folder;
  std::mt19937_64 random(5);
  PolygonMesh m = test::box_mesh();
  for (int i = 0; i < 200; ++i) {
    const auto x = [&] {
      for (;;) {
        const double d = std::bit_cast<double>(random());
        if (std::abs(d) <= 0x1p200) return d;
      }
    };
    m.points.push_back({x(), x(), -0.0});
  }
  ASSERT_FALSE(write_off(m, folder.path() / "a.off").has_value());
  const auto back = read_mesh(folder.path() / "a.off");
  ASSERT_TRUE(back.ok()) << back.error().message;
  EXPECT_EQ(back.value().faces, m.faces);
  ASSERT_EQ(back.value().points.size(), m.points.size());
  for (std::size_t i = 0; i < m.points.size(); ++i) {
    for (int axis = 0; axis < 3; ++axis) {
      EXPECT_EQ(std::bit_cast<std::uint64_t>(back.value().points[i][axis]),
                std::bit_cast<std::uint64_t>(m.points[i][axis]));
    }
  }
}

TEST(WriteOff, Failure_LeavesTheOldFileAndNoTemporary) {
  const Folder folder;
  const auto error = write_off(test::box_mesh(), folder.path() / "no" / "such" / "folder.off");
  ASSERT_TRUE(error.has_value());
  EXPECT_EQ(error->code, ErrorCode::kOutputNotWritten);
  EXPECT_TRUE(write_off(test::box_mesh(), folder.path()).has_value());
  folder.write("a.off", "old");
  ASSERT_FALSE(write_off(test::box_mesh(), folder.path() / "a.off").has_value());
  EXPECT_NE(test::bytes_of(folder.path() / "a.off"), "old");
  EXPECT_EQ(std::distance(std::filesystem::directory_iterator(folder.path()), {}), 1);
}

TEST(ErrorCode, Names_AreDistinct) {
  std::vector<std::string> names;
  for (int c = 0; c <= static_cast<int>(ErrorCode::kInterrupted); ++c) {
    names.emplace_back(error_code_name(static_cast<ErrorCode>(c)));
  }
  std::sort(names.begin(), names.end());
  EXPECT_EQ(std::adjacent_find(names.begin(), names.end()), names.end());
  EXPECT_EQ(std::count(names.begin(), names.end(), "unknown"), 0);
}

TEST(ReadMeshOrPoints, WithoutFaces_IsACloudOfPoints) {
  const std::vector<Point3> expected = {{0, 0, 0}, {1, 0.5, -2}};
  for (const auto& [text, name] : std::vector<std::pair<std::string, std::string>>{
           {"OFF\n2 0 0\n0 0 0\n1 0.5 -2\n", "m.off"},
           {"v 0 0 0\nv 1 0.5 -2\n", "m.obj"},
           {"v 0 0 0\nv 1 0.5 -2\np 1 2\n", "m.obj"},
           {"ply\nformat ascii 1.0\nelement vertex 2\nproperty double x\nproperty double y\n"
            "property double z\nend_header\n0 0 0\n1 0.5 -2\n",
            "m.ply"}}) {
    SCOPED_TRACE(text);
    const Folder folder;
    const auto file = folder.write(name, text);
    const Result<PolygonMesh> points = read_mesh_or_points(file);
    ASSERT_TRUE(points.ok()) << points.error().message;
    EXPECT_EQ(points.value().points, expected);
    EXPECT_TRUE(points.value().faces.empty());
    expect_error(read_mesh(file), ErrorCode::kNoFaces);
  }
}

// Segments, strips and nothing at all are no clouds; neither is what a count has hidden.
TEST(ReadMeshOrPoints, OtherThingsWithoutFaces_AreRefused) {
  const std::string head =
      "ply\nformat ascii 1.0\nelement vertex 2\nproperty double x\nproperty double y\n"
      "property double z\n";
  for (const auto& [text, name] : std::vector<std::pair<std::string, std::string>>{
           {"OFF\n0 0 0\n", "m.off"},
           {"# nothing\n", "m.obj"},
           {"v 0 0 0\nv 1 0.5 -2\nl 1 2\n", "m.obj"},
           {"solid x\nendsolid x\n", "m.stl"},
           {head + "element tristrips 1\nproperty list int int vertex_indices\nend_header\n"
                   "0 0 0\n1 0.5 -2\n3 0 1 0\n",
            "m.ply"},
           {head + "end_header\n0 0 0\n1 0.5 -2\n3 0 1 0\n", "m.ply"}}) {
    SCOPED_TRACE(text);
    const Folder folder;
    const auto file = folder.write(name, text);
    expect_error(read_mesh_or_points(file), ErrorCode::kNoFaces);
  }
}

}  // namespace
}  // namespace blum
