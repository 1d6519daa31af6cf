/// Which changes of governor are possible along a line, between groups.
#pragma once

#include <cstdint>
#include <span>
#include <vector>

#include "engine_context.hpp"
#include "groups.hpp"
#include "local_form.hpp"

namespace blum {

/// For groups that are cliques, of one of the two partitions of `Groups`. Filled as asked: most
/// ranges are too large, which a few pairs tell.
class GroupChanges {
 public:
  /// Along the axis in which the range extends, forwards.
  GroupChanges(EngineContext& context, int axis, std::span<const LocalForm> forms,
               const Groups& groups, const Range& range);

  /// Between a point governed by `from` and a later one governed by `to`: is the governing group
  /// certain to change but once, or not at all if they are equal? False: undecided.
  [[nodiscard]] bool direct(std::uint32_t from, std::uint32_t to);

 private:
  enum class Known : std::uint8_t { kNo, kImpossible, kPossible };
  void compare(std::uint32_t g, std::uint32_t h);
  [[nodiscard]] bool possible(std::uint32_t from, std::uint32_t to);
  /// By one or more changes.
  [[nodiscard]] bool reachable(std::uint32_t from, std::uint32_t to);

  EngineContext& context_;
  std::span<const LocalForm> forms_;
  const Groups& groups_;
  const Range& range_;
  int axis_;
  std::vector<Known> change_;  // [from * count + to]
};

}  // namespace blum
