#include "blum/verify/verify.hpp"

#include <algorithm>
#include <bit>
#include <cstdio>
#include <istream>
#include <map>
#include <numeric>

#include "exact.hpp"
#include "failure.hpp"
#include "glue.hpp"
#include "pruning.hpp"
#include "reader.hpp"

namespace blum::verify {
namespace {

using nlohmann::json;

constexpr int kOldestVersion = 2, kPruningVersion = 3, kMaxDepth = 1000;
constexpr int kNodeLooks = 40, kLeafLooks = 2000;  // at boxes, for one exclusion

class Interrupted {};

double volume(const Box3& b) { return (b.hi.x - b.lo.x) * (b.hi.y - b.lo.y) * (b.hi.z - b.lo.z); }

class Checker {
 public:
  Checker(const Shape& shape, std::istream& in, const std::function<bool(double)>& progress,
          Answer& answer)
      : shape_(shape),
        sites_(shape),
        exclusion_(sites_),
        algebra_(shape),
        lines_(exclusion_, algebra_),
        reader_(in),
        progress_(progress),
        answer_(answer) {}
  void run(const std::string& fingerprint);
  [[nodiscard]] std::size_t line() const { return reader_.line(); }
  [[nodiscard]] const Algebra& algebra() const { return algebra_; }

 private:
  /// Sites that may govern a cell as far as the certificate says, and those excluded above it of
  /// which that is still to be shown: an exclusion is true of a cell if it is of all leaves in it.
  struct Candidates {
    std::vector<Site> kept, pending;
  };
  using Triangles = std::vector<std::uint32_t>;
  void check_tree(std::uint32_t node, Candidates candidates, const Triangles& parents, int depth);
  void check_leaf(const json& j, const Box3& box, Candidates candidates, Triangles triangles);
  void exclude(const json& excluded, const Box3& box, const Triangles& triangles,
               Candidates& candidates, int looks);
  using Lines = std::map<std::array<double, 3>, Line>;  // solved for one leaf, by axis, u, v
  [[nodiscard]] FaceMap check_rectangle(const Rect& rect, const json& j,
                                        std::span<const Site> candidates,
                                        const Triangles& triangles, Lines& lines);
  [[nodiscard]] bool inside(const Point3& x);
  void check_interfaces();
  void check_complex();
  void check_counts(const Complex& complex, const std::vector<bool>& gone, const json& j,
                    const json& betti, const std::string& what);

