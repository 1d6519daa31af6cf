#include "match_arcs.hpp"

#include <algorithm>
#include <array>

namespace blum {
namespace {

constexpr std::uint32_t kNone = 0xffffffffu;

bool is_fixed(const FaceNode& n) {
  return n.kind == FaceNode::Kind::kSide || n.kind == FaceNode::Kind::kConvexEdge;
}

bool alike(const FaceNode& a, const FaceNode& b) {
  if (a.kind != b.kind) return false;
  if (a.kind == FaceNode::Kind::kSide) return a.side == b.side && a.breakpoint == b.breakpoint;
  return a.kind != FaceNode::Kind::kConvexEdge || a.boundary_edge == b.boundary_edge;
}

/// Arcs one after the other, those with known ends first; back where none fits.
class Matcher {
 public:
  Matcher(const FaceDiagram& a, const FaceDiagram& b)
      : a_(a),
        b_(b),
        image_(a.node.size(), kNone),
        source_(b.node.size(), kNone),
        match_(a.arc.size(), {kNone, false}),
        taken_(b.arc.size(), false) {}

  std::optional<std::vector<ArcMatch>> run() {
    if (a_.node.size() != b_.node.size() || a_.arc.size() != b_.arc.size()) return std::nullopt;
    for (std::uint32_t n = 0; n < a_.node.size(); ++n) {
      if (!is_fixed(a_.node[n])) continue;
      const auto same = std::ranges::find_if(
          b_.node, [&](const FaceNode& other) { return alike(a_.node[n], other); });
      if (same == b_.node.end()) return std::nullopt;
      if (!bind(n, static_cast<std::uint32_t>(same - b_.node.begin()))) return std::nullopt;
    }
    bound_.clear();
    if (!extend(a_.arc.size())) return std::nullopt;
    return match_;
  }

 private:
  /// False if one of the two is bound to another.
  bool bind(std::uint32_t n, std::uint32_t m) {
    if (image_[n] == m) return true;
    if (image_[n] != kNone || source_[m] != kNone || !alike(a_.node[n], b_.node[m])) return false;
    image_[n] = m;
    source_[m] = n;
    bound_.push_back(n);
    return true;
  }
  void release(std::size_t bound) {
    for (; bound_.size() > bound; bound_.pop_back()) {
      source_[image_[bound_.back()]] = kNone;
      image_[bound_.back()] = kNone;
    }
  }
  [[nodiscard]] std::uint32_t most_known() const {
    std::uint32_t best = kNone;
    int most = -1;
    for (std::uint32_t k = 0; k < a_.arc.size(); ++k) {
      if (match_[k].arc != kNone) continue;
      const int known = static_cast<int>(image_[a_.arc[k].from] != kNone) +
                        static_cast<int>(image_[a_.arc[k].to] != kNone);
      if (known > most) best = k;
      most = std::max(most, known);
    }
    return best;
  }
  bool extend(std::size_t left) {
    if (left == 0) return true;
    const auto k = most_known();
    const FaceArc& arc = a_.arc[k];
    const auto bound = bound_.size();
    for (std::uint32_t j = 0; j < b_.arc.size(); ++j)
      for (const bool reversed : {false, true}) {
        if (taken_[j]) continue;
        const FaceArc& other = b_.arc[j];
        if (bind(arc.from, reversed ? other.to : other.from) &&
            bind(arc.to, reversed ? other.from : other.to)) {
          match_[k] = {j, reversed};
          taken_[j] = true;
          if (extend(left - 1)) return true;
          match_[k].arc = kNone;
          taken_[j] = false;
        }
        release(bound);
      }
    return false;
  }

  const FaceDiagram &a_, &b_;
  std::vector<std::uint32_t> image_, source_;  // of nodes
  std::vector<std::uint32_t> bound_;
  std::vector<ArcMatch> match_;
  std::vector<bool> taken_;
};

}  // namespace

std::optional<std::vector<ArcMatch>> match_arcs(const FaceDiagram& a, const FaceDiagram& b) {
  return Matcher(a, b).run();
}

}  // namespace blum
