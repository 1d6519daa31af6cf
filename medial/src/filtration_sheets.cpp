#include "filtration_sheets.hpp"

#include <algorithm>

namespace blum::detail {

Rows triangles_at_edges(const CellComplex& complex) {
  return {complex.edge.size(), [&](auto put) {
            for (std::uint32_t t = 0; t < complex.triangle.size(); ++t)
              for (const auto e : complex.triangle[t].edge) put(e, t);
          }};
}

Rows triangles_of_sheets(const CellComplex& complex, const Parts& parts) {
  return {parts.sheets, [&](auto put) {
            for (std::uint32_t t = 0; t < complex.triangle.size(); ++t)
              put(parts.triangle_sheet[t], t);
          }};
}

PruneState::PruneState(const CellComplex& complex, const Parts& parts, const CellValues& cost)
    : complex_(complex),
      cost_(cost),
      sheet_of_(parts.triangle_sheet),
      at_edge_(triangles_at_edges(complex)),
      of_sheet_(triangles_of_sheets(complex, parts)),
      sheet_(parts.sheets),
      gone_(complex.triangle.size(), false),
      edge_gone_(complex.edge.size(), false),
      degree_(complex.edge.size(), 0),
      owner_(complex.edge.size(), kNone),
      edges_(complex.vertex.size(), 0),
      edge_xor_(complex.vertex.size(), 0),
      vertex_owner_(complex.vertex.size(), kNone),
      list_of_(complex.vertex.size(), kNone),
      edge_stamp_(complex.edge.size(), 0),
      vertex_stamp_(complex.vertex.size(), 0) {
  for (std::uint32_t t = 0; t < complex.triangle.size(); ++t) {
    Sheet& s = sheet_[sheet_of_[t]];
    s.cost = std::max(s.cost, cost.triangle[t]);
    ++s.euler;
  }
  std::vector<std::uint32_t> first(complex.vertex.size(), kNone);
  std::vector<bool> mixed(complex.vertex.size(), false);
  for (std::uint32_t e = 0; e < complex.edge.size(); ++e) {
    degree_[e] = static_cast<std::uint32_t>(at_edge_[e].size());
    owner_[e] = owner_of(e);
    for (const auto v : complex.edge[e].vertex) {
      ++edges_[v];
      edge_xor_[v] ^= e;
      if (first[v] == kNone) first[v] = owner_[e];
      if (first[v] != owner_[e] || owner_[e] >= kBare) mixed[v] = true;
    }
  }
  for (std::uint32_t v = 0; v < complex.vertex.size(); ++v)
    if (mixed[v]) {
      list_of_[v] = static_cast<std::uint32_t>(list_.size());
      list_.emplace_back();
    } else if (first[v] != kNone) {
      claim_vertex(v, first[v]);
    }
  for (std::uint32_t e = 0; e < complex.edge.size(); ++e) {
    for (const auto v : complex.edge[e].vertex) count_edge_at(v, owner_[e]);
    if (owner_[e] < kBare) claim_edge(e, owner_[e]);
  }
  clear_touched();
}

std::uint32_t PruneState::owner_of(std::uint32_t edge) const {
  std::uint32_t owner = kBare;
  for (const auto t : at_edge_[edge]) {
    if (gone_[t]) continue;
    if (owner != kBare && owner != sheet_of_[t]) return kShared;
    owner = sheet_of_[t];
  }
  return owner;
}

void PruneState::count_edge_at(std::uint32_t vertex, std::uint32_t owner) {
  if (list_of_[vertex] == kNone) return;
  auto& list = list_[list_of_[vertex]];
  for (auto& [who, count] : list)
    if (who == owner) {
      ++count;
      return;
    }
  list.emplace_back(owner, 1);
}

void PruneState::discount_edge_at(std::uint32_t vertex, std::uint32_t owner) {
  if (list_of_[vertex] == kNone) return;
  auto& list = list_[list_of_[vertex]];
  for (auto& entry : list)
    if (entry.first == owner) {
      if (--entry.second == 0) {
        entry = list.back();
        list.pop_back();
      }
      break;
    }
  if (list.size() == 1 && list[0].first < kBare && vertex_owner_[vertex] == kNone)
    claim_vertex(vertex, list[0].first);
}

void PruneState::touch(std::uint32_t sheet) {
  if (!sheet_[sheet].touched) sheets_.push_back(sheet);
  sheet_[sheet].touched = true;
}

void PruneState::claim_edge(std::uint32_t edge, std::uint32_t sheet) {
  Sheet& s = sheet_[sheet];
  --s.euler;
  if (degree_[edge] == 1) ++s.free;
  if (cost_.edge[edge] > s.cost) s.dear_edge.push_back(edge);
  touch(sheet);
}

void PruneState::claim_vertex(std::uint32_t vertex, std::uint32_t sheet) {
  Sheet& s = sheet_[sheet];
  vertex_owner_[vertex] = sheet;
  ++s.euler;
  if (cost_.vertex[vertex] > s.cost) s.dear_vertex.push_back(vertex);
  touch(sheet);
}

void PruneState::clear_touched() {
  for (const auto s : sheets_) sheet_[s].touched = false;
  sheets_.clear();
  vertices_.clear();
}

std::pair<long, long> PruneState::keep_above(const Sheet& sheet, std::uint32_t id, double cost) {
  ++stamp_;
  long euler = 0, free = 0;
  const auto keep_vertex = [&](std::uint32_t v) {
    if (vertex_owner_[v] != id || vertex_stamp_[v] == stamp_) return;
    vertex_stamp_[v] = stamp_;
    ++euler;
  };
  for (const auto v : sheet.dear_vertex)
    if (cost_.vertex[v] > cost) keep_vertex(v);
  for (const auto e : sheet.dear_edge) {
    if (!(cost_.edge[e] > cost)) continue;
    edge_stamp_[e] = stamp_;
    --euler;
    if (degree_[e] == 1) ++free;
    for (const auto v : complex_.edge[e].vertex) keep_vertex(v);
  }
  return {euler, free};
}

std::optional<double> PruneState::cheapest(std::uint32_t sheet, double at_least) {
  const Sheet& s = sheet_[sheet];
  if (s.free == 0) return std::nullopt;
  std::vector<double> level{s.cost};
  for (const auto e : s.dear_edge) level.push_back(cost_.edge[e]);
  for (const auto v : s.dear_vertex) level.push_back(cost_.vertex[v]);
  std::sort(level.begin(), level.end());
  level.erase(std::unique(level.begin(), level.end()), level.end());
  for (const double c : level) {
    if (c < at_least) continue;
    const auto [euler, free] = keep_above(s, sheet, c);
    if (s.euler == euler && s.free > free) return c;
  }
  return std::nullopt;
}

void PruneState::drop_triangle(std::uint32_t t, int sign) {
  gone_[t] = sign > 0;
  for (const auto e : complex_.triangle[t].edge) degree_[e] -= static_cast<std::uint32_t>(sign);
}

void PruneState::drop_edge(std::uint32_t e, int sign) {
  edge_gone_[e] = sign > 0;
  for (const auto v : complex_.edge[e].vertex) {
    edges_[v] -= static_cast<std::uint32_t>(sign);
    edge_xor_[v] ^= e;
  }
}

void PruneState::collapse_triangles(std::uint32_t sheet, std::vector<ElementaryCollapse>& done) {
  stack_.clear();
  const auto consider = [&](std::uint32_t e) {
    if (degree_[e] == 1 && removable_edge(e, sheet)) stack_.push_back(e);
  };
  for (const auto t : of_sheet_[sheet])
    for (const auto e : complex_.triangle[t].edge) consider(e);
  while (!stack_.empty()) {
    const auto e = stack_.back();
    stack_.pop_back();
    if (degree_[e] != 1) continue;
    const auto there = at_edge_[e];
    const auto t = *std::find_if(there.begin(), there.end(), [&](auto x) { return !gone_[x]; });
    drop_triangle(t, 1);
    drop_edge(e, 1);
    done.push_back({2, e, t});
    for (const auto f : complex_.triangle[t].edge) consider(f);
  }
}

void PruneState::collapse_graph(std::uint32_t sheet, std::vector<ElementaryCollapse>& done) {
  // All triangles are gone; vertices with one edge left begin.
  stack_.clear();
  const auto consider = [&](std::uint32_t v) {
    if (edges_[v] == 1 && removable_vertex(v, sheet)) stack_.push_back(v);
  };
  for (const auto t : of_sheet_[sheet])
    for (const auto e : complex_.triangle[t].edge)
      for (const auto v : complex_.edge[e].vertex) consider(v);
  while (!stack_.empty()) {
    const auto v = stack_.back();
    stack_.pop_back();
    if (edges_[v] != 1) continue;
    const auto e = edge_xor_[v];
    drop_edge(e, 1);
    done.push_back({1, v, e});
    for (const auto w : complex_.edge[e].vertex) consider(w);
  }
}

void PruneState::undo(const std::vector<ElementaryCollapse>& done) {
  for (auto it = done.rbegin(); it != done.rend(); ++it) {
    drop_edge(it->dimension == 2 ? it->face : it->cell, -1);
    if (it->dimension == 2) drop_triangle(it->cell, -1);
  }
}

std::optional<std::vector<ElementaryCollapse>> PruneState::try_sheet(std::uint32_t sheet,
                                                                     double cost) {
  keep_above(sheet_[sheet], sheet, cost);
  std::vector<ElementaryCollapse> done;
  collapse_triangles(sheet, done);
  bool all = done.size() == of_sheet_[sheet].size();
  if (all) collapse_graph(sheet, done);
  // Every private edge that is not kept has to be gone; vertices then are too, as the Euler
  // characteristic is zero.
  for (const auto t : of_sheet_[sheet]) {
    if (!all) break;
    for (const auto e : complex_.triangle[t].edge)
      all &= !removable_edge(e, sheet) || edge_gone_[e];
  }
  if (!all) {
    undo(done);
    return std::nullopt;
  }
  hand_over(sheet, done);
  return done;
}

void PruneState::hand_over(std::uint32_t sheet, const std::vector<ElementaryCollapse>& done) {
  sheet_[sheet].free = 0;
  for (const ElementaryCollapse& c : done)
    if (c.dimension == 1) {
      vertex_owner_[c.face] = kNone;
      list_of_[c.face] = kNone;
    }
  for (const auto t : of_sheet_[sheet])
    for (const auto e : complex_.triangle[t].edge) {
      const auto old = owner_[e];
      if (old != sheet && old != kShared) continue;
      const auto now = edge_gone_[e] ? kNone : owner_of(e);
      if (now == old) continue;
      owner_[e] = now;
      for (const auto v : complex_.edge[e].vertex) {
        if (now != kNone) count_edge_at(v, now);
        discount_edge_at(v, old);
        if (vertex_owner_[v] == sheet) vertex_owner_[v] = kNone;
        if (now == kNone || now == kBare) vertices_.push_back(v);
      }
      if (now < kBare) claim_edge(e, now);
    }
}

std::uint32_t PruneState::only_bare_edge(std::uint32_t v) const {
  if (edges_[v] != 1) return kNone;
  const auto e = edge_xor_[v];
  return owner_[e] == kBare ? e : kNone;
}

void PruneState::remove_bare_edge(std::uint32_t v, std::uint32_t e) {
  drop_edge(e, 1);
  owner_[e] = kNone;
  list_of_[v] = kNone;
  const auto& ends = complex_.edge[e].vertex;
  const auto w = ends[0] == v ? ends[1] : ends[0];
  discount_edge_at(w, kBare);
  vertices_.push_back(w);
}

}  // namespace blum::detail
