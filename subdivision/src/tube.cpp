#include "blum/subdivision/tube.hpp"

#include <algorithm>
#include <deque>
#include <unordered_map>

namespace blum {
namespace {

constexpr std::uint32_t kNone = 0xffffffffu;

class Walks {
 public:
  explicit Walks(std::span<const SphereArc> arcs) : arcs_(arcs) {
    for (std::uint32_t a = 0; a < arcs.size(); ++a) {
      const auto [p, q] = arcs[a].piece;
      if (p == q || p == SphereArc::kUnknown || q == SphereArc::kUnknown) continue;
      border_[p].push_back(a);
      border_[q].push_back(a);
    }
  }

  /// The arcs that a shortest path between two pieces crosses; empty if there is none.
  [[nodiscard]] std::vector<std::uint32_t> path(std::uint32_t from, std::uint32_t to) const {
    std::unordered_map<std::uint32_t, std::uint32_t> by{{from, kNone}};  // piece -> arc into it
    std::deque<std::uint32_t> queue{from};
    for (; !queue.empty() && !by.contains(to); queue.pop_front())
      for (const auto a : border(queue.front()))
        if (const auto next = beyond(a, queue.front()); by.try_emplace(next, a).second)
          queue.push_back(next);
    std::vector<std::uint32_t> crossed;
    if (!by.contains(to)) return crossed;
    for (auto piece = to; piece != from; piece = beyond(crossed.back(), piece))
      crossed.push_back(by.at(piece));
    std::ranges::reverse(crossed);
    return crossed;
  }

  /// The border of a disk, walked along arc `first` as it is directed if `forward`: is `second`
  /// met, and in its direction? The border consists of simple closed walks with a node in common at
  /// most (what joins them has the piece on both sides): the one that `first` is on is walked.
  [[nodiscard]] std::optional<bool> direction(std::uint32_t piece, std::uint32_t first,
                                              bool forward, std::uint32_t second) const {
    const auto start = arcs_[first].node[forward ? 1 : 0],
               goal = arcs_[first].node[forward ? 0 : 1];
    std::unordered_map<std::uint32_t, std::uint32_t> by{{start, kNone}};  // node -> arc to it
    std::deque<std::uint32_t> queue{start};
    for (; !queue.empty() && !by.contains(goal); queue.pop_front())
      for (const auto a : border(piece))
        for (const std::size_t end : {0, 1})
          if (a != first && arcs_[a].node[end] == queue.front() &&
              by.try_emplace(arcs_[a].node[1 - end], a).second)
            queue.push_back(arcs_[a].node[1 - end]);
    if (!by.contains(goal)) return std::nullopt;
    for (auto node = goal; node != start;) {
      const auto a = by.at(node);
      const bool along = arcs_[a].node[1] == node;
      if (a == second) return along;
      node = arcs_[a].node[along ? 0 : 1];
    }
    return std::nullopt;
  }

  [[nodiscard]] std::uint32_t beyond(std::uint32_t arc, std::uint32_t piece) const {
    const auto& p = arcs_[arc].piece;
    return p[0] == piece ? p[1] : p[0];
  }

 private:
  [[nodiscard]] std::span<const std::uint32_t> border(std::uint32_t piece) const {
    const auto it = border_.find(piece);
    return it == border_.end() ? std::span<const std::uint32_t>() : it->second;
  }

  std::span<const SphereArc> arcs_;
  std::unordered_map<std::uint32_t, std::vector<std::uint32_t>> border_;
};

}  // namespace

std::optional<std::vector<Crossing>> tube_crossings(std::span<const SphereArc> arcs,
                                                    std::uint32_t from, std::uint32_t to) {
  const Walks walks(arcs);
  const auto crossed = walks.path(from, to);
  if (crossed.empty()) return std::nullopt;
  std::vector<Crossing> answer{{crossed.front(), true}};
  std::uint32_t piece = from;
  for (std::size_t k = 1; k < crossed.size(); ++k) {
    piece = walks.beyond(crossed[k - 1], piece);
    // The border of a piece is crossed once inwards and once outwards.
    const auto along = walks.direction(piece, crossed[k - 1], answer.back().forward, crossed[k]);
    if (!along) return std::nullopt;
    answer.push_back({crossed[k], !*along});
  }
  return answer;
}

}  // namespace blum
