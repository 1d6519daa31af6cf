#include "embedded_page.hpp"

// The file's bytes as they are; BLUM_PAGE_FILE is its full name (CMakeLists.txt).
asm(".section .rodata\n"
    ".global blum_page_begin\n.global blum_page_end\n"
    "blum_page_begin:\n.incbin \"" BLUM_PAGE_FILE
    "\"\nblum_page_end:\n.byte 0\n"
    ".text\n");

extern "C" const char blum_page_begin[], blum_page_end[];

namespace blum::detail {

std::string_view embedded_page() {
  return {blum_page_begin, static_cast<std::size_t>(blum_page_end - blum_page_begin)};
}

}  // namespace blum::detail
