#include "group_changes.hpp"

#include "slope.hpp"

namespace blum {

GroupChanges::GroupChanges(EngineContext& context, int axis, std::span<const LocalForm> forms,
                           const Groups& groups, const Range& range)
    : context_(context),
      forms_(forms),
      groups_(groups),
      range_(range),
      axis_(axis),
      change_(std::size_t{groups.count} * groups.count, Known::kNo) {}

void GroupChanges::compare(std::uint32_t g, std::uint32_t h) {
  Direction along, back;
  along.w[axis_] = Ball(1.0);
  back.w[axis_] = Ball(-1.0);
  bool forth = false, home = false;  // from g to h, and back
  for (std::size_t i = 0; i < forms_.size() && !(forth && home); ++i) {
    if (groups_.of[i] != g) continue;
    for (std::size_t j = 0; j < forms_.size() && !(forth && home); ++j) {
      if (groups_.of[j] != h) continue;
      const LocalForm &a = forms_[i], &b = forms_[j];
      if (!may_both_govern(context_, a, b, range_)) continue;
      const PairSlope slope = pair_slope(context_, a, b, range_);
      // Which of the two gains all along.
      int winner = gains(slope, range_, along.w)  ? 1
                   : gains(slope, range_, back.w) ? -1
                                                        : 0;
      if (winner == 0 && !may_share_foot(context_, a.site, b.site, forms_, range_))
        winner = gains_by_feet(context_, slope, a.site, b.site, along, forms_, range_)  ? 1
                 : gains_by_feet(context_, slope, a.site, b.site, back, forms_, range_) ? -1
                                                                                        : 0;
      forth |= winner != 1;
      home |= winner != -1;
    }
  }
  change_[g * groups_.count + h] = forth ? Known::kPossible : Known::kImpossible;
  change_[h * groups_.count + g] = home ? Known::kPossible : Known::kImpossible;
}

bool GroupChanges::possible(std::uint32_t from, std::uint32_t to) {
  const Known& known = change_[from * groups_.count + to];
  if (known == Known::kNo) compare(from, to);
  return known == Known::kPossible;
}

bool GroupChanges::reachable(std::uint32_t from, std::uint32_t to) {
  std::vector<bool> seen(groups_.count, false);
  std::vector<std::uint32_t> stack{from};
  while (!stack.empty()) {
    const auto g = stack.back();
    stack.pop_back();
    if (g != to && possible(g, to)) return true;
    for (std::uint32_t h = 0; h < groups_.count; ++h) {
      if (h == g || h == to || seen[h] || !possible(g, h)) continue;
      seen[h] = true;
      stack.push_back(h);
    }
  }
  return false;
}

bool GroupChanges::direct(std::uint32_t from, std::uint32_t to) {
  for (std::uint32_t h = 0; h < groups_.count; ++h)
    if (h != from && possible(from, h) && reachable(h, to)) return false;
  return true;
}

}  // namespace blum
