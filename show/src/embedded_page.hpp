/// show/page/page.html, which is part of the library (show/page/README.md).
#pragma once

#include <string_view>

namespace blum::detail {

[[nodiscard]] std::string_view embedded_page();

}  // namespace blum::detail
