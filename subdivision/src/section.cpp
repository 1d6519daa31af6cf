#include "blum/subdivision/section.hpp"

#include <algorithm>
#include <limits>
#include <vector>

#include "blum/kernel/closest_point.hpp"
#include "meeting.hpp"

namespace blum {
namespace {

/// A plane that keeps clear of the axis by a tenth of the cell takes some 50 boxes.
constexpr int kMaxBoxes = 160;
/// Boxes thinner than this fraction of the cell's section are not bisected: the plane is too near.
constexpr double kThinnest = 1.0 / 48;

struct Part {
  Box3 box;
  std::vector<SiteId> candidates;
  std::vector<std::uint32_t> triangles;
};

double longest(const Box3& box, int& axis) {
  double length = -1;
  for (int k = 0; k < 3; ++k)
    if (box.hi[k] - box.lo[k] > length) {
      length = box.hi[k] - box.lo[k];
      axis = k;
    }
  return length;
}

class Section {
 public:
  Section(const SiteGeometry& geometry, ProductionEngine& engine, const InsideOracle& inside)
      : geometry_(geometry), engine_(engine), inside_(inside) {}

  SectionAnswer run(const CutPlane& plane, const Box3& box, std::span<const SiteId> candidates,
                    std::span<const std::uint32_t> triangles) {
    SectionAnswer answer;
    const auto whole = around_section(plane, box);
    answer.clear = true;
    if (!whole) return answer;
    int axis = 0;
    const double size = longest(*whole, axis);
    std::vector<Part> stack;
    stack.push_back(
        {*whole, {candidates.begin(), candidates.end()}, {triangles.begin(), triangles.end()}});
    for (int boxes = 0; !stack.empty(); ++boxes) {
      Part part = std::move(stack.back());
      stack.pop_back();
      if (is_clear(part)) continue;
      const double length = longest(part.box, axis);
      if (boxes >= kMaxBoxes || length < kThinnest * size) return failed_at(part);
      const double middle = 0.5 * part.box.lo[axis] + 0.5 * part.box.hi[axis];
      for (const bool low : {true, false}) {
        Box3 half = part.box;
        (low ? half.hi : half.lo)[axis] = middle;
        if (const auto tight = around_section(plane, half))
          stack.push_back({*tight, part.candidates, part.triangles});
      }
    }
    return answer;
  }

 private:
  /// Shortens the part's lists, too.
  bool is_clear(Part& part) {
    part.triangles = triangles_meeting(geometry_, part.triangles, part.box);
    if (part.triangles.empty() && inside_.locate(part.box.lo) == InsideOracle::Where::kOutside)
      return true;
    part.candidates = engine_.prune(part.candidates, part.box.lo, part.box.hi);
    if (part.candidates.size() <= 1) return true;
    return engine_.tie_groups(part.candidates, part.box.lo, part.box.hi).size() == 1;
  }

  SectionAnswer failed_at(const Part& part) {
    SectionAnswer answer;
    for (int k = 0; k < 3; ++k) answer.near[k] = 0.5 * part.box.lo[k] + 0.5 * part.box.hi[k];
    std::vector<std::pair<double, SiteId>> by_distance;
    for (const SiteId s : part.candidates)
      by_distance.emplace_back(distance_estimate(geometry_, s, answer.near), s);
    std::sort(by_distance.begin(), by_distance.end());
    answer.tie = {by_distance.front().second, by_distance.front().second};
    for (const auto& [d, s] : by_distance)
      if (!engine_.predicates().never_essential(answer.tie[0], s)) {
        answer.tie[1] = s;
        break;
      }
    return answer;
  }

  const SiteGeometry& geometry_;
  ProductionEngine& engine_;
  const InsideOracle& inside_;
};

}  // namespace

SectionAnswer section_misses_axis(const SiteGeometry& geometry, ProductionEngine& engine,
                                  const InsideOracle& inside, const CutPlane& plane,
                                  const Box3& box, std::span<const SiteId> candidates,
                                  std::span<const std::uint32_t> triangles) {
  return Section(geometry, engine, inside).run(plane, box, candidates, triangles);
}

}  // namespace blum
