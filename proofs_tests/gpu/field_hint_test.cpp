// A coarse field as hints for subdivision: right whatever the ids, and without influence on the
// axis.
#include "blum/gpu/field_hint.hpp"

#include <gtest/gtest.h>

#include <iostream>

#include "blum/kernel/shapes.hpp"
#include "blum/kernel/site_tree.hpp"
#include "blum/medial/medial_axis.hpp"
#include "gl_tools.hpp"
#include "medial/axis_tools.hpp"

namespace blum {
namespace {

struct Hinted {
  Solid solid;
  SiteSet sites;
  DistanceField field;
};

Hinted hinted(const PolygonMesh& mesh) {
  const SiteSet sites = test::sites_of(soup_of(mesh));
  return {build_solid(mesh).value(), sites,
          test::field_of(sites, test::grid_around(sites, {12, 12, 12}))};
}

/// A driver gone wrong: random ids, some of them no sites at all.
DistanceField corrupted(DistanceField field, const SiteSet& sites) {
  std::mt19937_64 random(1);
  for (std::uint32_t& s : field.site) {
    s = static_cast<std::uint32_t>(random() % (2 * sites.size()));
  }
  return field;
}

TEST(FieldHint, IsAnUpperBound_WithAnyIds) {
  for (const PolygonMesh& mesh :
       {shapes::lpocket(), shapes::rotate_rounded(shapes::plate(1, 6), 2)}) {
    const Hinted h = hinted(mesh);
    const SiteTree tree(h.solid);
    for (const DistanceField& field : {h.field, corrupted(h.field, h.sites)}) {
      const DistanceHint hint = field_hint(h.sites, field, h.solid.frame);
      std::mt19937_64 random(2);
      std::uniform_real_distribution<double> coordinate(-2, 2);
      double excess = 0;
      for (int n = 0; n < 2000; ++n) {
        const Point3 q = {coordinate(random), coordinate(random), coordinate(random)};
        const SquaredDistanceBounds d = tree.squared_distance(q);
        EXPECT_GE(hint(q) * hint(q) * (1 + 1e-15), d.lo);
        if (std::isfinite(hint(q))) excess = std::max(excess, hint(q) - std::sqrt(d.lo));
      }
      EXPECT_GT(excess, 0);
    }
  }
}

TEST(FieldHint, AxisIsTheSame_WithHintsCorruptedHintsAndNone) {
  for (const PolygonMesh& mesh :
       {shapes::lbracket(), shapes::lpocket(), shapes::torus(6, 4, 2, 0.75)}) {
    const Hinted h = hinted(mesh);
    MedialOptions options;
    const auto plain = compute_medial_axis(h.solid, options);
    ASSERT_TRUE(plain.ok());
    std::vector<DistanceField> fields = {h.field, corrupted(h.field, h.sites)};
    for (const FieldBackend backend : test::kGlBackends) {
      FieldOptions gl;
      gl.backend = backend;
      if (field_driver(backend)) fields.push_back(test::field_of(h.sites, h.field.grid, gl));
    }
    if (fields.size() == 2) std::cout << "no OpenGL driver: no hints from one\n";
    for (const DistanceField& field : fields) {
      options.distance_hint = field_hint(h.sites, field, h.solid.frame);
      const auto seeded = compute_medial_axis(h.solid, options);
      ASSERT_TRUE(seeded.ok());
      EXPECT_EQ(seeded.value().certified, plain.value().certified);
      EXPECT_EQ(test::difference(plain.value().complex, seeded.value().complex), "");
    }
  }
}

}  // namespace
}  // namespace blum
