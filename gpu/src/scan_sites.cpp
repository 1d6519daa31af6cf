#include "scan_sites.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>
#include <unordered_map>
#include <utility>

#include "unit_normal.hpp"
#include "vector3.hpp"

namespace blum::detail {
namespace {

constexpr std::uint32_t kNone = std::numeric_limits<std::uint32_t>::max();

/// Of a triangle: what its sides and the sides' ends need to know.
struct Plane {
  Point3 normal;
  bool is_thin = true;
  double longest = 0;
};

class Builder {
 public:
  Builder(const SiteSet& set, const Box3& samples, bool domains, double unit_roundoff)
      : set_(set), domains_(domains) {
    for (int axis = 0; axis < 3; ++axis) {
      const double lo = std::min(set.box().lo[axis], samples.lo[axis]);
      const double hi = std::max(set.box().hi[axis], samples.hi[axis]);
      out_.reach += (hi - lo) * (1 + 0x1p-50);
    }
    contraction_ = 64 * unit_roundoff * out_.reach;
    out_.margin = 128 * unit_roundoff * out_.reach;
    dilation_ = 8 * out_.margin;
  }

  ScanSites build() {
    make_planes();
    if (domains_) make_incidences();
    for (std::uint32_t v = 0; v < set_.points().size(); ++v) {
      if (set_.is_used(v)) add_vertex(v);
    }
    const auto edges = static_cast<std::uint32_t>(set_.edges().size());
    for (std::uint32_t e = 0; e < edges; ++e) add_edge(set_.edges()[e], set_.edge(e), e);
    std::size_t d = 0;
    for (std::uint32_t t = 0; t < planes_.size(); ++t) {
      const std::uint32_t polygon = set_.triangles()[t].polygon;
      add_triangle(t);
      const bool is_last = t + 1 == planes_.size() || set_.triangles()[t + 1].polygon != polygon;
      for (; is_last && d < set_.diagonals().size() && set_.diagonals()[d].polygon == polygon;
           ++d) {
        add_edge(set_.diagonals()[d].point, set_.polygon(polygon),
                 edges + static_cast<std::uint32_t>(d));
      }
    }
    return std::move(out_);
  }

 private:
  [[nodiscard]] const Point3& point(std::uint32_t v) const { return set_.points()[v]; }

  void make_planes() {
    planes_.reserve(set_.triangles().size());
    for (const SiteSet::Triangle& t : set_.triangles()) {
      const Point3 &a = point(t.point[0]), &b = point(t.point[1]), &c = point(t.point[2]);
      Plane plane;
      plane.longest = std::max({length(minus(b, a)), length(minus(c, b)), length(minus(a, c))});
      if (const auto normal = unit_normal(a, b, c)) {
        plane.normal = *normal;
        plane.is_thin = false;
      } else {
        out_.dropped = std::max(out_.dropped, kThinTriangle * plane.longest);
      }
      planes_.push_back(plane);
    }
  }

  /// Edges (diagonals after them) at each point, triangles at each edge, in compressed rows.
  void make_incidences() {
    std::vector<std::array<std::uint32_t, 2>> links(set_.edges().begin(), set_.edges().end());
    for (const SiteSet::Diagonal& d : set_.diagonals()) links.push_back(d.point);
    at_point_.assign(set_.points().size(), {});
    edge_count_.assign(set_.points().size(), 0);
    std::unordered_map<std::uint64_t, std::uint32_t> number;
    std::vector<std::uint32_t> next(links.size(), kNone);
    for (std::uint32_t e = 0; e < links.size(); ++e) {
      for (int end = 0; end < 2; ++end) {
        const std::uint32_t v = links[e][end], w = links[e][1 - end];
        if (edge_count_[v] < kMostConditions && length(minus(point(w), point(v))) >= dilation_) {
          at_point_[v][edge_count_[v]++] = w;
        }
      }
      // A diagonal may run along an edge, or several polygons' diagonals along each other: chained.
      const auto [at, is_new] = number.emplace(key(links[e][0], links[e][1]), e);
      if (!is_new) {
        next[e] = at->second;
        at->second = e;
      }
    }
    at_edge_.assign(links.size(), {kNone, kNone, kNone, kNone});
    for (std::uint32_t t = 0; t < set_.triangles().size(); ++t) {
      const auto& v = set_.triangles()[t].point;
      for (int k = 0; k < 3; ++k) {
        const auto at = number.find(key(v[k], v[(k + 1) % 3]));
        if (at == number.end()) continue;  // a side between points at one place
        for (std::uint32_t e = at->second; e != kNone; e = next[e]) {
          const auto free = std::ranges::find(at_edge_[e], kNone);
          if (free != at_edge_[e].end()) *free = t;
        }
      }
    }
  }

  [[nodiscard]] static std::uint64_t key(std::uint32_t a, std::uint32_t b) {
    return std::uint64_t{std::min(a, b)} << 32 | std::max(a, b);
  }

  ScanSite& begin_site(SiteKind shape, SiteId id, const Point3& base, const Sphere& sphere) {
    ScanSite s;
    s.shape = shape;
    s.id = id.value;
    s.base = base;
    s.first = static_cast<std::uint32_t>(out_.condition.size());
    out_.site.push_back(s);
    out_.sphere.push_back(sphere);
    out_.sphere.back().rank = static_cast<std::uint32_t>(out_.site.size() - 1);
    return out_.site.back();
  }
  void add_condition(const Point3& w, double limit) {
    out_.condition.push_back({w, limit});
    ++out_.site.back().count;
  }

