// Where the checker can neither follow nor refute a certificate it says that, and not that it is
// false.
#include "certificates.hpp"
#include "shape.hpp"

namespace blum::test {
namespace {

using Outcome = verify::Answer::Outcome;
using Records = std::vector<Json>;

/// A bar whose facets have more sites than exact algebra is asked for, and a cell that ends in a
/// plane across it. That face has the parts given; what follows is never read.
struct Bar {
  Certified c;
  Box3 box;  ///< of the bar
  Bar()
      : c("bar", shapes::triangulate_facets(
                     shapes::split_edges(shapes::split_edges(shapes::cuboid(4, 1, 2), 1), 2), 1)) {
    box.lo = box.hi = c.point[0];
    for (const Point3& p : c.point)
      for (int k = 0; k < 3; ++k) {
        box.lo[k] = std::min(box.lo[k], p[k]);
        box.hi[k] = std::max(box.hi[k], p[k]);
      }
  }
  /// With the claim of the one part.
  [[nodiscard]] verify::Answer with(const Json& claim) const {
    const auto face = [](const Json& part) {
      const Json none = Json::array();
      return Json{{"parts", Json::array({part})}, {"graph", {{"events", none}, {"arcs", none}}}};
    };
    const Json outside = face(Json::array({"outside"}));
    Records r{c.record[0]};
    const double level = box.lo.x + 0.40625 * (box.hi.x - box.lo.x);
    r.push_back({{"node", {{"axis", 0}, {"cut", level}, {"excluded", Json::array()}}}});
    r.push_back({{"leaf",
                  {{"theorem", "boundary"},
                   {"excluded", Json::array()},
                   {"faces", {outside, face(claim), outside, outside, outside, outside}}}}});
    return check(c, r);
  }
  [[nodiscard]] Json star() const {
    const verify::Shape shape(c.point, c.triangle);
    return Json::array({"star", shape.candidates(), Json::array()});
  }
};

TEST(VerifyNotShown, StarThatDoesNotHold_CalledFalse) {
  const Bar bar;
  const verify::Answer answer = bar.with(bar.star());
  EXPECT_EQ(answer.outcome, Outcome::kFalse);
  EXPECT_TRUE(answer.statement.starts_with("face: ")) << answer.statement;
  EXPECT_EQ(answer.line, 3u);
}

TEST(VerifyNotShown, PartOfMoreSitesThanExactAlgebraIsAskedFor_NotCalledFalse) {
  const Bar bar;
  ASSERT_GT(bar.star()[1].size(), 16u);
  const verify::Answer answer = bar.with(Json::array({"exact", bar.star()}));
  EXPECT_EQ(answer.outcome, Outcome::kFalse);
  EXPECT_TRUE(answer.statement.starts_with("not shown: a part that only exact algebra"))
      << answer.statement;
  EXPECT_EQ(answer.line, 3u);
}

}  // namespace
}  // namespace blum::test
