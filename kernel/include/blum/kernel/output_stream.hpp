/// A buffered writer to a file descriptor: text, numbers in round-trip decimals, and base64.
#pragma once

#include <array>
#include <bit>
#include <charconv>
#include <concepts>
#include <cstdint>
#include <span>
#include <string>
#include <string_view>

namespace blum::detail {

template <class T>
concept Number = std::integral<T> || std::floating_point<T>;

/// After the first failed write everything else is dropped; finish() tells.
class OutputStream {
 public:
  explicit OutputStream(int descriptor) : descriptor_(descriptor) { buffer_.reserve(kCapacity); }

  OutputStream& operator<<(std::string_view text) {
    if (buffer_.size() + text.size() > kCapacity) flush();
    if (text.size() > kCapacity) {
      write_all(text);
    } else {
      buffer_.append(text);
    }
    return *this;
  }
  OutputStream& operator<<(char c) { return *this << std::string_view(&c, 1); }

  /// Shortest decimals that read back as the same value; the locale plays no part.
  template <Number T>
  OutputStream& operator<<(T value) {
    std::array<char, 64> digits;
    const auto end = std::to_chars(digits.data(), digits.data() + digits.size(), value).ptr;
    return *this << std::string_view(digits.data(), static_cast<std::size_t>(end - digits.data()));
  }

  /// Flushes. True if every byte was taken; otherwise error_number() says why.
  [[nodiscard]] bool finish() {
    flush();
    return error_ == 0;
  }
  [[nodiscard]] int error_number() const { return error_; }

 private:
  static constexpr std::size_t kCapacity = 1 << 16;
  void flush();
  void write_all(std::string_view bytes);

  int descriptor_;
  int error_ = 0;
  std::string buffer_;
};

/// Encodes a run of bytes as base64, value by value; end() pads.
class Base64 {
 public:
  explicit Base64(OutputStream& out) : out_(out) {}
  template <Number T>
  void put(T value) {
    for (const std::uint8_t byte : std::bit_cast<std::array<std::uint8_t, sizeof(T)>>(value)) {
      group_ = group_ << 8 | byte;
      if (++bytes_ == 3) write_group();
    }
  }
  void end();

 private:
  void write_group();
  OutputStream& out_;
  std::uint32_t group_ = 0;
  int bytes_ = 0;
};

}  // namespace blum::detail
