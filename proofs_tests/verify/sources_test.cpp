// verify/ shares numbers and the geometry of boxes with the rest of the program, and nothing else.
#include <gtest/gtest.h>

#include <filesystem>
#include <fstream>
#include <set>
#include <string>

namespace blum::test {
namespace {

namespace fs = std::filesystem;

bool is_standard(const std::string& header) {
  return header.find_first_of("/.") == std::string::npos;
}

TEST(VerifySources, Includes_OnlyWhatIsShared) {
  const std::set<std::string> shared = {"blum/kernel/ball.hpp",
                                        "blum/kernel/point.hpp",
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
    std::ifstream in(file.path());
    for (std::string line; std::getline(in, line);) {
      if (line.find("#") == std::string::npos || line.find("include") == std::string::npos ||
          line.find_first_not_of(" \t") != line.find('#'))
        continue;
      const auto begin = line.find_first_of("<\""), end = line.find_last_of(">\"");
      ASSERT_LT(begin, end) << file.path() << ": " << line;
      const std::string header = line.substr(begin + 1, end - begin - 1);
      EXPECT_TRUE(is_standard(header) || shared.contains(header) || own.contains(header) ||
                  header.starts_with("phat/"))
          << file.path() << " includes " << header;
    }
  }
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
