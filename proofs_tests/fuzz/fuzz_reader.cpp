// One mesh reader, BLUM_READER of read_text.hpp, on any bytes.
#include "fuzz_target.hpp"
#include "mesh_checks.hpp"
#include "read_text.hpp"

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
  const std::string_view bytes(reinterpret_cast<const char*>(data), size);
  blum::fuzz::check_read(blum::read::BLUM_READER(bytes));
  return 0;
}
