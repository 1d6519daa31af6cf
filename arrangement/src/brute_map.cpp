#include "brute_map.hpp"

#include <algorithm>
#include <numeric>
#include <set>

#include "blum/kernel/check.hpp"

namespace blum::brute {
namespace {

std::size_t at(int k) { return static_cast<std::size_t>(k); }

struct UnionFind {
  std::vector<int> parent;
  explicit UnionFind(std::size_t n) : parent(n) { std::iota(parent.begin(), parent.end(), 0); }
  int find(int a) {
    while (parent[at(a)] != a) a = parent[at(a)] = parent[at(parent[at(a)])];
    return a;
  }
  void join(int a, int b) { parent[at(find(a))] = find(b); }
};

/// Numbers the classes of the elements chosen by `in`.
template <class In>
std::vector<std::uint32_t> components(const Sweep& sweep, In&& in, std::uint32_t& count) {
  const int n = static_cast<int>(sweep.element.size());
  UnionFind classes(at(n));
  for (int e = 0; e < n; ++e)
    if (in(e))
      for (const int b : sweep.element[at(e)].beside)
        if (b >= 0 && in(b)) classes.join(e, b);
  std::vector<std::uint32_t> out(at(n), Map::kNone), number(at(n), Map::kNone);
  count = 0;
  for (int e = 0; e < n; ++e) {
    if (!in(e)) continue;
    auto& k = number[at(classes.find(e))];
    if (k == Map::kNone) k = count++;
    out[at(e)] = k;
  }
  return out;
}

}  // namespace

Map make_map(const Setting& setting, const Sweep& sweep) {
  using Kind = Element::Kind;
  const int n = static_cast<int>(sweep.element.size());
  const auto element = [&](int e) -> const Element& { return sweep.element[at(e)]; };
  Map map;
  map.in_g.assign(at(n), 0);
  map.sections.resize(at(n));
  const auto essential = [&](const Element& e) {
    return e.inside && setting.essential_pair(e.governor, e.governor);
  };
  for (int i = 0; i < n; ++i) {
    const Element& e = element(i);
    if (e.kind == Kind::kPoint || !essential(e)) continue;
    if (e.kind != Kind::kSection) throw BadPosition("a sheet lies in the plane");
    if (e.sides != 0) throw BadPosition("a tie lies along a side");
    if (!setting.essential_pair(element(e.beside[2]).governor, element(e.beside[3]).governor))
      throw BadPosition("a sheet touches the plane along an arc");
    if (!feet_differ(setting, *sweep.sample[at(e.column)], e.place, e.governor))
      throw BadPosition("a rim lies in the plane");
    map.in_g[at(i)] = 1;
    for (const int end : {e.beside[0], e.beside[1]}) {
      map.sections[at(end)].push_back(i);
      if (element(end).inside) map.in_g[at(end)] = 1;
    }
  }
  for (int i = 0; i < n; ++i) {  // isolated points of the medial axis: a sheet touches the plane
    const Element& e = element(i);
    if (e.kind == Kind::kPoint && !map.in_g[at(i)] && essential(e) &&
        feet_differ(setting, *sweep.critical[at(e.column)], e.place, e.governor))
      map.in_g[at(i)] = 1;
  }

  std::uint32_t regions = 0, pieces = 0;
  map.region = components(
      sweep, [&](int e) { return element(e).inside && !map.in_g[at(e)]; }, regions);
  map.piece = components(
      sweep, [&](int e) { return element(e).inside; }, pieces);

  std::vector<std::set<int>> labels(regions);
  map.region_piece.resize(regions);
  std::vector<int> euler(pieces, 0);  // of the pieces' interiors, by compactly supported count
  for (int i = 0; i < n; ++i) {
    const Element& e = element(i);
    if (!e.inside) continue;
    if (const std::uint32_t r = map.region[at(i)]; r != Map::kNone) {
      labels[r].insert(e.governor.begin(), e.governor.end());
      map.region_piece[r] = map.piece[at(i)];
    }
    if (e.sides == 0)
      euler[map.piece[at(i)]] += e.kind == Kind::kCell || e.kind == Kind::kPoint ? 1 : -1;
  }
  for (const auto& l : labels) map.labels.emplace_back(l.begin(), l.end());
  for (const int chi : euler) map.circles.push_back(static_cast<std::uint32_t>(2 - chi));
  return map;
}

}  // namespace blum::brute
