#include <fstream>
#include <string>

#include "blum/medial/summary.hpp"

namespace blum {

// Not getrusage's ru_maxrss, which a new program takes over from the process that became it.
std::uint64_t peak_memory_bytes() {
  std::ifstream status("/proc/self/status");
  for (std::string word; status >> word;) {
    std::uint64_t kib = 0;
    if (word == "VmHWM:" && status >> kib) return kib * 1024;
  }
  return 0;
}

}  // namespace blum
