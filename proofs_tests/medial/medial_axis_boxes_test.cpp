// Random unions of boxes on a small grid: certified, with the Betti numbers counted on the grid.

#include <gtest/gtest.h>

#include "blum/medial/medial_axis.hpp"
#include "patience.hpp"
#include "subdivision/solid_scenes.hpp"

namespace blum {
namespace {

constexpr int kSize = 4;

struct GridBox {
  std::array<int, 3> lo, hi;  // half-open, in cells
};

struct Union {
  std::array<std::array<int, kSize + 1>, 3> level;  // coordinates of the grid's planes
  std::vector<GridBox> boxes;
  std::uint64_t change = 0;  // how the mesh is triangulated and numbered
};

class Grid {
 public:
  explicit Grid(const std::vector<GridBox>& boxes) {
    for (const GridBox& b : boxes)
      for (int i = b.lo[0]; i < b.hi[0]; ++i)
        for (int j = b.lo[1]; j < b.hi[1]; ++j)
          for (int k = b.lo[2]; k < b.hi[2]; ++k) full_[at({i, j, k})] = true;
  }
  [[nodiscard]] bool full(const std::array<int, 3>& c) const {
    for (const int x : c)
      if (x < 0 || x >= kSize) return false;
    return full_[at(c)];
  }
  /// Components (neighbours share a square), tunnels, voids. Requires a manifold boundary.
  [[nodiscard]] std::array<long, 3> betti() const;

