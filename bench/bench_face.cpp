// Face diagrams of the production engine by number of candidate sites: rectangles of random place
// and size in a few solids, pruned as the subdivision prunes them. Budget (issue 2): up to 4
// governors in tens of microseconds, 8 in 0.2 ms. Counters: share of the decisions by stage, boxes
// a face, faces that were not decided.

#include <benchmark/benchmark.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <memory>
#include <random>
#include <vector>

#include "blum/arrangement/production_engine.hpp"
#include "blum/kernel/shapes.hpp"

namespace {

using namespace blum;

constexpr std::size_t kMost = 8;       // candidates
constexpr std::size_t kProblems = 64;  // of each number of candidates, shared among the solids
constexpr int kAttempts = 200'000;     // rectangles tried a solid
constexpr std::uint64_t kSeed = 1;

struct Problem {
  ProductionEngine* engine = nullptr;
  const Solid* solid = nullptr;
  Rect rect;
  std::vector<SiteId> candidates;
  std::vector<std::uint32_t> triangles;
  std::array<std::shared_ptr<const SegmentDiagram>, 4> side;

  [[nodiscard]] FaceDiagram solve() const {
    return engine->face(FaceProblem{solid, rect, candidates, triangles}, side);
  }
};

/// One solid with its engine, at fixed addresses.
struct Setting {
  explicit Setting(const PolygonMesh& mesh)
      : solid(build_solid(mesh).value()),
        geometry(solid),
        inside(solid),
        engine(geometry, inside, kSeed) {}
  Solid solid;
  SiteGeometry geometry;
  InsideOracle inside;
  ProductionEngine engine;
};

Point3 corner(const Rect& r, double u, double v) { return point_on(r.axis, r.level, u, v); }

/// Triangles whose boxes meet the rectangle: a superset of those that do.
std::vector<std::uint32_t> triangles_near(const Solid& solid, const Rect& r) {
  const Point3 lo = corner(r, r.u0, r.v0), hi = corner(r, r.u1, r.v1);
  std::vector<std::uint32_t> near;
  for (std::uint32_t t = 0; t < solid.triangle.size(); ++t) {
    bool meets = true;
    for (int axis = 0; axis < 3; ++axis) {
      const auto& v = solid.triangle[t].vertex;
      const auto [least, most] =
          std::minmax({solid.point[v[0]][axis], solid.point[v[1]][axis], solid.point[v[2]][axis]});
      meets = meets && least <= hi[axis] && most >= lo[axis];
    }
    if (meets) near.push_back(t);
  }
  return near;
}

class Problems {
 public:
  Problems() {
    settings_.push_back(std::make_unique<Setting>(shapes::knot()));
    settings_.push_back(std::make_unique<Setting>(shapes::torus(12, 6, 2, 0.75)));
    settings_.push_back(std::make_unique<Setting>(shapes::rotate_rounded(shapes::lpocket(), 1)));
    settings_.push_back(std::make_unique<Setting>(shapes::plate(2, 7)));
    for (std::size_t s = 0; s < settings_.size(); ++s) {
      collect(*settings_[s], kProblems * (s + 1) / settings_.size());
    }
  }
  [[nodiscard]] const std::vector<Problem>& of(std::size_t candidates) const {
    return problems_[candidates];
  }

