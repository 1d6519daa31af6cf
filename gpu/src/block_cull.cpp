#include "block_cull.hpp"

#include <algorithm>
#include <cmath>

#include "sample_box.hpp"
#include "scan_block.hpp"
#include "vector3.hpp"

namespace blum::detail {
namespace {

double square(double x) { return x * x; }

/// Can a sample of the box satisfy all conditions?
bool domain_meets(const SampleBox& b, const ScanSite& site, std::span<const Condition> conditions,
                  double margin) {
  const Point3 d = minus(b.centre, site.base);
  for (const Condition& c : conditions) {
    if (dot(c.w, d) - extent_along(b, c.w) > c.limit + margin) return false;
  }
  return true;
}

/// Of a closed edge or face to the box's centre: a lower bound of the distance to any sample, and a
/// point of the site, for an upper bound; `has_point` is false where a face has none at hand.
struct Nearness {
  double lower = 0;
  Point3 point;
  bool has_point = false;
};

Nearness edge_nearness(const SampleBox& b, const ScanSite& s, const ScanSites& sites) {
  const Point3 d = minus(b.centre, s.base);
  const double end = sites.condition[s.first + 1].limit;
  const double t = std::clamp(dot(s.unit, d), 0.0, std::max(0.0, end));
  const Point3 q = {s.base.x + t * s.unit.x, s.base.y + t * s.unit.y, s.base.z + t * s.unit.z};
  return {length(minus(b.centre, q)) - b.radius, q, true};
}

Nearness face_nearness(const SampleBox& b, const ScanSite& s, const ScanSites& sites) {
  const Point3 d = minus(b.centre, s.base);
  const double height = dot(s.unit, d);
  Nearness n;
  n.lower = std::abs(height) - extent_along(b, s.unit);
  for (const Condition& c : sites.conditions(s)) {
    if (dot(c.w, d) > c.limit) return n;
  }
  n.point = minus(b.centre, scaled(height, s.unit));
  n.has_point = true;
  return n;
}

}  // namespace

void BlockCull::filter(CullNode& node, std::span<const Sphere> parents, std::vector<Sphere>& kept,
                       std::vector<double>& scratch) const {
  const SampleBox box = sample_box(node.begin, node.end, grid_);
  double reach2 = square(node.reach);
  for (const Sphere& s : parents) reach2 = std::min(reach2, farthest_squared(box, s.centre));
  node.reach = std::min(node.reach, std::sqrt(reach2));
  const double slack = 4 * sites_.margin;
  // First what the spheres cannot exclude, then what the sites cannot, lowering the reach, and then
  // again with the final reach.
  kept.clear();
  for (const Sphere& s : parents) {
    if (nearest_squared(box, s.centre) <= square(node.reach + s.radius + slack)) kept.push_back(s);
  }
  const auto lower_bound = [&](const Sphere& sphere, const ScanSite& site, Nearness& n) {
    if (site.shape == SiteKind::kVertex) {
      n = {std::sqrt(nearest_squared(box, sphere.centre)), {}, false};
    } else {
      n = site.shape == SiteKind::kEdge ? edge_nearness(box, site, sites_)
                                        : face_nearness(box, site, sites_);
    }
    return n.lower;
  };
  std::size_t n_kept = 0;
  std::vector<double>& lower = scratch;
  lower.clear();
  for (const Sphere& sphere : kept) {
    const ScanSite& site = sites_.site[sphere.site];
    if (!domain_meets(box, site, sites_.conditions(site), sites_.margin)) continue;
    Nearness n;
    if (lower_bound(sphere, site, n) > node.reach + slack) continue;
    if (n.has_point) {
      node.reach = std::min(node.reach, std::sqrt(farthest_squared(box, n.point)));
    }
    lower.push_back(n.lower);
    kept[n_kept++] = sphere;
  }
  std::size_t last = 0;
  for (std::size_t k = 0; k < n_kept; ++k) {
    if (lower[k] <= node.reach + slack) kept[last++] = kept[k];
  }
  kept.resize(last);
}

bool BlockCull::is_block(const CullNode& node) {
  for (int axis = 0; axis < 3; ++axis) {
    if (node.end[axis] - node.begin[axis] > kBlock) return false;
  }
  return true;
}

std::uint64_t BlockCull::blocks_in(const CullNode& node) {
  std::uint64_t blocks = 1;
  for (int axis = 0; axis < 3; ++axis) {
    blocks *= (node.end[axis] - node.begin[axis] + kBlock - 1) / kBlock;
  }
  return blocks;
}

void BlockCull::split(const CullNode& node, std::vector<CullNode>& parts) {
  std::array<std::uint32_t, 3> cut{};
  for (int axis = 0; axis < 3; ++axis) {
    const std::uint32_t blocks = (node.end[axis] - node.begin[axis] + kBlock - 1) / kBlock;
    cut[axis] = blocks < 2 ? node.end[axis] : node.begin[axis] + (blocks + 1) / 2 * kBlock;
  }
  for (int part = 0; part < 8; ++part) {
    CullNode child = node;
    bool is_empty = false;
    for (int axis = 0; axis < 3; ++axis) {
      if ((part >> axis & 1) == 0) {
        child.end[axis] = cut[axis];
      } else {
        child.begin[axis] = cut[axis];
        is_empty |= cut[axis] == node.end[axis];
      }
    }
    if (!is_empty) parts.push_back(child);
  }
}

}  // namespace blum::detail