  void add_vertex(std::uint32_t v) {
    begin_site(SiteKind::kVertex, set_.vertex(v), point(v), {point(v), 0, 0, 0});
    if (!domains_) return;
    for (std::uint32_t k = 0; k < edge_count_[v]; ++k) {
      add_condition(unit(minus(point(at_point_[v][k]), point(v))), dilation_);
    }
  }

  void add_edge(const std::array<std::uint32_t, 2>& ends, SiteId id, std::uint32_t link) {
    const Point3 &a = point(ends[0]), &b = point(ends[1]);
    const Point3 along = minus(b, a);
    const Point3 middle = {a.x + 0.5 * along.x, a.y + 0.5 * along.y, a.z + 0.5 * along.z};
    ScanSite& s =
        begin_site(SiteKind::kEdge, id, a, {middle, sphere_radius(middle, {a, b, b}), 0, 0});
    const Point3 u = unit(along);
    s.unit = u;
    add_condition(scaled(-1, u), -contraction_);
    add_condition(u, dot(u, along) - contraction_);
    if (!domains_) return;
    for (const std::uint32_t t : at_edge_[link]) {
      if (t != kNone) add_side_of_triangle(t, ends, u);
    }
  }

  /// Samples on the inner side of a triangle at the edge are nearer to that triangle.
  void add_side_of_triangle(std::uint32_t t, const std::array<std::uint32_t, 2>& ends,
                            const Point3& along) {
    const Plane& plane = planes_[t];
    if (plane.is_thin) return;
    const auto& v = set_.triangles()[t].point;
    const auto third =
        std::ranges::find_if(v, [&](std::uint32_t x) { return x != ends[0] && x != ends[1]; });
    if (third == v.end()) return;
    Point3 w = cross(plane.normal, along);
    double height = dot(w, minus(point(*third), point(ends[0])));
    if (height < 0) {
      w = scaled(-1, w);
      height = -height;
    }
    // Why thin triangles need more: docs/fields.md. (Where they would need all of their height they
    // are of no use.)
    if (height * height >= 2 * dilation_ * plane.longest) {
      add_condition(w, dilation_ * (plane.longest / height));
    }
  }

  void add_triangle(std::uint32_t t) {
    const Plane& plane = planes_[t];
    if (plane.is_thin) return;
    const auto& v = set_.triangles()[t].point;
    const std::array<Point3, 3> p = {point(v[0]), point(v[1]), point(v[2])};
    const Point3 middle = {p[0].x + ((p[1].x - p[0].x) + (p[2].x - p[0].x)) / 3,
                           p[0].y + ((p[1].y - p[0].y) + (p[2].y - p[0].y)) / 3,
                           p[0].z + ((p[1].z - p[0].z) + (p[2].z - p[0].z)) / 3};
    ScanSite& s = begin_site(SiteKind::kFace, set_.polygon(set_.triangles()[t].polygon), p[0],
                             {middle, sphere_radius(middle, p), 0, 0});
    s.unit = plane.normal;
    for (int k = 0; k < 3; ++k) {
      const Point3 w = cross(unit(minus(p[(k + 1) % 3], p[k])), plane.normal);  // outwards
      add_condition(w, dot(w, minus(p[k], p[0])) - contraction_);
    }
  }

  [[nodiscard]] double sphere_radius(const Point3& middle, const std::array<Point3, 3>& p) const {
    double radius = 0;
    for (const Point3& q : p) radius = std::max(radius, length(minus(q, middle)));
    return radius + contraction_;
  }

  const SiteSet& set_;
  bool domains_;
  double contraction_ = 0, dilation_ = 0;
  ScanSites out_;
  std::vector<Plane> planes_;
  std::vector<std::array<std::uint32_t, kMostConditions>> at_point_;
  std::vector<std::uint8_t> edge_count_;
  std::vector<std::array<std::uint32_t, 4>> at_edge_;
};

/// Place of a point along a Z-shaped curve through 2^10 cells an axis of the box.
std::uint32_t curve_place(const Point3& p, const Box3& box) {
  std::uint32_t place = 0;
  for (int axis = 0; axis < 3; ++axis) {
    const double width = box.hi[axis] - box.lo[axis];
    const double t = width > 0 ? (p[axis] - box.lo[axis]) / width : 0;
    const auto cell = static_cast<std::uint32_t>(std::clamp(t * 1024, 0.0, 1023.0));
    for (int bit = 0; bit < 10; ++bit) place |= (cell >> bit & 1) << (3 * bit + axis);
  }
  return place;
}

void sort_along_curve(ScanSites& sites, const Box3& box) {
  std::vector<std::pair<std::uint32_t, std::uint32_t>> order;
  order.reserve(sites.site.size());
  for (const Sphere& s : sites.sphere) order.emplace_back(curve_place(s.centre, box), s.rank);
  std::ranges::sort(order);
  std::vector<ScanSite> site;
  std::vector<Sphere> sphere;
  std::vector<Condition> condition;
  site.reserve(order.size());
  sphere.reserve(order.size());
  condition.reserve(sites.condition.size());
  for (const auto& [place, rank] : order) {
    sphere.push_back(sites.sphere[rank]);
    sphere.back().site = static_cast<std::uint32_t>(site.size());
    site.push_back(sites.site[rank]);
    const auto conditions = sites.conditions(sites.site[rank]);
    site.back().first = static_cast<std::uint32_t>(condition.size());
    condition.insert(condition.end(), conditions.begin(), conditions.end());
  }
  sites.site = std::move(site);
  sites.sphere = std::move(sphere);
  sites.condition = std::move(condition);
}

}  // namespace

ScanSites make_scan_sites(const SiteSet& set, const Box3& samples, bool domains, double unit) {
  ScanSites sites = Builder(set, samples, domains, unit).build();
  sort_along_curve(sites, set.box());
  return sites;
}

}  // namespace blum::detail
