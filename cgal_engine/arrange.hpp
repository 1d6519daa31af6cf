/// The arrangements by CGAL: three ways to cut a rectangle into cells of constant governors.
#pragma once

#include "planar_cells.hpp"
#include "relevant.hpp"

namespace blum::cgal {

/// All relevant curves, cut by Arr_algebraic_segment_traits_2.
[[nodiscard]] PlanarCells arrange_algebraic(const Relevant& relevant, const Window& window);

/// The same with the lines of the domains of all sites that may govern.
[[nodiscard]] Relevant with_domains(const Forms& forms, const Relevant& relevant);
/// The arcs of the lower envelope by Envelope_3 and the curves of the boundary. `relevant`: with
/// domains.
[[nodiscard]] PlanarCells arrange_envelope(const Forms& forms, const Relevant& relevant,
                                           const Window& window);

/// All relevant curves, cut by Arr_conic_traits_2.
[[nodiscard]] PlanarCells arrange_conic(const Relevant& relevant, const Window& window);

}  // namespace blum::cgal
