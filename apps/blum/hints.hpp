/// `--hints`: a coarse distance field, for the subdivision to begin with.
#pragma once

#include <CLI/CLI.hpp>
#include <cstdint>
#include <optional>
#include <string>

#include "blum/kernel/distance_hint.hpp"
#include "blum/kernel/mesh.hpp"
#include "blum/kernel/result.hpp"
#include "blum/kernel/solid.hpp"

namespace blum::app {

enum class HintSource { kNone, kCpu, kGl, kCorrupted };

struct HintArguments {
  std::optional<HintSource> source;  // none
  std::uint32_t resolution = 32;
};

void add_hint_options(CLI::App& command, HintArguments& arguments);

struct Hints {
  DistanceHint hint;  ///< empty: none
  std::string text;   ///< what was done, for the user; empty: nothing was asked for
};

/// `mesh`: the one that `solid` was built from. Errors: no OpenGL driver, kInterrupted.
[[nodiscard]] Result<Hints> make_hints(const HintArguments& arguments, const PolygonMesh& mesh,
                                       const Solid& solid, int threads);

}  // namespace blum::app
