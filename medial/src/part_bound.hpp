/// The separation angle of one part, by branch and bound over the leaves it is in. A part has
/// tasks, one for each role it plays in a leaf; every task begins with the box of its leaf. The box
/// with the largest upper bound is bisected until it is within the tolerance of the largest angle
/// that some point certainly has.
#pragma once

#include <algorithm>
#include <atomic>
#include <cstdint>
#include <utility>
#include <vector>

#include "angle_memo.hpp"
#include "angle_plan.hpp"
#include "angle_witness.hpp"

namespace blum {

inline constexpr double kDegreesARadian = 180 / kPi;

/// What one thread works with.
struct AngleTools {
  ProductionEngine& engine;
  TiePairs pairs;
  AngleWitness witness;
};

/// Along which axis vectors to the carriers of the candidates change most over a box, and how much
/// at most.
struct BoxChange {
  int axis = 0;
  double most = 0;
};

class PartBound {
 public:
  PartBound(const SiteGeometry& geometry, const Subdivision& subdivision,
            const std::vector<LeafParts>& leaves, const std::vector<AngleTask>& tasks,
            const AngleLook& look, const std::atomic<bool>& stop, AngleTools& tools)
      : geometry_(geometry),
        subdivision_(subdivision),
        leaves_(leaves),
        tasks_(tasks),
        tolerance_(look.tolerance_deg / kDegreesARadian),
        budget_(look.boxes_per_leaf * tasks.size()),
        for_coarse_(look.for_coarse_leaves),
        is_coarse_(tasks.size(), false),
        stop_(stop),
        tools_(tools) {}

  /// Starts: where witnesses are looked for first.
  [[nodiscard]] AngleInterval run(const std::vector<AngleStart>& starts);
  [[nodiscard]] std::size_t boxes() const { return boxes_; }
  /// In whose leaves small boxes are left whose angles are not known; once run() has ended.
  [[nodiscard]] std::vector<std::uint32_t> coarse_tasks() const;

 private:
  struct Item {
    AngleBound bound;
    std::uint32_t task = 0;
    AngleBox box;
    BoxChange change;
    /// Of equal bounds the smaller box first: it soon tells whether more boxes are of use.
    friend bool operator<(const Item& a, const Item& b) {
      return std::pair(a.bound.hi, -a.change.most) < std::pair(b.bound.hi, -b.change.most);
    }
  };

  void add(std::uint32_t task, Box3 box, const std::vector<SiteId>& candidates);
  void add_root(std::uint32_t task);
  void find_meeting(const AngleTask& task, std::vector<AngleBox> boxes, GroupSet groups,
                    GroupSet must, int count);
  void find_junction();
  [[nodiscard]] std::vector<AngleBox> around(std::uint32_t vertex, const Leaf& leaf);
  void find_nodes();
  [[nodiscard]] double top() const {
    return heap_.empty() ? lo_ : std::max(heap_.front().bound.hi, lo_);
  }
  [[nodiscard]] bool is_open() const;
  /// The item as part of its leaf.
  [[nodiscard]] double size(const Item& item) const {
    return 0.5 * item.change.most /
           radius_of(subdivision_.leaf[leaves_[tasks_[item.task].leaf].leaf].box);
  }
  /// Are more boxes not what the item needs?
  [[nodiscard]] bool settles(const Item& item, bool can_be_cut);
  void divide(const Item& item);
  void seek(std::uint32_t task, const AngleBox& within, const Box3& search, const AngleBound& top);

  const SiteGeometry& geometry_;
  const Subdivision& subdivision_;
  const std::vector<LeafParts>& leaves_;
  const std::vector<AngleTask>& tasks_;
  const double tolerance_;
  const std::size_t budget_;
  const bool for_coarse_;
  std::vector<bool> is_coarse_;  // by task: its leaf is; more boxes in it are of no use
  const std::atomic<bool>& stop_;
  AngleTools& tools_;
  std::vector<Item> heap_;
  double lo_ = 0;
  std::vector<Item> settled_;  // boxes that are not looked at any more
  double stuck_ = 0;           // the largest bound of those that are too small to be divided
  std::size_t boxes_ = 0;
  int idle_ = 0;  // boxes since the last better witness
};

}  // namespace blum
