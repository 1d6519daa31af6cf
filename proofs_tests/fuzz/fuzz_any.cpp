// The choice of the reader: a byte that chooses the file's extension, then the file.
#include <algorithm>

#include "fuzz_target.hpp"
#include "mesh_checks.hpp"
#include "read_text.hpp"

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
  constexpr const char* kExtensions[] = {"", ".off", ".OBJ", ".stl", ".ply", ".txt"};
  blum::fuzz::Choices choices(data, size);
  const char* extension = kExtensions[choices.below(6)];
  std::string_view bytes(reinterpret_cast<const char*>(data), size);
  bytes.remove_prefix(std::min<std::size_t>(1, size));
  blum::fuzz::check_read(blum::read::any(bytes, extension));
  return 0;
}