 private:
  static std::size_t at(const std::array<int, 3>& c) {
    return static_cast<std::size_t>((c[0] * kSize + c[1]) * kSize + c[2]);
  }
  [[nodiscard]] long components(bool of_solid) const;
  std::array<bool, kSize * kSize * kSize> full_{};
};

/// Of the solid, or of its complement in a grid one cell larger on every side.
long Grid::components(bool of_solid) const {
  std::set<std::array<int, 3>> left;
  for (int i = -1; i <= kSize; ++i)
    for (int j = -1; j <= kSize; ++j)
      for (int k = -1; k <= kSize; ++k)
        if (full({i, j, k}) == of_solid) left.insert({i, j, k});
  long n = 0;
  while (!left.empty()) {
    ++n;
    std::vector<std::array<int, 3>> stack{*left.begin()};
    left.erase(left.begin());
    while (!stack.empty()) {
      const auto c = stack.back();
      stack.pop_back();
      for (std::size_t a = 0; a < 3; ++a)
        for (const int d : {-1, 1}) {
          auto next = c;
          next[a] += d;
          if (left.erase(next) != 0) stack.push_back(next);
        }
    }
  }
  return n;
}

std::array<long, 3> Grid::betti() const {
  // Euler characteristic of the closed union from its cubes, squares, edges and points; cells have
  // doubled coordinates, odd on the axes along which they extend.
  std::set<std::array<int, 3>> cells;
  for (int i = 0; i < kSize; ++i)
    for (int j = 0; j < kSize; ++j)
      for (int k = 0; k < kSize; ++k) {
        if (!full({i, j, k})) continue;
        for (int a = -1; a <= 1; ++a)
          for (int b = -1; b <= 1; ++b)
            for (int c = -1; c <= 1; ++c)
              cells.insert({2 * i + 1 + a, 2 * j + 1 + b, 2 * k + 1 + c});
      }
  long euler = 0;
  for (const auto& c : cells) euler += (c[0] + c[1] + c[2]) % 2 == 0 ? 1 : -1;
  const long b0 = components(true), b2 = components(false) - 1;
  return {b0, b0 + b2 - euler, b2};
}

PolygonMesh mesh_of(const Union& u) {
  const Grid grid(u.boxes);
  PolygonMesh m;
  std::map<std::array<int, 3>, std::uint32_t> point;
  const auto corner = [&](const std::array<int, 3>& c) {
    const auto [it, fresh] = point.try_emplace(c, static_cast<std::uint32_t>(m.points.size()));
    if (fresh)
      m.points.push_back({double(u.level[0][static_cast<std::size_t>(c[0])]),
                          double(u.level[1][static_cast<std::size_t>(c[1])]),
                          double(u.level[2][static_cast<std::size_t>(c[2])])});
    return it->second;
  };
  for (int i = 0; i < kSize; ++i)
    for (int j = 0; j < kSize; ++j)
      for (int k = 0; k < kSize; ++k) {
        const std::array<int, 3> c{i, j, k};
        if (!grid.full(c)) continue;
        for (std::size_t a = 0; a < 3; ++a)
          for (const int d : {0, 1}) {
            auto beside = c;
            beside[a] += d == 0 ? -1 : 1;
            if (grid.full(beside)) continue;
            const std::size_t b = (a + 1) % 3, e = (a + 2) % 3;
            std::vector<std::uint32_t> face;
            for (const auto& [s, t] : {std::pair{0, 0}, {1, 0}, {1, 1}, {0, 1}}) {
              auto p = c;
              p[a] += d;
              p[b] += s;
              p[e] += t;
              face.push_back(corner(p));
            }
            if (d == 0) std::reverse(face.begin(), face.end());
            m.faces.push_back(std::move(face));
          }
      }
  if (u.change % 4 == 1) return m;
  m = shapes::triangulate_facets(m, u.change);
  return u.change % 4 == 0 ? m : shapes::shuffle(m, u.change);
}

Union random_union(std::uint64_t seed) {
  std::mt19937_64 random(seed);
  const auto below = [&](int n) { return static_cast<int>(random() % static_cast<unsigned>(n)); };
  Union u;
  u.change = random();
  const bool even = below(2) == 0;  // equal steps: more ties
  for (auto& axis : u.level) {
    axis[0] = 0;
    for (std::size_t k = 1; k <= kSize; ++k) axis[k] = axis[k - 1] + (even ? 1 : 1 + below(5));
  }
  for (int n = 1 + below(6); n > 0; --n) {
    GridBox b;
    for (std::size_t a = 0; a < 3; ++a) {
      b.lo[a] = below(kSize);
      b.hi[a] = b.lo[a] + 1 + below(kSize - b.lo[a]);
    }
    u.boxes.push_back(b);
  }
  return u;
}

/// Empty: as it should be.
std::string fault(const Union& u, std::uint64_t seed, bool resolve) {
  const auto solid = build_solid(mesh_of(u));
  if (!solid) return "";
  MedialOptions o;
  o.seed = seed;
  o.resolve = resolve;
  o.time_limit_s = test::patience_s(60);
  try {
    const auto r = compute_medial_axis(solid.value(), o);
    if (!r) return "error: " + r.error().message;
    if (!r.value().certified) return "not certified";
    const auto expected = Grid(u.boxes).betti();
    if (solid.value().betti() != expected) return "Betti numbers of the solid";
    if (r.value().betti != expected) return "Betti numbers of the axis";
  } catch (const std::exception& e) {
    return std::string("exception: ") + e.what();
  }
  return "";
}

/// Without boxes, and with smaller steps, as long as it still fails.
Union shrunk(Union u, std::uint64_t seed, bool resolve) {
  for (bool smaller = true; smaller;) {
    smaller = false;
    for (std::size_t k = 0; k < u.boxes.size() && !smaller; ++k) {
      Union less = u;
      less.boxes.erase(less.boxes.begin() + static_cast<std::ptrdiff_t>(k));
      if (less.boxes.empty() || fault(less, seed, resolve).empty()) continue;
      u = less;
      smaller = true;
    }
  }
  return u;
}

/// Returns how many of the unions were solids.
int check_unions(std::uint64_t first, int wanted, bool resolve) {
  int solids = 0, failures = 0;
  for (std::uint64_t k = first; solids < wanted && failures < 5; ++k) {
    const Union u = random_union(k);
    if (!build_solid(mesh_of(u))) continue;
    ++solids;
    const std::string what = fault(u, k, resolve);
    if (what.empty()) continue;
    ++failures;
    const Union small = shrunk(u, k, resolve);
    ADD_FAILURE() << "union " << k << (resolve ? ", resolved" : "") << ": " << what
                  << "; shrunk: " << fault(small, k, resolve) << "\n"
                  << test::as_off(mesh_of(small));
  }
  return solids;
}

TEST(BoxUnions, OnASmallGrid_AreCertifiedWithTheGridsBettiNumbers) {
  EXPECT_EQ(check_unions(1, 25, false), 25);
}

TEST(BoxUnions, Resolved_AreCertifiedWithTheGridsBettiNumbers) {
  EXPECT_EQ(check_unions(5001, 8, true), 8);
}

TEST(SweepBoxUnions, OnASmallGrid_AreCertifiedWithTheGridsBettiNumbers) {
  EXPECT_EQ(check_unions(100'000, 1000, false), 1000);
}

TEST(SweepBoxUnions, Resolved_AreCertifiedWithTheGridsBettiNumbers) {
  EXPECT_EQ(check_unions(200'000, 200, true), 200);
}

TEST(BoxUnions, TestGrid_CountsKnownShapes) {
  const GridBox all{{0, 0, 0}, {3, 3, 3}};
  EXPECT_EQ(Grid({all}).betti(), (std::array<long, 3>{1, 0, 0}));
  const std::vector<GridBox> ring{{{0, 0, 0}, {3, 1, 1}},
                                  {{0, 2, 0}, {3, 3, 1}},
                                  {{0, 0, 0}, {1, 3, 1}},
                                  {{2, 0, 0}, {3, 3, 1}}};
  EXPECT_EQ(Grid(ring).betti(), (std::array<long, 3>{1, 1, 0}));
  auto shell = ring;
  shell.push_back({{0, 0, 2}, {3, 3, 3}});
  for (auto b : ring) {
    b.lo[2] = 1;
    b.hi[2] = 2;
    shell.push_back(b);
  }
  EXPECT_EQ(Grid(shell).betti(), (std::array<long, 3>{1, 0, 0}));
  shell.push_back({{0, 0, 0}, {3, 3, 1}});
  EXPECT_EQ(Grid(shell).betti(), (std::array<long, 3>{1, 0, 1}));
}

}  // namespace
}  // namespace blum
