/// Which of two sites gains on the other along a direction (docs/proofs.md, Theorem D', D'',
/// "Fans").
#pragma once

#include "groups.hpp"

namespace blum::verify {

/// Does a gain on b along w, wherever in the box both govern? `feet`: of a list of sites that holds
/// all governors of box ∩ O.
[[nodiscard]] bool gains(const Exclusion& exclusion, const Box3& box, const SharedFeet& feet,
                         Site a, Site b, const Vec<Rational>& w);

/// False: no point of box ∩ O has both for governors with different feet. Sites of two groups that
/// never tie essentially govern no point together (Lemma 1).
[[nodiscard]] bool may_both_govern(const Exclusion& exclusion, const Box3& box, Site a, Site b);

/// Does a gain on b along w, or may they not both govern, on the box or on all of its halves and
/// their halves? `w` missing: may they not both govern? Looks at `looks` boxes at most.
[[nodiscard]] bool gains_where_both_govern(const Exclusion& exclusion, const Box3& box,
                                           const SharedFeet& feet, Site a, Site b,
                                           const std::optional<Vec<Rational>>& w, int& looks);

/// "Two edges at a vertex": reasons of the former, and against the latter. False for other sites.
[[nodiscard]] bool gains_from_vertex(const Shape& shape, const Box3& box, const SharedFeet& feet,
                                     Site a, Site b, const Vec<Rational>& w);
[[nodiscard]] bool never_tie_from_vertex(const Shape& shape, const Box3& box, Site a, Site b);

}  // namespace blum::verify
