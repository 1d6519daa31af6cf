#include "output_names.hpp"

#include <unistd.h>

#include <map>
#include <system_error>

namespace blum::app {

namespace fs = std::filesystem;

namespace {

/// The same for two names of one file in a folder, however the folder is called.
fs::path identity(const fs::path& file) {
  std::error_code ignored;
  const fs::path folder = file.has_parent_path() ? file.parent_path() : fs::path(".");
  const fs::path canonical = fs::canonical(folder, ignored);
  return (canonical.empty() ? folder.lexically_normal() : canonical) / file.filename();
}

}  // namespace

std::optional<std::string> conflict(const fs::path& model, const std::vector<fs::path>& files) {
  std::map<fs::path, fs::path> known;
  for (const fs::path& file : files) {
    std::error_code ignored;
    if (fs::equivalent(file, model, ignored)) {
      return "the model would be overwritten; choose another name with -o";
    }
    const auto [other, is_new] = known.emplace(identity(file), file);
    if (!is_new) {
      return "two outputs would go to one file: " + other->second.string() + " and " +
             file.string();
    }
  }
  return std::nullopt;
}

std::optional<Error> output_problem(const std::vector<fs::path>& files) {
  for (const fs::path& file : files) {
    const fs::path folder = file.has_parent_path() ? file.parent_path() : fs::path(".");
    std::error_code ignored;
    const char* problem = nullptr;
    if (!fs::is_directory(folder, ignored)) {
      problem = "its folder does not exist";
    } else if (fs::is_directory(file, ignored)) {
      problem = "it is a directory";
    } else if (fs::is_other(file, ignored)) {
      problem = "it is not a regular file";
    } else if (access(folder.c_str(), W_OK) != 0) {
      problem = "its folder is not writable";
    }
    if (problem != nullptr) {
      return Error{ErrorCode::kOutputNotWritten, problem, file.string(), std::nullopt};
    }
  }
  return std::nullopt;
}

}  // namespace blum::app
