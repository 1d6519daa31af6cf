// verify/ shares numbers, the geometry of boxes and the exact algebra with the rest of the program,
// and nothing else.
#include <gtest/gtest.h>

#include <filesystem>
#include <fstream>
#include <set>
#include <string>
#include <vector>

namespace blum::test {
namespace {

namespace fs = std::filesystem;

bool is_standard(const std::string& header) {
  return header.find_first_of("/.") == std::string::npos;
}

/// The headers that the file includes.
std::vector<std::string> included_by(const fs::path& file) {
  std::vector<std::string> headers;
  std::ifstream in(file);
  EXPECT_TRUE(in) << file;
  for (std::string line; std::getline(in, line);) {
    if (line.find("#") == std::string::npos || line.find("include") == std::string::npos ||
        line.find_first_not_of(" \t") != line.find('#'))
      continue;
    const auto begin = line.find_first_of("<\""), end = line.find_last_of(">\"");
    EXPECT_LT(begin, end) << file << ": " << line;
    headers.push_back(line.substr(begin + 1, end - begin - 1));
  }
  return headers;
}

TEST(VerifySources, Includes_OnlyWhatIsShared) {
  const std::set<std::string> shared = {"blum/arrangement/brute_engine.hpp",
                                        "blum/kernel/ball.hpp",
                                        "blum/kernel/point.hpp",
                                        "blum/kernel/solid.hpp",
                                        "blum/kernel/union_find.hpp",
                                        "blum/verify/verify.hpp",
                                        "gmpxx.h",
                                        "nlohmann/json.hpp"};
  const fs::path root = fs::path(BLUM_SOURCE_DIR) / "verify";
  std::set<std::string> own;
  for (const auto& file : fs::recursive_directory_iterator(root))
    if (file.is_regular_file()) own.insert(file.path().filename().string());
  ASSERT_GT(own.size(), 10u);
  for (const auto& file : fs::recursive_directory_iterator(root)) {
    if (!file.is_regular_file()) continue;
    for (const std::string& header : included_by(file.path()))
      EXPECT_TRUE(is_standard(header) || shared.contains(header) || own.contains(header) ||
                  header.starts_with("phat/"))
          << file.path() << " includes " << header;
  }
}

/// Of arrangement/ it uses two functions, in one file.
TEST(VerifySources, ExactAlgebra_TwoCalls) {
  std::size_t calls = 0;
  for (const auto& file :
       fs::recursive_directory_iterator(fs::path(BLUM_SOURCE_DIR) / "verify/src")) {
    std::ifstream in(file.path());
    for (std::string line; std::getline(in, line);) {
      for (const char* name : {"build_solid", "ProductionEngine", "Predicates"})
        EXPECT_EQ(line.find(name), std::string::npos) << file.path() << ": " << line;
      for (const char* name : {"brute_face(", "brute_segment("})
        calls += line.find(name) != std::string::npos;
    }
    for (const std::string& header : included_by(file.path()))
      EXPECT_TRUE(!header.starts_with("blum/arrangement/") || file.path().filename() == "exact.cpp")
          << file.path() << " includes " << header;
  }
  EXPECT_EQ(calls, 2u);
}

/// And these are of sources that use nothing of what makes certificates.
TEST(VerifySources, ExactAlgebra_IncludesNothingOfTheEngine) {
  const fs::path root = fs::path(BLUM_SOURCE_DIR) / "arrangement";
  const std::set<std::string> types = {
      "blum/arrangement/brute_engine.hpp",
      "blum/arrangement/face_diagram.hpp",
      "blum/arrangement/face_problem.hpp",
      "blum/kernel/ball.hpp",
      "blum/kernel/check.hpp",
      "blum/kernel/point.hpp",
      "blum/kernel/site.hpp",
      "blum/kernel/site_geometry.hpp",
      "blum/kernel/solid.hpp",
  };
  const std::set<std::string> libraries = {"gmpxx.h",         "acb.h",       "arb.h",
                                           "arb_fmpz_poly.h", "fmpz_poly.h", "fmpz_poly_factor.h"};
  std::size_t sources = 0;
  const auto check = [&](const fs::path& file) {
    ++sources;
    for (const std::string& header : included_by(file))
      EXPECT_TRUE(is_standard(header) || types.contains(header) || libraries.contains(header) ||
                  (header.starts_with("brute_") && fs::exists(root / "src" / header)))
          << file << " includes " << header;
  };
  for (const auto& file : fs::directory_iterator(root / "src"))
    if (file.path().filename().string().starts_with("brute_")) check(file.path());
  for (const char* name : {"brute_engine.hpp", "face_diagram.hpp", "face_problem.hpp"})
    check(root / "include/blum/arrangement" / name);
  EXPECT_GT(sources, 15u);
}

/// What is shared must itself include nothing that decides.
TEST(VerifySources, SharedHeaders_IncludeOnlyEachOther) {
  for (const char* name : {"ball.hpp", "point.hpp", "union_find.hpp"}) {
    std::ifstream in(fs::path(BLUM_SOURCE_DIR) / "kernel/include/blum/kernel" / name);
    ASSERT_TRUE(in);
    for (std::string line; std::getline(in, line);) {
      if (!line.starts_with("#include")) continue;
      EXPECT_TRUE(line.find('<') != std::string::npos ||
                  line.find("blum/kernel/point.hpp") != std::string::npos)
          << name << ": " << line;
    }
  }
}

}  // namespace
}  // namespace blum::test
