#include "blum/kernel/output_stream.hpp"

#include <unistd.h>

#include <cerrno>

namespace blum::detail {

void OutputStream::flush() {
  write_all(buffer_);
  buffer_.clear();
}

void OutputStream::write_all(std::string_view bytes) {
  while (!bytes.empty() && error_ == 0) {
    const ssize_t taken = ::write(descriptor_, bytes.data(), bytes.size());
    if (taken > 0) {
      bytes.remove_prefix(static_cast<std::size_t>(taken));
    } else if (taken == 0) {
      error_ = EIO;
    } else if (errno != EINTR) {
      error_ = errno;
    }
  }
}

namespace {
constexpr std::string_view kDigits =
    "ABCDEFGHIJKLMNOPQRSTUVWXYZabcdefghijklmnopqrstuvwxyz0123456789+/";
}

void Base64::write_group() {
  const std::array<char, 4> text = {kDigits[group_ >> 18 & 63], kDigits[group_ >> 12 & 63],
                                    kDigits[group_ >> 6 & 63], kDigits[group_ & 63]};
  out_ << std::string_view(text.data(), text.size());
  group_ = 0;
  bytes_ = 0;
}

void Base64::end() {
  if (bytes_ == 0) return;
  const int missing = 3 - bytes_;
  group_ <<= 8 * missing;
  std::array<char, 4> text = {kDigits[group_ >> 18 & 63], kDigits[group_ >> 12 & 63], '=', '='};
  if (missing == 1) text[2] = kDigits[group_ >> 6 & 63];
  out_ << std::string_view(text.data(), text.size());
  group_ = 0;
  bytes_ = 0;
}

}  // namespace blum::detail
