/// What is known of parts from one look at a medial axis to the next: bounds depend on nothing but
/// the leaves that a part is in, and most leaves stay as they are when some are divided.
#pragma once

#include <cstdint>
#include <map>
#include <optional>
#include <vector>

#include "angle_plan.hpp"
#include "blum/medial/angles.hpp"

namespace blum {

/// How carefully parts are looked at.
struct AngleLook {
  double tolerance_deg = 0;        ///< when to stop
  std::size_t boxes_per_leaf = 0;  ///< of a part; then it stops, too
  /// Which leaves are too coarse to say what belongs to the part? Boxes are looked at until they
  /// say that, but no further.
  bool for_coarse_leaves = false;
  friend bool operator==(const AngleLook&, const AngleLook&) = default;
};

/// Of one solid.
class AngleMemo {
 public:
  /// Everything that the bounds of a part depend on, in numbers.
  using Key = std::vector<std::uint64_t>;
  struct Known {
    AngleInterval interval;
    std::size_t boxes = 0;
    std::vector<std::uint32_t> coarse;  ///< tasks in whose leaves small boxes told nothing
    AngleLook look;
  };

  /// To be called for all leaves of a look before any key is made.
  void number(const std::vector<LeafParts>& leaves, const Subdivision& subdivision);
  [[nodiscard]] Key key(const std::vector<AngleTask>& tasks,
                        const std::vector<AngleStart>& starts) const;
  /// What this look would find again, or what is within its tolerance.
  [[nodiscard]] const Known* find(const Key& key, const AngleLook& look) const;
  /// The parts of this look, in place of those before. Not while other threads look.
  void keep(std::map<Key, Known> parts);

 private:
  std::map<Key, std::uint64_t> leaf_;  // what a leaf is to the bounds -> its number
  std::uint64_t next_ = 0;
  std::vector<std::uint64_t> leaf_now_;  // of the leaves of this look
  std::map<Key, Known> part_;
};

}  // namespace blum
