#include "angle_memo.hpp"

#include <bit>
#include <utility>

namespace blum {
namespace {

class Words {
 public:
  void add(std::uint64_t n) { key_.push_back(n); }
  void add(double x) { key_.push_back(std::bit_cast<std::uint64_t>(x)); }
  void add(SiteId s) { add(std::uint64_t{s.value}); }
  void add(const Point3& p) {
    for (int k = 0; k < 3; ++k) add(p[k]);
  }
  void add(const Box3& box) {
    add(box.lo);
    add(box.hi);
  }
  /// Lists begin with their length, so that different ones never look alike.
  template <class List, class Add>
  void list(const List& items, const Add& one) {
    add(std::uint64_t{items.size()});
    for (const auto& item : items) one(item);
  }
  [[nodiscard]] AngleMemo::Key take() { return std::move(key_); }

 private:
  AngleMemo::Key key_;
};

AngleMemo::Key words_of(const LeafParts& parts, const Leaf& leaf) {
  Words w;
  w.add(leaf.box);
  w.add(std::uint64_t{leaf.boundary_vertex});
  w.add(std::uint64_t{parts.conical} | std::uint64_t{parts.junction} << 1 |
        std::uint64_t{parts.rest != LeafParts::kNone} << 2);
  w.list(leaf.candidates, [&](SiteId s) { w.add(s); });
  w.list(parts.groups.entries(), [&](const auto& entry) {
    w.add(entry.first);
    w.add(entry.second);
  });
  w.list(parts.arc, [&](const LeafParts::Arc& a) {
    w.add(a.a);
    w.add(a.b);
  });
  w.list(parts.seam, [&](const LeafParts::Seam& s) {
    w.add(s.groups);
    w.add(s.certain);
    w.add(std::uint64_t{s.arcs});
  });
  w.list(parts.node, [&](const LeafParts::Node& n) {
    w.add(std::uint64_t{n.vertex});
    w.add(n.box);
    w.add(n.groups);
    w.list(n.arc, [&](GroupSet g) { w.add(g); });
  });
  return w.take();
}

}  // namespace

void AngleMemo::number(const std::vector<LeafParts>& leaves, const Subdivision& subdivision) {
  std::map<Key, std::uint64_t> now;
  leaf_now_.clear();
  for (const LeafParts& parts : leaves) {
    Key words = words_of(parts, subdivision.leaf[parts.leaf]);
    const auto before = leaf_.find(words);
    leaf_now_.push_back(before != leaf_.end() ? before->second : next_++);
    now.try_emplace(std::move(words), leaf_now_.back());
  }
  leaf_ = std::move(now);
}

AngleMemo::Key AngleMemo::key(const std::vector<AngleTask>& tasks,
                              const std::vector<AngleStart>& starts) const {
  Words w;
  w.list(tasks, [&](const AngleTask& t) {
    w.add(leaf_now_[t.leaf]);
    w.add(static_cast<std::uint64_t>(t.role.kind));
    w.add(t.role.a);
    w.add(t.role.b);
    w.add(std::uint64_t{t.role.distinct});
  });
  Words hints;
  hints.list(starts, [&](const AngleStart& s) {
    hints.add(std::uint64_t{s.task});
    hints.add(s.x);
    hints.add(s.reach);
    hints.add(s.a);
    hints.add(s.b);
  });
  // Bounds are right wherever witnesses were looked for, so a sum that happens to agree does no
  // harm.
  std::uint64_t sum = 0xcbf29ce484222325u;
  for (const auto word : hints.take()) sum = (sum ^ word) * 0x100000001b3u;
  w.add(sum);
  return w.take();
}

const AngleMemo::Known* AngleMemo::find(const Key& key, const AngleLook& look) const {
  const auto it = part_.find(key);
  if (it == part_.end()) return nullptr;
  const Known& known = it->second;
  return known.look == look || known.interval.width() <= look.tolerance_deg ? &known : nullptr;
}

void AngleMemo::keep(std::map<Key, Known> parts) { part_ = std::move(parts); }

}  // namespace blum
