#include "blum/kernel/result.hpp"

namespace blum {

const char* error_code_name(ErrorCode code) {
  switch (code) {
    case ErrorCode::kFileNotFound:
      return "file_not_found";
    case ErrorCode::kNotARegularFile:
      return "not_a_regular_file";
    case ErrorCode::kFileUnreadable:
      return "file_unreadable";
    case ErrorCode::kEmptyFile:
      return "empty_file";
    case ErrorCode::kUnknownFormat:
      return "unknown_format";
    case ErrorCode::kMalformedFile:
      return "malformed_file";
    case ErrorCode::kTruncatedFile:
      return "truncated_file";
    case ErrorCode::kNonFiniteCoordinate:
      return "non_finite_coordinate";
    case ErrorCode::kCoordinateOutOfRange:
      return "coordinate_out_of_range";
    case ErrorCode::kIndexOutOfRange:
      return "index_out_of_range";
    case ErrorCode::kNoFaces:
      return "no_faces";
    case ErrorCode::kInvalidSolid:
      return "invalid_solid";
    case ErrorCode::kBadArgument:
      return "bad_argument";
    case ErrorCode::kOutputNotWritten:
      return "output_not_written";
    case ErrorCode::kInterrupted:
      return "interrupted";
  }
  return "unknown";
}

}  // namespace blum
