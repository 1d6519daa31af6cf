/// The abscissae over which the diagram on a rectangle may change: a superset of them that leaves
/// out only what certainly lies outside the rectangle or away from the governors.
#pragma once

#include <vector>

#include "brute_setting.hpp"

namespace blum::brute {

/// Sorted, without repetition, from the rectangle's first corner to its last.
///
/// Which crossings count. At a point where the sites T govern, the diagram is bounded by the curves
/// of d_i^2 - d_j^2 and of the domains of i, for i, j in T. It is trivial there (one smooth curve,
/// not vertical) unless one of these holds: a curve of T is vertical or singular; two curves of
/// (i,j) or of (i,j) and (i,k) cross; curves of (i,j) and of i's domain cross; two curves of i's
/// domain cross, or of i's and j's with d_i = d_j identically. (Curves of (i,j) and (k,l) that
/// cross where all four govern: then (i,j) crosses (i,k) or (i,l), or it coincides there with both,
/// and (k,l) has two curves that cross.) To these come the ends of traces, the crossings of traces
/// and of sides with the others, and the corners.
[[nodiscard]] std::vector<Algebraic> critical_abscissae(const Setting& setting);

}  // namespace blum::brute