  const Shape& shape_;
  Sites sites_;
  Exclusion exclusion_;
  Algebra algebra_;
  LineSolver lines_;
  Reader reader_;
  const std::function<bool(double)>& progress_;
  Answer& answer_;
  std::vector<CellNode> node_;
  std::vector<Leaf> leaf_;
  std::map<std::array<double, 6>, FaceMap> interface_;
  std::map<std::array<double, 3>, bool> inside_;
  double done_ = 0;
  int version_ = 0;
};

std::array<double, 6> key_of(const Rect& r) {
  return {static_cast<double>(r.axis), r.level, r.u0, r.u1, r.v0, r.v1};
}

bool Checker::inside(const Point3& x) {
  const auto [it, fresh] = inside_.try_emplace({x.x, x.y, x.z}, false);
  if (fresh) {
    const auto found = is_inside(shape_, x);
    require(found.has_value(), "general position: a corner of a cell in line with the boundary");
    it->second = *found;
  }
  return it->second;
}

void Checker::exclude(const json& excluded, const Box3& box, const Triangles& triangles,
                      Candidates& candidates, int looks) {
  const std::vector<Site> sites = read_sites(excluded, shape_.sites());
  std::vector<Site> kept;
  std::ranges::set_difference(candidates.kept, sites, std::back_inserter(kept));
  std::ranges::set_intersection(candidates.kept, sites, std::back_inserter(candidates.pending));
  answer_.exclusions += candidates.pending.size();
  candidates.pending = exclusion_.may_govern(candidates.pending, box, kept, triangles, looks);
  candidates.kept = std::move(kept);
}

FaceMap Checker::check_rectangle(const Rect& rect, const json& j, std::span<const Site> candidates,
                                 const Triangles& triangles, Lines& lines) {
  const std::vector<PartNode> nodes = read_parts(j.at("parts"), shape_);
  const Graph graph = read_graph(j.at("graph"), shape_);
  const auto number = static_cast<std::uint32_t>(answer_.faces++);
  answer_.parts += nodes.size();
  std::array<Line, 4> side;
  for (int s = 0; s < 4; ++s) {
    const Segment segment = side_of(rect, s);
    const auto [it, fresh] =
        lines.try_emplace({static_cast<double>(segment.axis), segment.u, segment.v});
    if (fresh)
      it->second = lines_.solve(segment, inside(at(segment, segment.t0)), candidates, triangles);
    side[static_cast<std::size_t>(s)] = it->second;
  }
  FaceMap map = check_face(exclusion_, algebra_, rect, side, candidates, triangles, nodes);
  map.number = number;
  check_graph(map, graph);
  return map;
}

void Checker::check_leaf(const json& j, const Box3& box, Candidates candidates,
                         Triangles triangles) {
  Leaf leaf{box, false, false, 0, {}, {}, {}};
  const std::string theorem = j.at("theorem"), name = "leaf " + std::to_string(leaf_.size());
  if (theorem == "undecided")
    throw Failure(name + " is undecided (" + j.at("reason").get<std::string>() +
                  "): the result is not certified");
  if (theorem == "outside") {
    leaf.outside = true;
    require(triangles.empty() && !inside(box.lo), "a leaf meets the solid and is called outside");
  } else {
    exclude(j.at("excluded"), box, triangles, candidates, kLeafLooks);
    if (!candidates.pending.empty())
      throw Failure("candidates: site " + std::to_string(candidates.pending.front()) +
                    " was excluded and may govern a point of " + name);
    leaf.candidates = std::move(candidates.kept);
    leaf.triangles = std::move(triangles);
    const json& faces = read_list(j.at("faces"), 6);
    Lines lines;
    for (std::size_t f = 0; f < 6; ++f)
      leaf.face[f] =
          check_rectangle(face_of(box, f), faces[f], leaf.candidates, leaf.triangles, lines);
    leaf.conical = theorem == "conical";
    if (leaf.conical)
      check_conical(sites_, box, read_index(j.at("vertex"), shape_.point.size()), leaf.candidates,
                    leaf.triangles, leaf.face);
    else if (theorem == "boundary")
      check_boundary(sites_, box, leaf.triangles, leaf.face);
    else
      throw Unreadable("unknown theorem: " + theorem);
  }
  leaf_.push_back(std::move(leaf));
  ++answer_.leaves;
  done_ += volume(box);
  if (progress_ && !progress_(done_ / volume(node_[0].box))) throw Interrupted();
}

void Checker::check_tree(std::uint32_t node, Candidates candidates, const Triangles& parents,
                         int depth) {
  require(depth < kMaxDepth, "the tree of cells is too deep");
  const Box3 box = node_[node].box;
  Triangles triangles = sites_.meeting(parents, box);
  if (reader_.at("leaf")) {
    node_[node].leaf = static_cast<std::uint32_t>(leaf_.size());
    return check_leaf(reader_.next("leaf"), box, std::move(candidates), std::move(triangles));
  }
  const json j = reader_.next("node");
  exclude(j.at("excluded"), box, triangles, candidates, kNodeLooks);
  const int axis = static_cast<int>(read_index(j.at("axis"), 3));
  const double cut = read_number(j.at("cut"));
  require(cut > box.lo[axis] && cut < box.hi[axis],
          "the leaves do not tile: a cut outside its cell");
  const auto low = static_cast<std::uint32_t>(node_.size());
  node_[node] = {box, axis, cut, low, 0};
  node_.insert(node_.end(), 2, {box});
  node_[low].box.hi[axis] = node_[low + 1].box.lo[axis] = cut;
  check_tree(low, candidates, triangles, depth + 1);
  check_tree(low + 1, candidates, triangles, depth + 1);
}

void Checker::check_interfaces() {
  while (reader_.at("interface")) {
    const json j = reader_.next("interface");
    const json& at = read_list(j.at("rect"), 6);
    const auto x = [&](std::size_t k) { return read_number(at[k]); };
    const Rect rect{static_cast<int>(read_index(at[0], 3)), x(1), x(2), x(3), x(4), x(5)};
    const Leaf& leaf = leaf_[read_index(j.at("leaf"), leaf_.size())];
    const Box3 box = box_of(rect);
    for (int k = 0; k < 3; ++k)
      require(box.lo[k] >= leaf.box.lo[k] && box.hi[k] <= leaf.box.hi[k] &&
                  (box.lo[k] < box.hi[k] || k == rect.axis),
              "gluing: an interface is not on its leaf");
    Lines lines;
    interface_[key_of(rect)] = check_rectangle(rect, j, leaf.candidates, leaf.triangles, lines);
  }
}

void Checker::check_complex() {
  const Complex complex =
      glue(exclusion_, algebra_, node_, leaf_, [this](const Rect& r) -> const FaceMap& {
        const auto it = interface_.find(key_of(r));
        require(it != interface_.end(), "gluing: the diagram of an interface is missing");
        return it->second;
      });
  const json j = reader_.next("complex");
  std::vector<std::size_t> cones(leaf_.size(), 0);
  for (const auto& c : j.at("cones")) {
    const auto leaf = read_index(c.at(0), cones.size());
    if (cones[leaf] != 0) throw Unreadable("a leaf's cones are counted twice");
    cones[leaf] = read_index(c.at(1), kMost);
  }
  require(cones == complex.cones, "the complex has other cones than the leaves give");
  const std::vector<bool> none(complex.cell.size(), false);
  check_counts(complex, none, j, reader_.next("betti"), "the complex");
  answer_.betti = shape_.betti();
  if (!reader_.at("collapse") && !reader_.at("pruned")) return;
  if (version_ < kPruningVersion) throw Unreadable("pruning, which this version has not");
  Pruning pruning(shape_, complex);
  while (reader_.at("collapse")) pruning.collapse(reader_.next("collapse"));
  const json left = reader_.next("pruned");
  answer_.theta_deg = pruning.end(left);
  answer_.collapses = pruning.collapses;
  answer_.pieces = pruning.pieces;
  answer_.angles = pruning.angles;
  check_counts(complex, pruning.gone, left, left.at("betti"), "the pruned complex");
}

/// What is said of the cells that are not gone.
void Checker::check_counts(const Complex& complex, const std::vector<bool>& gone, const json& j,
                           const json& betti, const std::string& what) {
  auto count = count_cells(complex, gone);
  for (const char* name : {"ties", "events", "rims", "convex points", "convex vertices", "apices",
                           "arcs", "convex edges", "spokes"}) {
    const auto stated = read_index(j.at("cells").at(name), kMost);
    require(stated == count[name], what + " has another number of " + name + ": " +
                                       std::to_string(count[name]) + ", not " +
                                       std::to_string(stated));
  }
  long euler = 0;
  for (std::size_t c = 0; c < gone.size(); ++c)
    if (!gone[c]) euler += complex.cell[c].dimension == 1 ? -1 : 1;
  require(read_number(j.at("euler")) == static_cast<double>(euler),
          what + " has another Euler characteristic");
  const auto found = betti_numbers(complex, gone);
  for (std::size_t k = 0; k < 3; ++k)
    require(std::cmp_equal(read_index(betti.at(k), kMost), found[k]),
            what + " has other Betti numbers");
  require(found == shape_.betti(), "the Betti numbers are not those of the solid");
}

void Checker::run(const std::string& fingerprint) {
  const json header = reader_.next("header");
  if (header.at("format") != "blum-certificate") throw Unreadable("not a certificate of blum");
  version_ = static_cast<int>(read_index(header.at("version"), 1000));
  if (version_ > kFormatVersion || version_ < kOldestVersion)
    throw Unreadable("version " + std::to_string(version_) + " of the format; this program reads " +
                     std::to_string(kOldestVersion) + " to " + std::to_string(kFormatVersion));
  const json& model = header.at("model");
  require(model.at("fingerprint") == fingerprint && model.at("points") == shape_.point.size() &&
              model.at("triangles") == shape_.triangle.size(),
          "the certificate is of another model");
  Box3 root;
  for (std::size_t k = 0; k < 3; ++k) {
    const int axis = static_cast<int>(k);
    root.lo[axis] = read_number(header.at("box").at("low").at(k));
    root.hi[axis] = read_number(header.at("box").at("high").at(k));
    for (const Point3& p : shape_.point)
      require(p[axis] > root.lo[axis] && p[axis] < root.hi[axis],
              "the solid does not lie in the box");
  }
  node_.push_back({root});
  Triangles triangles(shape_.triangle.size());
  std::iota(triangles.begin(), triangles.end(), 0u);
  check_tree(0, {shape_.candidates(), {}}, triangles, 0);
  check_interfaces();
  check_complex();
  const json end = reader_.next("end");
  require(end.at("certified") == true, "the certificate calls itself not certified");
  if (end.at("lines") != reader_.line()) throw Unreadable("the number of lines is wrong");
  reader_.end();
}

}  // namespace

std::string fingerprint(const Model& model) {
  std::uint64_t h = 0xcbf29ce484222325u;  // FNV-1a
  const auto add = [&](std::uint64_t x) {
    for (int k = 0; k < 8; ++k) h = (h ^ (x >> (8 * k) & 0xff)) * 0x100000001b3u;
  };
  for (const Point3& p : model.point)
    for (int k = 0; k < 3; ++k) add(std::bit_cast<std::uint64_t>(p[k] + 0.0));
  for (const auto& t : model.triangle)
    for (const auto v : t) add(v);
  char text[17];
  std::snprintf(text, sizeof text, "%016llx", static_cast<unsigned long long>(h));
  return text;
}

Answer verify(const Model& model, std::istream& certificate,
              const std::function<bool(double)>& progress) {
  Answer answer;
  const Shape shape(model.point, model.triangle);
  if (!shape.defect().empty()) {
    answer.outcome = Answer::Outcome::kFalse;
    answer.statement = shape.defect();
    return answer;
  }
  Checker checker(shape, certificate, progress, answer);
  const auto end = [&](Answer::Outcome outcome, const std::string& statement) {
    answer.outcome = outcome;
    answer.statement = statement;
    answer.line = checker.line();
  };
  try {
    checker.run(fingerprint(model));
    answer.outcome = Answer::Outcome::kVerified;
  } catch (const Failure& failure) {
    end(Answer::Outcome::kFalse, failure.what());
  } catch (const Unreadable& problem) {
    end(Answer::Outcome::kUnreadable, problem.what());
  } catch (const nlohmann::json::exception& problem) {
    end(Answer::Outcome::kUnreadable, problem.what());
  } catch (const Interrupted&) {
    end(Answer::Outcome::kUnreadable, "interrupted");
  }
  answer.exact_parts = checker.algebra().diagrams;
  answer.exact_segments = checker.algebra().segments;
  return answer;
}

}  // namespace blum::verify
