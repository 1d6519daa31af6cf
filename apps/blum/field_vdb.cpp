#include "field_vdb.hpp"

#ifdef BLUM_HAS_OPENVDB
#include <dlfcn.h>

#include "../vdb/vdb_bytes.hpp"
#include "blum/kernel/output_files.hpp"
#include "blum/kernel/output_stream.hpp"
#endif

namespace blum::app {
namespace {

#ifdef BLUM_HAS_OPENVDB
std::optional<Error> write_vdb(const FieldImage& image, const std::filesystem::path& file) {
  if (image.order > 1) {
    return Error{ErrorCode::kBadArgument, "a .vdb file holds one value a sample", file.string(),
                 std::nullopt};
  }
  std::error_code ignored;
  const auto plugin = std::filesystem::read_symlink("/proc/self/exe", ignored).parent_path() /
                      BLUM_VDB_PLUGIN;
  void* const library = dlopen(plugin.c_str(), RTLD_NOW | RTLD_LOCAL);  // stays until the end
  const auto bytes_of = library == nullptr ? nullptr
                                           : reinterpret_cast<decltype(&blum_vdb_bytes)>(
                                                 dlsym(library, "blum_vdb_bytes"));
  if (bytes_of == nullptr) {
    return Error{ErrorCode::kOutputNotWritten,
                 std::string("the plug-in for .vdb files cannot be loaded: ") + dlerror(),
                 file.string(), std::nullopt};
  }
  std::string bytes;
  bytes_of(image, bytes);
  const std::vector<detail::OutputFile> files = {
      {file, [&](detail::OutputStream& out) { out << std::string_view(bytes); }}};
  return detail::write_files(files);
}
#endif

}  // namespace

bool has_vdb() {
#ifdef BLUM_HAS_OPENVDB
  return true;
#else
  return false;
#endif
}

bool is_vdb(const std::filesystem::path& file) { return file.extension() == ".vdb"; }

std::vector<std::filesystem::path> output_files(const std::filesystem::path& file) {
  if (is_vdb(file)) return {file};
  return field_files(file);
}

std::optional<Error> write_field_file(const FieldImage& image, const std::filesystem::path& file) {
#ifdef BLUM_HAS_OPENVDB
  if (is_vdb(file)) return write_vdb(image, file);
#endif
  return write_field(image, file);
}

}  // namespace blum::app
