/// The formats of io.hpp as functions to a stream, and what they share.
#pragma once

#include <array>
#include <cstdint>
#include <span>
#include <vector>

#include "blum/kernel/output_stream.hpp"
#include "blum/kernel/solid.hpp"
#include "blum/medial/medial_axis.hpp"

namespace blum::detail {

void put_ma(OutputStream& out, const MedialResult& result);
void put_vtp(OutputStream& out, const MedialResult& result, const Solid& solid);
void put_obj(OutputStream& out, const MedialResult& result);
void put_undecided(OutputStream& out, std::span<const UndecidedCell> cells);

/// The edges that are drawn as lines: seams, and edges with other than two triangles (rims, convex
/// edges, the border of what is undecided).
[[nodiscard]] std::vector<std::uint32_t> drawn_edges(const MedialResult& result);

}  // namespace blum::detail
