/// Result<T>: a value or an Error. Used for everything that bad input can cause; broken
/// invariants trip BLUM_CHECK (check.hpp) instead.
#pragma once

#include <cstddef>
#include <optional>
#include <string>
#include <utility>
#include <variant>

namespace blum {

/// Stable codes: the text form (error_code_name) is part of the public interface.
enum class ErrorCode {
  kFileNotFound,
  kNotARegularFile,
  kFileUnreadable,
  kEmptyFile,
  kUnknownFormat,
  kMalformedFile,
  kTruncatedFile,
  kNonFiniteCoordinate,
  kCoordinateOutOfRange,
  kIndexOutOfRange,
  kNoFaces,
  kInvalidSolid,
  kBadArgument,
  kOutputNotWritten,
  kInterrupted,
};

[[nodiscard]] const char* error_code_name(ErrorCode code);

struct Error {
  ErrorCode code = ErrorCode::kBadArgument;
  std::string message;
  std::string file;                    ///< empty where no file is concerned
  std::optional<std::size_t> element;  ///< line, face or vertex index the message speaks of
};

template <class T>
class [[nodiscard]] Result {
 public:
  Result(T value) : state_(std::in_place_index<0>, std::move(value)) {}
  Result(Error error) : state_(std::in_place_index<1>, std::move(error)) {}
  [[nodiscard]] bool ok() const { return state_.index() == 0; }
  explicit operator bool() const { return ok(); }
  [[nodiscard]] const T& value() const& { return std::get<0>(state_); }
  [[nodiscard]] T& value() & { return std::get<0>(state_); }
  [[nodiscard]] T&& value() && { return std::get<0>(std::move(state_)); }
  [[nodiscard]] const Error& error() const { return std::get<1>(state_); }

 private:
  std::variant<T, Error> state_;
};

}  // namespace blum
