/// Which stage of a predicate decided. Tests assert that every stage is reached and that the exact
/// stage is rare on input in general position.
#pragma once

#include <cstdint>

namespace blum {

enum class Stage : std::uint8_t { kFilter, kExtended, kExact };

struct StageCounts {
  std::uint64_t filter = 0, extended = 0, exact = 0;
  void count(Stage s) {
    ++(s == Stage::kFilter ? filter : s == Stage::kExtended ? extended : exact);
  }
  StageCounts& operator+=(const StageCounts& o) {
    filter += o.filter;
    extended += o.extended;
    exact += o.exact;
    return *this;
  }
};

/// Sign of an exact real number and the stage that found it.
struct Decision {
  int sign = 0;
  Stage stage = Stage::kFilter;
};

}  // namespace blum
