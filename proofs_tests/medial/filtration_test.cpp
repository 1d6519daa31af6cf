// The filtration against its slow twin, against its promises, and on complexes whose answer is
// known.

#include "blum/medial/filtration.hpp"

#include <gtest/gtest.h>

#include "blum/medial/medial_axis.hpp"
#include "blum/medial/subcomplex.hpp"
#include "medial/filtration_tools.hpp"
#include "medial/parts_builder.hpp"
#include "subdivision/solid_scenes.hpp"

namespace blum {
namespace {

struct Case {
  std::string name;
  CellComplex complex;
};

CellComplex grid(std::vector<bool> x, std::vector<bool> y, std::vector<bool> z) {
  return fixtures::PlaneGrid{{std::move(x), std::move(y), std::move(z)}}.build();
}

std::vector<Case> small_complexes() {
  std::vector<Case> cases;
  cases.push_back({"one plane", grid({true}, {false, false}, {false})});
  cases.push_back({"a seam", grid({true}, {true}, {false, false})});
  cases.push_back({"a chamber", grid({true, true}, {true, true}, {false})});
  cases.push_back({"a room", grid({true, true}, {true, true}, {true, true})});
  for (const auto& scene : test::scenes()) {
    const auto result = compute_medial_axis(test::solid_of(scene.mesh), test::seeded(1));
    if (result.value().complex.triangle.size() <= 400)
      cases.push_back({scene.name, result.value().complex});
  }
  return cases;
}

const std::vector<Case>& cases() {
  static const std::vector<Case> all = small_complexes();
  return all;
}

bool above(double value, double theta) { return value >= theta; }

TEST(Filtration, SmallComplexes_AgreeWithTrial) {
  for (const Case& c : cases()) {
    if (c.complex.triangle.size() > 130) continue;
    const Parts parts = read_parts(c.complex);
    for (unsigned seed = 1; seed <= 6; ++seed) {
      SCOPED_TRACE(c.name + ", seed " + std::to_string(seed));
      const CellValues cost = test::random_costs(c.complex, parts, seed, seed % 2 == 0 ? 4 : 60);
      const Filtration fast = filter(c.complex, parts, cost);
      const Filtration slow = filter_by_trial(c.complex, parts, cost);
      ASSERT_EQ(fast.step.size(), slow.step.size());
      for (std::size_t k = 0; k < fast.step.size(); ++k) {
        EXPECT_EQ(fast.step[k].cost, slow.step[k].cost) << k;
        EXPECT_EQ(fast.step[k].value, slow.step[k].value) << k;
        EXPECT_EQ(fast.step[k].is_sheet, slow.step[k].is_sheet) << k;
        EXPECT_EQ(fast.step[k].unit, slow.step[k].unit) << k;
      }
      EXPECT_EQ(fast.value.vertex, slow.value.vertex);
      EXPECT_EQ(fast.value.edge, slow.value.edge);
      EXPECT_EQ(fast.value.triangle, slow.value.triangle);
    }
  }
}

TEST(Filtration, EveryStep_IsACollapseThatKeepsTheBettiNumbers) {
  std::size_t steps = 0, sheets = 0;
  for (const Case& c : cases()) {
    const Parts parts = read_parts(c.complex);
    const auto betti = betti_numbers(c.complex);
    for (unsigned seed = 1; seed <= 2; ++seed) {
      SCOPED_TRACE(c.name + ", seed " + std::to_string(seed));
      const Filtration f = filter(c.complex, parts, test::random_costs(c.complex, parts, seed, 12));
      CellMask cells = all_cells(c.complex);
      for (std::size_t k = 0; k < f.step.size(); ++k) {
        const std::size_t end = k + 1 < f.step.size() ? f.step[k + 1].begin : f.collapse.size();
        const auto wrong = replay(c.complex, f.collapse, f.step[k].begin, end, cells);
        ASSERT_FALSE(wrong) << *wrong;
        ++steps;
        sheets += f.step[k].is_sheet;
        if (f.step[k].is_sheet || k % 8 == 0 || k + 1 == f.step.size())
          ASSERT_EQ(betti_numbers(subcomplex(c.complex, cells).complex), betti) << k;
      }
    }
  }
  EXPECT_GT(sheets, 100u);
  EXPECT_GT(steps, sheets + 50);
}

TEST(Filtration, AnyTheta_CellsOfHighCostStayAndNothingCheapIsLeft) {
  for (const Case& c : cases()) {
    const Parts parts = read_parts(c.complex);
    const CellValues cost = test::random_costs(c.complex, parts, 7, 12);
    const Filtration f = filter(c.complex, parts, cost);
    for (std::size_t k = 1; k < f.step.size(); ++k)
      EXPECT_EQ(f.step[k].value, std::max(f.step[k].cost, f.step[k - 1].value));
    const auto never_below = [&](const std::vector<double>& value,
                                 const std::vector<double>& costs) {
      for (std::size_t i = 0; i < value.size(); ++i) EXPECT_GE(value[i], costs[i]) << c.name;
    };
    never_below(f.value.vertex, cost.vertex);
    never_below(f.value.edge, cost.edge);
    never_below(f.value.triangle, cost.triangle);
    for (const double theta : {0.0, 30.0, 90.0, 91.0, 180.0}) {
      // A complex made of K_theta alone, filtered from scratch, loses nothing below theta.
      CellMask left;
      for (const double v : f.value.vertex) left.vertex.push_back(above(v, theta));
      for (const double v : f.value.edge) left.edge.push_back(above(v, theta));
      for (const double v : f.value.triangle) left.triangle.push_back(above(v, theta));
      const Subcomplex part = subcomplex(c.complex, left);
      const Parts its = restricted(parts, part);
      const auto pick = [](const std::vector<double>& values,
                           const std::vector<std::uint32_t>& from) {
        std::vector<double> some;
        for (const auto i : from) some.push_back(values[i]);
        return some;
      };
      const CellValues its_cost{pick(cost.vertex, part.vertex), pick(cost.edge, part.edge),
                                pick(cost.triangle, part.triangle)};
      const Filtration rest = part.complex.triangle.size() <= 60
                                  ? filter_by_trial(part.complex, its, its_cost)
                                  : filter(part.complex, its, its_cost);
      if (!rest.step.empty()) EXPECT_GE(rest.step.front().cost, theta) << c.name;
      // And goes on just as the whole does.
      std::vector<CollapseStep> tail;
      for (const CollapseStep& s : f.step)
        if (s.value >= theta) tail.push_back(s);
      ASSERT_EQ(rest.step.size(), tail.size()) << c.name;
      for (std::size_t k = 0; k < tail.size(); ++k) {
        EXPECT_EQ(rest.step[k].cost, tail[k].cost);
        EXPECT_EQ(rest.step[k].is_sheet, tail[k].is_sheet);
      }
    }
  }
}

TEST(Filtration, SheetSetFreeByADearerOne_KeepsTheHigherValue) {
  // A plane crossed by two others: the strip between the two seams has rims at both its ends, so
  // that it can go only when nothing else is left at one of the seams.
  const CellComplex complex = grid({true}, {true, true}, {false});
  const Parts parts = read_parts(complex);
  CellValues cost;
  cost.vertex.assign(complex.vertex.size(), 0);
  cost.edge.assign(complex.edge.size(), 0);
  cost.triangle.assign(complex.triangle.size(), 50);
  const auto rows = [&] {
    std::vector<std::set<std::uint32_t>> seams(parts.sheets);
    for (std::size_t t = 0; t < complex.triangle.size(); ++t)
      for (const auto e : complex.triangle[t].edge)
        if (parts.edge_seam[e] != Parts::kNoSeam)
          seams[parts.triangle_sheet[t]].insert(parts.edge_seam[e]);
    return seams;
  }();
  std::uint32_t middle = 0, middles = 0;
  for (std::uint32_t s = 0; s < parts.sheets; ++s)
    if (rows[s].size() == 2) {
      middle = s;
      ++middles;
    }
  ASSERT_EQ(middles, 1u);
  for (std::size_t t = 0; t < complex.triangle.size(); ++t)
    if (parts.triangle_sheet[t] == middle) cost.triangle[t] = 10;
  const Filtration f = filter(complex, parts, cost);
  for (std::size_t t = 0; t < complex.triangle.size(); ++t)
    if (parts.triangle_sheet[t] == middle) EXPECT_GE(f.value.triangle[t], 50);
}

TEST(Filtration, DegenerateSeam_StaysAsACurve) {
  // Two planes that cross: four sheets of 90 degrees at a seam of 180.
  const CellComplex complex = grid({true}, {true}, {false, false});
  const Parts parts = read_parts(complex);
  ASSERT_EQ(parts.sheets, 4u);
  ASSERT_EQ(parts.seams, 1u);
  CellValues cost;
  cost.vertex.assign(complex.vertex.size(), 0);
  cost.edge.assign(complex.edge.size(), 0);
  cost.triangle.assign(complex.triangle.size(), 90);
  for (std::size_t e = 0; e < complex.edge.size(); ++e)
    if (parts.edge_seam[e] != Parts::kNoSeam) {
      cost.edge[e] = 180;
      for (const auto v : complex.edge[e].vertex) cost.vertex[v] = 180;
    }
  const Filtration f = filter(complex, parts, cost);
  for (const double v : f.value.triangle) EXPECT_EQ(v, 90);
  for (std::size_t e = 0; e < complex.edge.size(); ++e)
    EXPECT_EQ(f.value.edge[e] >= 180, parts.edge_seam[e] != Parts::kNoSeam);
  EXPECT_EQ(std::count(f.value.vertex.begin(), f.value.vertex.end(), Filtration::kStays), 1);
}

TEST(Filtration, ForgedCollapse_IsRefused) {
  const CellComplex complex = grid({true}, {true}, {false, false});
  const Parts parts = read_parts(complex);
  const Filtration f = filter(complex, parts, test::random_costs(complex, parts, 3, 5));
  ASSERT_GT(f.collapse.size(), 3u);
  const auto verdict = [&](std::vector<ElementaryCollapse> forged) {
    CellMask cells = all_cells(complex);
    return replay(complex, forged, 0, forged.size(), cells);
  };
  EXPECT_FALSE(verdict(f.collapse));
  auto twice = f.collapse;
  twice.insert(twice.begin() + 1, twice.front());
  EXPECT_TRUE(verdict(twice));
  auto late = f.collapse;
  std::swap(late.front(), late.back());
  EXPECT_TRUE(verdict(late));
  auto other = f.collapse;
  other[0].cell = other[1].cell;
  EXPECT_TRUE(verdict(other));
  auto none = f.collapse;
  none[0].dimension = 3;
  EXPECT_TRUE(verdict(none));
  auto inner = f.collapse;
  for (std::uint32_t e = 0; e < complex.edge.size(); ++e)
    if (parts.edge_seam[e] != Parts::kNoSeam) inner[0].face = e;
  EXPECT_TRUE(verdict(inner));
}

}  // namespace
}  // namespace blum