 private:
  void collect(Setting& s, std::size_t wanted) {
    std::mt19937_64 random(kSeed);
    const auto uniform = [&](double lo, double hi) {
      return lo + (hi - lo) * static_cast<double>(random() >> 11) * 0x1p-53;
    };
    for (int attempt = 0; attempt < kAttempts; ++attempt) {
      Problem p;
      p.engine = &s.engine;
      p.solid = &s.solid;
      p.rect.axis = static_cast<int>(random() % 3);
      // About a random point of the surface, since most of the box may lie outside the solid.
      const auto& corners = s.solid.triangle[random() % s.solid.triangle.size()].vertex;
      const Point3& near = s.solid.point[corners[random() % 3]];
      const double size = std::exp2(uniform(-6, -2));
      p.rect.level = near[p.rect.axis] + uniform(-0.2, 0.2);
      p.rect.u0 = near[u_axis(p.rect.axis)] + uniform(-0.2, 0.2);
      p.rect.v0 = near[v_axis(p.rect.axis)] + uniform(-0.2, 0.2);
      p.rect.u1 = p.rect.u0 + size * uniform(0.6, 1);
      p.rect.v1 = p.rect.v0 + size * uniform(0.6, 1);
      const Point3 lo = corner(p.rect, p.rect.u0, p.rect.v0);
      const Point3 hi = corner(p.rect, p.rect.u1, p.rect.v1);
      if (s.inside.locate(lo) != InsideOracle::Where::kInside) continue;
      p.candidates = s.engine.prune(s.geometry.candidates(), lo, hi);
      const std::size_t k = p.candidates.size();
      if (k < 2 || k > kMost || problems_[k].size() >= wanted) continue;
      p.triangles = triangles_near(s.solid, p.rect);
      bool decided = true;
      for (int side = 0; side < 4 && decided; ++side) {
        const SegmentAnswer answer =
            s.engine.segment(side_segment(p.rect, side), p.candidates, p.triangles);
        decided = answer.status == FaceStatus::kDecided;
        p.side[static_cast<std::size_t>(side)] = answer.diagram;
      }
      if (decided && !p.solve().arc.empty()) problems_[k].push_back(std::move(p));
    }
  }

  std::vector<std::unique_ptr<Setting>> settings_;
  std::array<std::vector<Problem>, kMost + 1> problems_;
};

const Problems& problems() {
  static const Problems all;
  return all;
}

struct Work {
  double filter = 0, extended = 0, exact = 0, boxes = 0;
};

Work work(const std::vector<Problem>& list) {
  Work w;
  std::vector<ProductionEngine*> seen;
  for (const Problem& p : list) {
    if (std::find(seen.begin(), seen.end(), p.engine) != seen.end()) continue;
    seen.push_back(p.engine);
    const StageCounts& stages = p.engine->predicates().stages();
    w.filter += static_cast<double>(stages.filter);
    w.extended += static_cast<double>(stages.extended);
    w.exact += static_cast<double>(stages.exact);
    w.boxes += static_cast<double>(p.engine->counts().boxes);
  }
  return w;
}

void report(benchmark::State& state, const Work& before, const Work& after, double faces) {
  const double filter = after.filter - before.filter, extended = after.extended - before.extended,
               exact = after.exact - before.exact;
  const double all = std::max(1.0, filter + extended + exact);
  state.counters["decisions"] = (filter + extended + exact) / faces;
  state.counters["filter"] = filter / all;
  state.counters["extended"] = extended / all;
  state.counters["exact"] = exact / all;
  state.counters["boxes"] = (after.boxes - before.boxes) / faces;
}

/// Interior of the face only; its sides are shared with other faces and timed apart.
void face(benchmark::State& state) {
  const std::vector<Problem>& list = problems().of(static_cast<std::size_t>(state.range(0)));
  if (list.empty()) {
    state.SkipWithError("no such face found");
    return;
  }
  const Work before = work(list);
  std::size_t i = 0, undecided = 0;
  for (auto _ : state) {
    const FaceDiagram diagram = list[i].solve();
    undecided += diagram.status == FaceStatus::kDecided ? 0 : 1;
    benchmark::DoNotOptimize(diagram);
    i = (i + 1) % list.size();
  }
  report(state, before, work(list), static_cast<double>(state.iterations()));
  state.counters["problems"] = static_cast<double>(list.size());
  state.counters["undecided"] =
      static_cast<double>(undecided) / static_cast<double>(state.iterations());
}

void side(benchmark::State& state) {
  const std::vector<Problem>& list = problems().of(static_cast<std::size_t>(state.range(0)));
  if (list.empty()) {
    state.SkipWithError("no such face found");
    return;
  }
  const Work before = work(list);
  std::size_t i = 0;
  for (auto _ : state) {
    const Problem& p = list[i / 4 % list.size()];
    benchmark::DoNotOptimize(p.engine->segment(side_segment(p.rect, static_cast<int>(i % 4)),
                                               p.candidates, p.triangles));
    ++i;
  }
  report(state, before, work(list), static_cast<double>(state.iterations()));
}

BENCHMARK(face)->DenseRange(2, kMost)->ArgName("candidates")->Unit(benchmark::kMicrosecond);
BENCHMARK(side)->DenseRange(2, kMost)->ArgName("candidates")->Unit(benchmark::kMicrosecond);

}  // namespace
