#include "angle_box.hpp"

#include <algorithm>
#include <bit>

#include "blum/kernel/strictly_inside.hpp"
#include "tie_angle.hpp"

namespace blum {
namespace {

constexpr std::size_t kMostThirds = 8;  // that are looked at, one by one

struct Member {
  SiteView view;
  GroupSet group = 0;
  std::optional<Governed> part{};  // once it is asked for
};

std::vector<GroupSet> bits_of(GroupSet set) {
  std::vector<GroupSet> bits;
  for (; set != 0; set &= set - 1) bits.push_back(set & -set);
  return bits;
}

/// Is every point with these groups counted by a sheet or a seam of the leaf?
class Represented {
 public:
  explicit Represented(const LeafParts& leaf) : leaf_(leaf) {}

  [[nodiscard]] bool by_arc(GroupSet g, GroupSet h) const {
    return std::any_of(leaf_.arc.begin(), leaf_.arc.end(), [&](const auto& arc) {
      // Where a side may be one of several groups it is not certain that the arc is between these.
      if (!std::has_single_bit(arc.a) || !std::has_single_bit(arc.b)) return false;
      return (within(g, arc.a) && within(h, arc.b)) || (within(h, arc.a) && within(g, arc.b));
    });
  }
  [[nodiscard]] bool pair(GroupSet g, GroupSet h) const {
    return by_arc(g, h) || ((g & h) == 0 && in_seam(g | h));
  }
  /// All sets of three or more groups in `present`.
  [[nodiscard]] bool triples(GroupSet present) const {
    if (std::popcount(present) < 3 || in_seam(present)) return true;
    const std::vector<GroupSet> bits = bits_of(present);
    for (std::size_t i = 0; i < bits.size(); ++i)
      for (std::size_t j = i + 1; j < bits.size(); ++j)
        for (std::size_t k = j + 1; k < bits.size(); ++k)
          if (!in_seam(bits[i] | bits[j] | bits[k])) return false;
    // Each triple is in some seam's set, but four groups need not be.
    return std::popcount(present) == 3;
  }

