/// Single changes of a certificate that are false by construction; each says why.
#pragma once

#include <functional>

#include "certificates.hpp"

namespace blum::test {

/// Changes the records; false where there is nothing of the kind to change.
struct Mutation {
  const char* name;
  std::function<bool(const Certified&, std::vector<Json>&, Random&)> apply;
};

[[nodiscard]] const std::vector<Mutation>& false_mutations();
[[nodiscard]] const std::vector<Mutation>& true_mutations();

/// Applies every mutation `times` times to every certificate and looks at what the checker says.
void apply_all(const std::vector<Certified>& certificates, const std::vector<Mutation>& mutations,
               int times, bool meaning_kept);

}  // namespace blum::test
