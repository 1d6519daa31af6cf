/// Changes of the collapses in a certificate; each says why it is false, or that it is not.
#pragma once

#include "mutations.hpp"

namespace blum::test {

/// Of certificates with collapses.
[[nodiscard]] const std::vector<Mutation>& false_prunings();
[[nodiscard]] const std::vector<Mutation>& true_prunings();

}  // namespace blum::test
