#include "flatten_levels.hpp"

#include <algorithm>
#include <charconv>
#include <cmath>
#include <tuple>
#include <utility>

#include "blum/kernel/check.hpp"

namespace blum {
namespace {

std::ptrdiff_t decimal_length(double x) {
  char buffer[32];
  return std::to_chars(buffer, buffer + sizeof buffer, std::abs(x)).ptr - buffer;
}

}  // namespace

Levels::Levels(std::vector<double> coordinates, double reach) {
  std::sort(coordinates.begin(), coordinates.end());
  for (const double x : coordinates) {
    // Adding 0 makes one zero of the two.
    if (value_.empty() || value_.back().at != x) value_.push_back({x + 0.0, 0, x});
    ++value_.back().times;
  }
  std::vector<Range> todo;
  for (std::size_t begin = 0, k = 1; k <= value_.size(); ++k) {
    if (k < value_.size() && value_[k].at - value_[k - 1].at <= reach) continue;
    todo.push_back({begin, k});
    begin = k;
  }
  while (!todo.empty()) {
    const auto [begin, end] = todo.back();
    todo.pop_back();
    const Range absorbed = choose_level(begin, end, reach);
    if (begin < absorbed.begin) todo.push_back({begin, absorbed.begin});
    if (absorbed.end < end) todo.push_back({absorbed.end, end});
  }
}

Levels::Range Levels::choose_level(std::size_t begin, std::size_t end, double reach) {
  std::size_t best = begin, most = 0;
  Range absorbed;
  const auto rank = [&](std::size_t k) {
    const Value& v = value_[k];
    return std::tuple(-decimal_length(v.at), v.times, -std::abs(v.at), v.at);
  };
  std::size_t low = begin, high = begin, near = 0;
  for (std::size_t k = begin; k < end; ++k) {
    while (high < end && value_[high].at - value_[k].at <= reach) near += value_[high++].times;
    while (value_[k].at - value_[low].at > reach) near -= value_[low++].times;
    if (near > most || (near == most && rank(k) > rank(best))) {
      best = k;
      most = near;
      absorbed = {low, high};
    }
  }
  for (std::size_t k = absorbed.begin; k < absorbed.end; ++k) value_[k].level = value_[best].at;
  return absorbed;
}

double Levels::level_of(double coordinate) const {
  const auto v = std::lower_bound(value_.begin(), value_.end(), coordinate,
                                  [](const Value& a, double x) { return a.at < x; });
  BLUM_CHECK(v != value_.end() && v->at == coordinate);
  return v->level;
}

}  // namespace blum
