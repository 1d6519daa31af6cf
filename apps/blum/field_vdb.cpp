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
struct Plugin {
  decltype(&blum_vdb_bytes) bytes_of = nullptr;
  std::string trouble;
};

/// Beside the program; stays loaded until the end.
Plugin load() {
  std::error_code ignored;
  const auto file =
      std::filesystem::read_symlink("/proc/self/exe", ignored).parent_path() / BLUM_VDB_PLUGIN;
  Plugin p;
  if (void* const library = dlopen(file.c_str(), RTLD_NOW | RTLD_LOCAL); library != nullptr)
    p.bytes_of = reinterpret_cast<decltype(p.bytes_of)>(dlsym(library, "blum_vdb_bytes"));
  if (p.bytes_of == nullptr)
    p.trouble = std::string("cannot load the part for OpenVDB: ") + dlerror();
  return p;
}

const Plugin& plugin() {
  static const Plugin p = load();
  return p;
}

std::optional<Error> write_vdb(const FieldImage& image, const std::filesystem::path& file) {
  if (image.order > 1) {
    return Error{ErrorCode::kBadArgument, "a .vdb file holds one value a sample", file.string(),
                 std::nullopt};
  }
  if (plugin().bytes_of == nullptr) {
    return Error{ErrorCode::kOutputNotWritten, plugin().trouble, file.string(), std::nullopt};
  }
  std::string bytes;
  plugin().bytes_of(image, bytes);
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

std::string why_no_vdb() {
#ifdef BLUM_HAS_OPENVDB
  return plugin().trouble;
#else
  return "this program was built without OpenVDB";
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
