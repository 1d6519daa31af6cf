#include <algorithm>

#include "blum/kernel/check.hpp"
#include "blum/kernel/union_find.hpp"
#include "exact_geometry.hpp"
#include "inside_columns.hpp"
#include "validate_surface.hpp"

namespace blum {

void find_shells(std::span<const Point3> points, Surface& surface, DefectCollector& defects) {
  const auto& triangle = surface.triangle;
  const auto triangles = static_cast<std::uint32_t>(triangle.size());
  // A shell is what hangs together by vertices, which in a manifold is the same as by edges.
  UnionFind joined;
  joined.resize(static_cast<std::uint32_t>(points.size()));
  for (const auto& t : triangle) {
    joined.unite(t[0], t[1]);
    joined.unite(t[1], t[2]);
  }
  constexpr std::uint32_t kNone = ~0u;
  std::vector<std::uint32_t> shell_of_root(points.size(), kNone);
  surface.shell_of_triangle.resize(triangles);
  std::vector<std::vector<exact::Triangle>> soup;
  std::vector<exact::Triangle> all;
  for (std::uint32_t i = 0; i < triangles; ++i) {
    const auto& t = triangle[i];
    std::uint32_t& shell = shell_of_root[joined.find(t[0])];
    if (shell == kNone) {
      shell = static_cast<std::uint32_t>(surface.shell.size());
      surface.shell.push_back({i, 0, 0});
      soup.emplace_back();
    }
    surface.shell_of_triangle[i] = shell;
    all.push_back({points[t[0]], points[t[1]], points[t[2]]});
    soup[shell].push_back(all.back());
  }
  const std::size_t shells = surface.shell.size();

  // Around shell s are the shells that a ray from one of its vertices crosses an odd number of
  // times. The ray may cross s itself and touch it at its start: only other shells count.
  std::vector<std::vector<std::uint32_t>> around(shells);
  if (shells > 1) {
    const Columns columns(std::move(all));
    std::vector<std::uint32_t> crossings;
    for (std::uint32_t s = 0; s < shells; ++s) {
      crossings.clear();
      const Point3& p = points[triangle[surface.shell[s].first_triangle][0]];
      columns.cast_up_past(p, [&](std::uint32_t t) {
        if (surface.shell_of_triangle[t] != s) crossings.push_back(surface.shell_of_triangle[t]);
      });
      std::sort(crossings.begin(), crossings.end());
      for (std::size_t i = 0; i < crossings.size();) {
        std::size_t j = i;
        while (j < crossings.size() && crossings[j] == crossings[i]) ++j;
        if ((j - i) % 2 == 1) around[s].push_back(crossings[i]);
        i = j;
      }
      surface.shell[s].depth = static_cast<std::uint32_t>(around[s].size());
    }
  }

  std::vector<bool> contrary(shells);
  for (std::size_t s = 0; s < shells; ++s) {
    const int outward = surface.shell[s].depth % 2 == 0 ? 1 : -1;
    const int volume = exact::volume_sign(soup[s]);
    BLUM_CHECK(volume != 0);
    contrary[s] = volume != outward;
  }
  surface.inverted = std::all_of(contrary.begin(), contrary.end(), [](bool c) { return c; });
  const auto report = [&](DefectKind kind, std::size_t s) {
    const std::uint32_t t = surface.shell[s].first_triangle;
    defects.add(kind, {surface.face_of_triangle[t]}, std::array{triangle[t][0]});
  };
  for (std::size_t s = 0; s < shells; ++s) {
    if (surface.inverted)
      report(DefectKind::kInvertedSolid, s);
    else if (contrary[s])
      report(DefectKind::kShellNesting, s);
  }

  surface.components = 0;
  for (SurfaceShell& s : surface.shell) {
    if (s.depth % 2 == 0) s.component = surface.components++;
  }
  for (std::size_t s = 0; s < shells; ++s) {
    if (surface.shell[s].depth % 2 == 0) continue;
    for (const std::uint32_t o : around[s]) {
      if (surface.shell[o].depth + 1 == surface.shell[s].depth) {
        surface.shell[s].component = surface.shell[o].component;
      }
    }
  }
}

}  // namespace blum
