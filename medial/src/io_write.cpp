// The public writers: formats (io_formats.hpp) put into files (blum/kernel/output_files.hpp).

#include <filesystem>
#include <span>
#include <system_error>
#include <utility>
#include <vector>

#include "blum/kernel/output_files.hpp"
#include "blum/medial/io.hpp"
#include "io_formats.hpp"

namespace blum {
namespace {

using detail::OutputFile;
using detail::OutputStream;

OutputFile ma_file(const MedialResult& result, std::filesystem::path file) {
  return {std::move(file), [&result](OutputStream& out) { detail::put_ma(out, result); }};
}
OutputFile vtp_file(const MedialResult& result, const Solid& solid, std::filesystem::path file) {
  return {std::move(file),
          [&result, &solid](OutputStream& out) { detail::put_vtp(out, result, solid); }};
}
OutputFile obj_file(const MedialResult& result, std::filesystem::path file) {
  return {std::move(file), [&result](OutputStream& out) { detail::put_obj(out, result); }};
}
OutputFile undecided_file(std::span<const UndecidedCell> cells, std::filesystem::path file) {
  return {std::move(file), [cells](OutputStream& out) { detail::put_undecided(out, cells); }};
}
std::optional<Error> write_one(const OutputFile& file) {
  return detail::write_files(std::span(&file, 1));
}

}  // namespace

std::optional<Error> write_medial(const MedialResult& result, const Solid& solid,
                                  const std::filesystem::path& prefix,
                                  std::span<const TextFile> also) {
  const auto name = [&](const char* suffix) {
    std::filesystem::path file = prefix;
    file += suffix;
    return file;
  };
  std::vector files = {ma_file(result, name(".ma")), vtp_file(result, solid, name(".vtp")),
                       obj_file(result, name(".obj"))};
  for (const TextFile& file : also) {
    files.push_back({file.path, [&file](OutputStream& out) { out << file.text; }});
  }
  const std::filesystem::path undecided = name(".undecided.vtp");
  if (!result.certified) files.push_back(undecided_file(result.undecided, undecided));
  if (auto error = detail::write_files(files)) return error;
  std::error_code problem;
  if (result.certified && !std::filesystem::remove(undecided, problem) && problem) {
    return Error{ErrorCode::kOutputNotWritten,
                 "cannot remove '" + undecided.string() + "': " + problem.message(),
                 undecided.string(), std::nullopt};
  }
  return std::nullopt;
}

std::optional<Error> write_ma(const MedialResult& result, const std::filesystem::path& file) {
  return write_one(ma_file(result, file));
}

std::optional<Error> write_vtp(const MedialResult& result, const Solid& solid,
                               const std::filesystem::path& file) {
  return write_one(vtp_file(result, solid, file));
}

std::optional<Error> write_undecided(std::span<const UndecidedCell> cells,
                                     const std::filesystem::path& file) {
  return write_one(undecided_file(cells, file));
}

std::optional<Error> write_obj(const MedialResult& result, const std::filesystem::path& file) {
  return write_one(obj_file(result, file));
}

std::optional<Error> write_text(std::string_view text, const std::filesystem::path& file) {
  return write_one({file, [text](OutputStream& out) { out << text; }});
}

}  // namespace blum
