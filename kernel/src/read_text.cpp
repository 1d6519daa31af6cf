#include "read_text.hpp"

#include <algorithm>
#include <charconv>
#include <cmath>
#include <limits>
#include <utility>

namespace blum::read {
namespace {

bool is_blank(char c) { return c == ' ' || c == '\t' || c == '\r' || c == '\v' || c == '\f'; }

char lower(char c) { return c >= 'A' && c <= 'Z' ? static_cast<char>(c - 'A' + 'a') : c; }

/// Of a decimal number outside the range of double: is it too large (rather than too small)?
bool is_huge(std::string_view digits) {
  long long exponent = 0;
  const std::size_t e = digits.find_first_of("eE");
  if (e != std::string_view::npos) {
    std::string_view power = digits.substr(e + 1);
    if (!power.empty() && power[0] == '+') power.remove_prefix(1);
    const auto [end, error] = std::from_chars(power.data(), power.data() + power.size(), exponent);
    if (error == std::errc::result_out_of_range) return power[0] != '-';
    digits = digits.substr(0, e);
  }
  const std::size_t first = digits.find_first_of("123456789");
  const std::size_t point = std::min(digits.find('.'), digits.size());
  if (first == std::string_view::npos) return false;
  return static_cast<long long>(point) - static_cast<long long>(first) + exponent > 0;
}

}  // namespace

Error no_faces() { return make_error(ErrorCode::kNoFaces, "the file has no faces"); }

Error make_error(ErrorCode code, std::string message, std::optional<std::size_t> element) {
  return {code, std::move(message), "", element};
}

std::string at(const char* element, std::size_t index, std::size_t line, const std::string& what) {
  std::string out = std::string(element) + " " + std::to_string(index);
  if (line > 0) out += " (line " + std::to_string(line) + ")";
  return out + ": " + what;
}

std::string shown(std::string_view token) {
  std::string out = "'";
  for (const char c : token.substr(0, 32)) out += c >= ' ' && c <= '~' ? c : '?';
  return out + (token.size() > 32 ? "...'" : "'");
}

void Tokens::skip_space(bool over_lines) {
  while (at_ < text_.size()) {
    const char c = text_[at_];
    if (c == '\n') {
      if (!over_lines) return;
      ++line_;
      ++at_;
    } else if (is_blank(c)) {
      ++at_;
    } else if (comment_ != '\0' && c == comment_) {
      while (at_ < text_.size() && text_[at_] != '\n') ++at_;
    } else if (join_lines_ && c == '\\') {
      std::size_t end = at_ + 1;
      while (end < text_.size() && is_blank(text_[end])) ++end;
      if (end < text_.size() && text_[end] != '\n') return;
      at_ = std::min(end + 1, text_.size());
      ++line_;
    } else {
      return;
    }
  }
}

std::string_view Tokens::take() {
  const std::size_t begin = at_;
  while (at_ < text_.size() && text_[at_] != '\n' && !is_blank(text_[at_]) &&
         !(comment_ != '\0' && text_[at_] == comment_)) {
    ++at_;
  }
  return text_.substr(begin, at_ - begin);
}

std::string_view Tokens::next() {
  skip_space(true);
  return take();
}

std::string_view Tokens::next_on_line() {
  skip_space(false);
  return take();
}

void Tokens::skip_line() {
  while (at_ < text_.size() && text_[at_] != '\n') ++at_;
  if (at_ < text_.size()) {
    ++at_;
    ++line_;
  }
}

std::optional<double> parse_double(std::string_view token) {
  if (!token.empty() && token[0] == '+') {
    token.remove_prefix(1);
    if (!token.empty() && (token[0] == '-' || token[0] == '+')) return std::nullopt;
  }
  double x = 0;
  const char* end = token.data() + token.size();
  const auto [stop, error] = std::from_chars(token.data(), end, x);
  if (stop != end || token.empty()) return std::nullopt;
  if (error == std::errc::result_out_of_range) {
    const double sign = token[0] == '-' ? -1 : 1;
    return is_huge(token) ? sign * std::numeric_limits<double>::infinity() : 0.0;
  }
  if (error != std::errc()) return std::nullopt;
  return x;
}

std::optional<long long> parse_integer(std::string_view token) {
  if (!token.empty() && token[0] == '+') {
    token.remove_prefix(1);
    if (!token.empty() && token[0] == '-') return std::nullopt;
  }
  long long n = 0;
  const char* end = token.data() + token.size();
  const auto [stop, error] = std::from_chars(token.data(), end, n);
  if (token.empty() || stop != end) return std::nullopt;
  if (error == std::errc::result_out_of_range) {
    return token[0] == '-' ? std::numeric_limits<long long>::min()
                           : std::numeric_limits<long long>::max();
  }
  if (error != std::errc()) return std::nullopt;
  return n;
}

std::optional<Error> parse_point(Tokens& tokens, bool line_bound, std::size_t vertex, Point3& p) {
  for (int axis = 0; axis < 3; ++axis) {
    const std::string_view token = line_bound ? tokens.next_on_line() : tokens.next();
    if (token.empty()) {
      const bool ended = tokens.bytes_left() == 0;
      return make_error(
          ended ? ErrorCode::kTruncatedFile : ErrorCode::kMalformedFile,
          at("vertex", vertex, tokens.line(),
             ended ? "the file ends before its three coordinates" : "fewer than three coordinates"),
          vertex);
    }
    const std::optional<double> x = parse_double(token);
    if (!x) {
      // A number cut off by the end of the file: "1e", say.
      return make_error(
          tokens.bytes_left() == 0 ? ErrorCode::kTruncatedFile : ErrorCode::kMalformedFile,
          at("vertex", vertex, tokens.line(), shown(token) + " is not a coordinate"), vertex);
    }
    p[axis] = *x;
  }
  return check_point(p, vertex, tokens.line());
}

std::optional<Error> check_point(const Point3& p, std::size_t vertex, std::size_t line) {
  for (int axis = 0; axis < 3; ++axis) {
    if (!std::isfinite(p[axis])) {
      return make_error(ErrorCode::kNonFiniteCoordinate,
                        at("vertex", vertex, line, "a coordinate is not a finite number"), vertex);
    }
    if (std::abs(p[axis]) > 0x1p200) {
      return make_error(ErrorCode::kCoordinateOutOfRange,
                        at("vertex", vertex, line, "a coordinate is larger than 2^200"), vertex);
    }
  }
  return std::nullopt;
}

bool same_word(std::string_view a, std::string_view b) {
  return std::equal(a.begin(), a.end(), b.begin(), b.end(),
                    [](char x, char y) { return lower(x) == lower(y); });
}

}  // namespace blum::read
