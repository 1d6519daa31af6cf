#include "blum/medial/simplify.hpp"

#include <cstdio>

#include "blum/kernel/check.hpp"

namespace blum {
namespace {

template <class T>
std::vector<T> picked(const std::vector<T>& all, const std::vector<std::uint32_t>& which) {
  std::vector<T> some;
  some.reserve(which.size());
  for (const auto i : which) some.push_back(all[i]);
  return some;
}

const char* name_of(Simplify how) { return how == Simplify::kHomotopy ? "hma" : "sma"; }

std::string line(const char* format, const ThetaRow& r) {
  char text[256];
  std::snprintf(text, sizeof text, format, r.theta_deg, name_of(r.how), r.shape.sheets,
                r.shape.seams, r.shape.curves, r.shape.junctions, r.shape.area, r.betti[0],
                r.betti[1], r.betti[2]);
  return text;
}

}  // namespace

MedialResult simplified(const MedialResult& result, double theta_deg, Simplify how) {
  BLUM_CHECK(result.angles && result.filtration);
  const CellValues value = how == Simplify::kHomotopy
                               ? result.filtration->value
                               : cell_costs(result.complex, result.parts, *result.angles);
  // A set of values of the filtration is closed: a cell goes no later than its faces.
  const CellMask cells = closure_of_values(result.complex, value, theta_deg);
  Subcomplex part = subcomplex(result.complex, cells);
  MedialResult r = result;
  r.parts = restricted(result.parts, part);
  r.angles->vertex = picked(result.angles->vertex, part.vertex);
  std::vector<bool> is_node;
  for (const auto v : part.vertex) is_node.push_back(result.angles->is_node[v]);
  r.angles->is_node = is_node;
  r.filtration->collapse.clear();  // they speak of the whole
  r.filtration->step.clear();
  r.filtration->value = {picked(result.filtration->value.vertex, part.vertex),
                         picked(result.filtration->value.edge, part.edge),
                         picked(result.filtration->value.triangle, part.triangle)};
  r.complex = std::move(part.complex);
  r.betti = betti_numbers(r.complex);
  return r;
}

std::vector<ThetaRow> theta_table(const MedialResult& result, std::span<const double> theta_deg) {
  std::vector<ThetaRow> rows;
  for (const double theta : theta_deg)
    for (const Simplify how : {Simplify::kSubset, Simplify::kHomotopy}) {
      const MedialResult part = simplified(result, theta, how);
      rows.push_back({theta, how, count_shapes(part.complex), part.betti});
    }
  return rows;
}

std::string theta_table_text(std::span<const ThetaRow> rows) {
  std::string text =
      " theta  axis   sheets    seams   curves  junctions          area  Betti numbers\n";
  for (const ThetaRow& r : rows)
    text += line("%6g  %s  %8zu %8zu %8zu   %8zu  %12.6g  %ld %ld %ld\n", r);
  return text;
}

std::string theta_table_csv(std::span<const ThetaRow> rows) {
  std::string text = "theta_deg,method,sheets,seams,curves,junctions,area,b0,b1,b2\n";
  for (const ThetaRow& r : rows) text += line("%.17g,%s,%zu,%zu,%zu,%zu,%.17g,%ld,%ld,%ld\n", r);
  return text;
}

}  // namespace blum
