// The filtration with a priority queue. A sheet's cells that no other part has are *private*. A
// sheet collapses onto the rest only if the Euler characteristic of its private cells is zero and
// one of its private edges is free, which counters tell at once; only then it is tried.

#include "blum/medial/filtration.hpp"

#include <algorithm>
#include <cmath>
#include <functional>
#include <queue>
#include <tuple>

#include "blum/kernel/check.hpp"
#include "filtration_sheets.hpp"

namespace blum {
namespace {

using detail::kNone;
using detail::PruneState;

/// What the queue orders.
struct Entry {
  double cost;
  bool is_sheet;
  std::uint32_t unit;
  std::uint32_t detail;  // sheets: version, stale where it has moved on; edges: the free end
  friend bool operator>(const Entry& a, const Entry& b) {
    return std::tie(a.cost, a.is_sheet, a.unit, a.detail) >
           std::tie(b.cost, b.is_sheet, b.unit, b.detail);
  }
};

class Pruner {
 public:
  Pruner(const CellComplex& complex, const Parts& parts, const CellValues& cost)
      : complex_(complex),
        cost_(cost),
        state_(complex, parts, cost),
        version_(parts.sheets, 0),
        next_level_(parts.sheets, 0) {}

  Filtration run();

 private:
  void offer_sheet(std::uint32_t sheet);
  void offer_edge_at(std::uint32_t vertex);
  void remove_sheet(const Entry& entry);
  void remove_edge(const Entry& entry);
  void begin_step(const Entry& entry);
  void record(const ElementaryCollapse& c);
  void offer_touched();

  const CellComplex& complex_;
  const CellValues& cost_;
  PruneState state_;
  std::vector<std::uint32_t> version_;  // of sheets
  std::vector<double> next_level_;      // costs below have been tried in vain since the last change
  std::priority_queue<Entry, std::vector<Entry>, std::greater<>> queue_;
  Filtration result_;
  double reached_ = 0;
};

void Pruner::offer_sheet(std::uint32_t sheet) {
  ++version_[sheet];
  if (const auto c = state_.cheapest(sheet, next_level_[sheet]))
    queue_.push({*c, true, sheet, version_[sheet]});
}

void Pruner::offer_edge_at(std::uint32_t vertex) {
  const std::uint32_t e = state_.only_bare_edge(vertex);
  if (e != kNone) queue_.push({std::max(cost_.edge[e], cost_.vertex[vertex]), false, e, vertex});
}

void Pruner::begin_step(const Entry& entry) {
  reached_ = std::max(reached_, entry.cost);
  result_.step.push_back({entry.cost, reached_, entry.is_sheet, entry.unit,
                          static_cast<std::uint32_t>(result_.collapse.size())});
}

void Pruner::record(const ElementaryCollapse& c) {
  result_.collapse.push_back(c);
  CellValues& value = result_.value;
  (c.dimension == 2 ? value.edge : value.vertex)[c.face] = reached_;
  (c.dimension == 2 ? value.triangle : value.edge)[c.cell] = reached_;
}

void Pruner::offer_touched() {
  for (const auto s : state_.touched_sheets()) {
    next_level_[s] = 0;
    offer_sheet(s);
  }
  for (const auto v : state_.touched_vertices()) offer_edge_at(v);
  state_.clear_touched();
}

void Pruner::remove_sheet(const Entry& entry) {
  const auto removed = state_.try_sheet(entry.unit, entry.cost);
  if (!removed) {
    // Another level may do: nothing that is protected now need be then.
    next_level_[entry.unit] = std::nextafter(entry.cost, 1e9);
    offer_sheet(entry.unit);
    return;
  }
  begin_step(entry);
  for (const ElementaryCollapse& c : *removed) record(c);
  ++version_[entry.unit];
  offer_touched();
}

void Pruner::remove_edge(const Entry& entry) {
  const std::uint32_t e = entry.unit, v = entry.detail;
  if (state_.only_bare_edge(v) != e) return;
  begin_step(entry);
  record({1, v, e});
  state_.remove_bare_edge(v, e);
  offer_touched();
}

Filtration Pruner::run() {
  CellValues& value = result_.value;
  value.vertex.assign(complex_.vertex.size(), Filtration::kStays);
  value.edge.assign(complex_.edge.size(), Filtration::kStays);
  value.triangle.assign(complex_.triangle.size(), Filtration::kStays);
  for (std::uint32_t s = 0; s < version_.size(); ++s) offer_sheet(s);
  for (std::uint32_t v = 0; v < complex_.vertex.size(); ++v) offer_edge_at(v);
  while (!queue_.empty()) {
    const Entry entry = queue_.top();
    queue_.pop();
    if (!entry.is_sheet)
      remove_edge(entry);
    else if (entry.detail == version_[entry.unit])
      remove_sheet(entry);
  }
  return std::move(result_);
}

}  // namespace

Filtration filter(const CellComplex& complex, const Parts& parts, const CellValues& cost) {
  BLUM_CHECK(cost.vertex.size() == complex.vertex.size());
  BLUM_CHECK(cost.edge.size() == complex.edge.size());
  BLUM_CHECK(cost.triangle.size() == complex.triangle.size());
  return Pruner(complex, parts, cost).run();
}

}  // namespace blum
