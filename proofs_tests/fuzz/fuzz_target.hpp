/// What the fuzz targets share. A target is a function of bytes that ends the process (abort) where
/// something is wrong; libFuzzer calls it, or replay.cpp for the files of its corpus.
#pragma once

#include <cstddef>
#include <cstdint>
#include <cstdio>
#include <cstdlib>
#include <string>

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size);

namespace blum::fuzz {

[[noreturn]] inline void fail(const std::string& what) {
  std::fprintf(stderr, "fuzz: %s\n", what.c_str());
  std::abort();
}

/// Small decisions, a byte each; zeros after the end.
class Choices {
 public:
  Choices(const std::uint8_t* data, std::size_t size) : data_(data), size_(size) {}
  /// 0 <= result < n; requires 1 <= n <= 256.
  int below(int n) { return next() % n; }
  /// low, low + 1, ..., high
  int between(int low, int high) { return low + below(high - low + 1); }
  bool coin() { return below(2) == 1; }

 private:
  int next() { return at_ < size_ ? data_[at_++] : 0; }
  const std::uint8_t* data_;
  std::size_t size_;
  std::size_t at_ = 0;
};

}  // namespace blum::fuzz