 private:
  static bool within(GroupSet g, GroupSet set) { return (g & ~set) == 0; }
  [[nodiscard]] bool in_seam(GroupSet g) const {
    return std::any_of(leaf_.seam.begin(), leaf_.seam.end(),
                       [&](const auto& s) { return within(g, s.certain); });
  }
  const LeafParts& leaf_;
};

}  // namespace

bool TiePairs::never(SiteId a, SiteId b) {
  if (b < a) std::swap(a, b);
  const auto [it, fresh] = never_.try_emplace((std::uint64_t{a.value} << 32) | b.value, false);
  if (fresh) it->second = engine_.predicates().never_essential(a, b);
  return it->second;
}

bool seam_counts_pair(const LeafParts& leaf, const AngleRole& role, GroupSet g, GroupSet h) {
  return role.kind == AngleRole::Kind::kSeam && role.distinct && std::has_single_bit(g) &&
         std::has_single_bit(h) && g != h && ((g | h) & ~role.a) == 0 &&
         std::none_of(leaf.arc.begin(), leaf.arc.end(), [&](const auto& arc) {
           return ((g & arc.a) && (h & arc.b)) || ((h & arc.a) && (g & arc.b));
         });
}

AngleBound bound_in_box(const SiteGeometry& geometry, TiePairs& pairs, const LeafParts& leaf,
                        const AngleRole& role, const AngleBox& box) {
  using Kind = AngleRole::Kind;
  // Sites that label nothing govern points on the leaf's surface at most, and these count in the
  // rest, where there is one.
  const bool all = role.kind == Kind::kRest ? !strictly_inside(box.box, leaf.box)
                                            : leaf.rest == LeafParts::kNone;
  std::vector<Member> member;
  GroupSet present = 0;
  for (const SiteId s : box.candidates) {
    if (!all && !leaf.groups.labels(s)) continue;
    member.push_back({view_of(geometry, s, box.box), leaf.groups.of(s)});
    present |= member.back().group;
  }
  const Represented represented(leaf);
  if (role.kind == Kind::kArc && (!(present & role.a) || !(present & role.b))) return {};
  const bool many =
      role.kind == Kind::kRest
          ? !represented.triples(present)
          : role.kind == Kind::kSeam && (!role.distinct || std::popcount(present & role.a) >= 3);
  // A pair counts not at all, with others, or by itself. Two feet of a point between two groups may
  // be in one of them, but it has a foot in either.
  enum Count { kNot, kBeside, kItself };
  const double radius = radius_of(box.box);
  const auto alone = [&](GroupSet g, GroupSet h) {
    return (g & h) == 0 && !represented.by_arc(g, h);
  };
  const auto count = [&](GroupSet g, GroupSet h) {
    switch (role.kind) {
      case Kind::kArc: {
        if (((g & role.a) && (h & role.b)) || ((g & role.b) && (h & role.a))) return kItself;
        const GroupSet both = role.a | role.b;
        return (g & both) && (h & both) ? kBeside : kNot;
      }
      case Kind::kSeam:
        if (!(g & role.a) || !(h & role.a)) return kNot;
        return many || alone(g, h) ? kItself : kNot;
      case Kind::kRest:
        return many || !represented.pair(g, h) ? kItself : kNot;
    }
    return kItself;
  };
  // Of a seam with feet in three groups: those in other groups that may tie with both; none where
  // there are no three.
  const auto thirds = [&](const Member& a, const Member& b) {
    std::vector<const Member*> found;
    GroupSet met = a.group | b.group;
    for (const Member& c : member)
      if ((c.group & role.a & ~(a.group | b.group)) && may_tie(a.view, c.view, radius) &&
          may_tie(b.view, c.view, radius)) {
        found.push_back(&c);
        met |= c.group;
      }
    if (std::popcount(met & role.a) < 3) found.clear();
    return found;
  };
  const auto part = [&](Member& m) -> const Governed& {
    if (!m.part) m.part = governed(geometry, m.view, box.box);
    return *m.part;
  };
  const auto on_tie = [&](const Member& a, const Member& b, const Member* third) {
    return angle_on_tie_at_most(geometry, a.view, b.view, third ? &third->view : nullptr, box.box);
  };
  AngleBound best[3];
  for (std::size_t i = 0; i < member.size(); ++i)
    for (std::size_t j = i + 1; j < member.size(); ++j) {
      Member &a = member[i], &b = member[j];
      const Count c = count(a.group, b.group);
      if (c == kNot) continue;
      if (angle_at_most(a.view, b.view) <= best[c].hi || !may_tie(a.view, b.view, radius)) continue;
      const bool with_third = role.kind == Kind::kSeam && role.distinct &&
                              std::popcount((a.group | b.group) & role.a) < 3 &&
                              !alone(a.group, b.group);
      const auto third = with_third ? thirds(a, b) : std::vector<const Member*>{};
      if ((with_third && third.empty()) || pairs.never(a.view.site, b.view.site)) continue;
      double hi = angle_at_most(a.view, part(a), b.view, part(b));
      if (hi > best[c].hi) hi = std::min(hi, on_tie(a, b, nullptr));
      if (hi > best[c].hi && with_third && third.size() <= kMostThirds) {
        double most = 0;
        for (const Member* m : third) most = std::max(most, on_tie(a, b, m));
        hi = std::min(hi, most);
      }
      if (hi > best[c].hi) best[c] = {hi, a.view.site, b.view.site};
    }
  if (best[kItself].hi == 0) return {};
  return best[kBeside].hi > best[kItself].hi ? best[kBeside] : best[kItself];
}

std::optional<double> least_where_groups_meet(const SiteGeometry& geometry, const LeafParts& leaf,
                                              const AngleBox& box, GroupSet groups, GroupSet must,
                                              int count) {
  std::vector<Member> member;
  GroupSet present = 0;
  for (const SiteId s : box.candidates) {
    const GroupSet own = leaf.groups.of(s) & groups;
    if (own != 0) member.push_back({view_of(geometry, s, box.box), own});
    present |= own;
  }
  if (std::popcount(present) < count) return std::nullopt;
  const double radius = radius_of(box.box);
  const std::vector<GroupSet> bit = bits_of(present);
  // Of each two groups: the least angle between sites of them that may tie; negative: none may.
  std::vector<std::vector<double>> least(bit.size(), std::vector<double>(bit.size(), -1));
  for (std::size_t g = 0; g < bit.size(); ++g)
    for (std::size_t h = 0; h < g; ++h)
      for (const auto& a : member)
        for (const auto& b : member) {
          if (!(a.group & bit[g]) || !(b.group & bit[h]) || &a == &b) continue;
          if (!may_tie(a.view, b.view, radius)) continue;
          const double angle = angle_at_least(a.view, b.view);
          double& entry = least[g][h];
          entry = entry < 0 ? angle : std::min(entry, angle);
        }
  std::optional<double> found;
  std::vector<std::size_t> chosen;
  // All choices of `count` groups that tie pairwise: the largest of their angles.
  const auto choose = [&](const auto& self, std::size_t from, double largest) -> void {
    if (std::ssize(chosen) == count) {
      GroupSet set = 0;
      for (const auto h : chosen) set |= bit[h];
      if ((must & ~set) != 0) return;
      found = found ? std::min(*found, largest) : largest;
      return;
    }
    for (std::size_t g = from; g < bit.size(); ++g) {
      double most = largest;
      bool all = true;
      for (const auto h : chosen) {
        all = all && least[g][h] >= 0;
        most = std::max(most, least[g][h]);
      }
      if (!all) continue;
      chosen.push_back(g);
      self(self, g + 1, most);
      chosen.pop_back();
    }
  };
  choose(choose, 0, 0);
  return found;
}

}  // namespace blum
