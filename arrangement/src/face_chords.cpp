// Parts of a face through which several arcs run side by side, without events.
#include <algorithm>
#include <map>
#include <utility>
#include <vector>

#include "face_engine.hpp"

namespace blum {
namespace {

using GroupPair = std::pair<std::uint32_t, std::uint32_t>;

GroupPair ordered(std::uint32_t a, std::uint32_t b) { return {std::min(a, b), std::max(a, b)}; }

/// Does every two that show beside each other do so at two places of the circle?
bool come_in_twos(std::span<const std::uint32_t> run) {
  std::map<GroupPair, int> count;
  for (std::size_t k = 0; run.size() > 1 && k < run.size(); ++k)
    ++count[ordered(run[k], run[(k + 1) % run.size()])];
  return std::ranges::all_of(count, [](const auto& c) { return c.second == 2; });
}

/// A number for the region of each interval: end k lies before interval k, and an arc joins the two
/// ends between the same groups.
std::vector<std::uint32_t> regions_beside(std::span<const std::uint32_t> run) {
  const auto n = static_cast<std::uint32_t>(run.size());
  UnionFind region;
  region.resize(n);
  std::map<GroupPair, std::uint32_t> first;
  for (std::uint32_t k = 0; n > 1 && k < n; ++k) {
    const auto before = [n](std::uint32_t i) { return (i + n - 1) % n; };
    const auto [it, fresh] = first.try_emplace(ordered(run[before(k)], run[k]), k);
    if (fresh) continue;
    region.unite(it->second, before(k));
    region.unite(before(it->second), k);
  }
  std::vector<std::uint32_t> r;
  for (std::uint32_t k = 0; k < n; ++k) r.push_back(region.find(k));
  return r;
}

bool closes_triangle(const std::vector<std::vector<bool>>& ties, std::uint32_t a, std::uint32_t b) {
  for (std::size_t c = 0; c < ties.size(); ++c)
    if (ties[a][c] && ties[b][c]) return true;
  return false;
}

}  // namespace

bool FaceEngine::accept_chords(const Box& box, const Border& border,
                               std::span<const std::vector<std::uint32_t>> runs,
                               std::span<const LocalForm> forms, const Groups& groups,
                               const Groups& feet, Rivals& rivals) {
  if (!std::ranges::all_of(runs, come_in_twos)) return false;
  const Range& range = rivals.range();
  std::map<GroupPair, std::vector<GainPair>> pairs;
  std::vector<std::vector<bool>> ties(groups.count, std::vector<bool>(groups.count, false));
  std::vector<std::array<SiteId, 3>> parted;
  const auto find_parting = [&](const LocalForm& a, const LocalForm& c) {
    // Rivals tell more, but a certificate has to name the third face.
    if (!context_.plain || context_.voronoi() || a.side == 0 || c.side == 0) return false;
    for (const LocalForm& b : forms)
      if (b.site != a.site && b.site != c.site && parted_by(context_.geometry, a, c, b, range)) {
        parted.push_back({a.site, c.site, b.site});
        return true;
      }
    return false;
  };
  const auto tie = [&](std::uint32_t g, std::uint32_t h) {
    if (closes_triangle(ties, g, h)) return false;
    ties[g][h] = ties[h][g] = true;
    return true;
  };
  for (const auto& run : runs)
    for (std::size_t k = 0; run.size() > 1 && k < run.size(); ++k)
      if (const auto g = run[k], h = run[(k + 1) % run.size()];
          g == h || (!ties[g][h] && !tie(g, h)))
        return false;
  for (std::uint32_t i = 0; i < forms.size(); ++i)
    for (std::uint32_t j = 0; j < i; ++j) {
      const auto g = groups.of[i], h = groups.of[j];
      if (g == h || find_parting(forms[i], forms[j]) || !rivals.meet(i, j)) continue;
      if (!ties[g][h] && !tie(g, h)) return false;
      const auto [a, b] = g < h ? std::pair{i, j} : std::pair{j, i};
      pairs[ordered(g, h)].push_back({a, b, pair_slope(context_, forms[a], forms[b], range)});
    }
  for (const auto& run : runs)
    for (std::size_t k = 0; run.size() > 1 && k < run.size(); ++k)
      if (!pairs.contains(ordered(run[k], run[(k + 1) % run.size()]))) return false;
  std::vector<PartRecord::Between> between;
  for (const auto& [pair, gains] : pairs) {
    const auto d = direction(gains, forms, range);
    if (!d) return false;
    if (context_.parts == nullptr) continue;
    for (const SiteId a : groups.members(forms, groups.of[gains[0].i]))
      for (const SiteId b : groups.members(forms, groups.of[gains[0].j]))
        between.push_back({a, b, in_plane(*d)});
  }
  std::vector<std::vector<std::uint32_t>> regions;
  for (const auto& run : runs) {
    regions.push_back(regions_beside(run));
    // Chords that cross: then something above is not as thought.
    if (run.size() > 1 && std::ranges::any_of(trees_of(regions.back()), [](const auto& tree) {
          return tree.second.size() != 2;
        }))
      return false;
  }
  for (std::size_t c = 0; c < runs.size(); ++c)
    record(border.circle[c], forms, feet, box, regions[c]);
  if (context_.parts != nullptr) {
    note(&groups == &feet ? PartRecord::Kind::kFeetChords : PartRecord::Kind::kChords, forms);
    context_.parts->back().between = std::move(between);
    context_.parts->back().parted = std::move(parted);
  }
  return true;
}

}  // namespace blum
