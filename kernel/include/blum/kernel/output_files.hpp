/// Writes files so that each name holds the old content or the whole new one.
#pragma once

#include <filesystem>
#include <functional>
#include <optional>
#include <span>

#include "blum/kernel/output_stream.hpp"
#include "blum/kernel/result.hpp"

namespace blum::detail {

struct OutputFile {
  std::filesystem::path path;
  std::function<void(OutputStream&)> write;
};

/// First every file completely under a temporary name in its directory, then the renames. On an
/// error (kOutputNotWritten, with the file and the system's reason) the temporaries are removed;
/// only a rename that fails after another has succeeded leaves new files beside old ones.
[[nodiscard]] std::optional<Error> write_files(std::span<const OutputFile> files);

}  // namespace blum::detail
