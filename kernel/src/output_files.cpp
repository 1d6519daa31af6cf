#include "blum/kernel/output_files.hpp"

#include <fcntl.h>
#include <sys/stat.h>
#include <unistd.h>

#include <atomic>
#include <cerrno>
#include <string>
#include <system_error>
#include <utility>
#include <vector>

namespace blum::detail {
namespace {

Error not_written(const std::filesystem::path& file, int error_number) {
  return {ErrorCode::kOutputNotWritten,
          "cannot write '" + file.string() + "': " + std::generic_category().message(error_number),
          file.string(), std::nullopt};
}

/// A file under a temporary name, removed unless it is renamed.
class Temporary {
 public:
  explicit Temporary(std::filesystem::path target) : target_(std::move(target)) {}
  Temporary(const Temporary&) = delete;
  Temporary& operator=(const Temporary&) = delete;
  Temporary(Temporary&& other) noexcept
      : target_(std::move(other.target_)), name_(std::exchange(other.name_, {})) {}
  Temporary& operator=(Temporary&&) = delete;
  ~Temporary() {
    if (!name_.empty()) ::unlink(name_.c_str());
  }

  /// 0 or the system's error number.
  [[nodiscard]] int write(const std::function<void(OutputStream&)>& content);
  [[nodiscard]] int rename() {
    if (::rename(name_.c_str(), target_.c_str()) != 0) return errno;
    name_.clear();
    return 0;
  }
  [[nodiscard]] const std::filesystem::path& target() const { return target_; }

 private:
  [[nodiscard]] int open();
  std::filesystem::path target_, name_;
};

int Temporary::open() {
  static std::atomic<unsigned> serial{0};  // two threads of one process may write the same target
  for (;;) {
    std::string hidden = target_.filename().string();
    hidden.insert(hidden.begin(), '.');
    hidden += '.' + std::to_string(::getpid()) + '.' + std::to_string(serial++) + ".tmp";
    std::filesystem::path name = target_;
    name.replace_filename(hidden);
    const int descriptor = ::open(name.c_str(), O_WRONLY | O_CREAT | O_EXCL | O_CLOEXEC, 0666);
    if (descriptor >= 0) name_ = std::move(name);
    if (descriptor >= 0 || errno != EEXIST) return descriptor;
  }
}

int Temporary::write(const std::function<void(OutputStream&)>& content) {
  // A rename over a directory fails too, but only after other files may have got their names.
  struct stat status {};
  if (target_.filename().empty()) return EISDIR;
  if (::stat(target_.c_str(), &status) == 0 && S_ISDIR(status.st_mode)) return EISDIR;

  const int descriptor = open();
  if (descriptor < 0) return errno;
  OutputStream out(descriptor);
  try {
    content(out);
  } catch (...) {
    ::close(descriptor);
    throw;
  }
  int error = out.finish() ? 0 : out.error_number();
  if (::close(descriptor) != 0 && error == 0) error = errno;
  return error;
}

}  // namespace

std::optional<Error> write_files(std::span<const OutputFile> files) {
  std::vector<Temporary> temporaries;
  temporaries.reserve(files.size());
  for (const OutputFile& file : files) {
    Temporary& temporary = temporaries.emplace_back(file.path);
    if (const int error = temporary.write(file.write)) return not_written(file.path, error);
  }
  for (Temporary& temporary : temporaries) {
    if (const int error = temporary.rename()) return not_written(temporary.target(), error);
  }
  return std::nullopt;
}

}  // namespace blum::detail
