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

}  // namespace blum::test
