/// Dense numbers for the sets of a UnionFind, in the order in which their elements are asked for.
#pragma once

#include <cstdint>
#include <vector>

#include "blum/kernel/union_find.hpp"

namespace blum::detail {

class SetNumbering {
 public:
  explicit SetNumbering(UnionFind& sets) : sets_(sets), number_(sets.size(), kNone) {}
  [[nodiscard]] std::uint32_t of(std::uint32_t element) {
    std::uint32_t& number = number_[sets_.find(element)];
    if (number == kNone) number = count_++;
    return number;
  }
  [[nodiscard]] std::uint32_t count() const { return count_; }

 private:
  static constexpr std::uint32_t kNone = 0xffffffffu;
  UnionFind& sets_;
  std::vector<std::uint32_t> number_;
  std::uint32_t count_ = 0;
};

}  // namespace blum::detail
