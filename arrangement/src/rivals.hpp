/// Which two of the forms of a range may both govern one of its points?
#pragma once

#include <cstdint>
#include <span>
#include <vector>

#include "engine_context.hpp"
#include "local_form.hpp"

namespace blum {

/// Is there no point of the range where the two tie that lies in the domains of both? False:
/// undecided. (docs/proofs.md, "Rivals".)
[[nodiscard]] bool tie_outside_domains(EngineContext& context, const LocalForm& a,
                                       const LocalForm& c, const Range& range);

/// Is b nearer than both wherever in the range they tie? False: undecided. (docs/proofs.md,
/// "Rivals".)
[[nodiscard]] bool nearer_at_ties(EngineContext& context, const LocalForm& b, const LocalForm& a,
                                  const LocalForm& c, const Range& range);

/// Decided once a pair, when asked. For certificates (parts are recorded) by may_both_govern
/// alone.
class Rivals {
 public:
  /// Refers to all of them.
  Rivals(EngineContext& context, std::span<const LocalForm> forms, const Range& range)
      : context_(context),
        forms_(forms),
        range_(range),
        known_(forms.size() * forms.size(), Known::kNo) {}

  [[nodiscard]] const Range& range() const { return range_; }

  /// May forms[i] and forms[j] both govern one point of the range? False only if certain.
  [[nodiscard]] bool meet(std::size_t i, std::size_t j) {
    if (i > j) std::swap(i, j);
    Known& known = known_[i * forms_.size() + j];
    if (known == Known::kNo) known = decide(i, j) ? Known::kMayMeet : Known::kApart;
    return known == Known::kMayMeet;
  }

 private:
  enum class Known : std::uint8_t { kNo, kApart, kMayMeet };
  [[nodiscard]] bool decide(std::size_t i, std::size_t j);

  EngineContext& context_;
  std::span<const LocalForm> forms_;
  const Range& range_;
  std::vector<Known> known_;  // [i * n + j], i < j
};

}  // namespace blum
