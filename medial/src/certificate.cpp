#include "certificate.hpp"

#include <algorithm>
#include <map>

#include <nlohmann/json.hpp>

#include "assemble.hpp"
#include "blum/arrangement/part_record.hpp"
#include "blum/kernel/check.hpp"
#include "blum/medial/subcomplex.hpp"
#include "blum/verify/verify.hpp"
#include "cell_names.hpp"
#include "certificate_parts.hpp"
#include "match_arcs.hpp"

namespace blum {
namespace {

using Json = nlohmann::json;

constexpr std::uint32_t kNone = 0xffffffffu;
constexpr std::size_t kMostPairs = 1000;  // of a record: no line is longer than that makes it

class Writer {
 public:
  Writer(const SiteGeometry& geometry, const Subdivision& subdivision, const Assembly& assembly,
         std::optional<double> theta, EngineSet& engines, const CertificateSink& sink)
      : geometry_(geometry),
        solid_(geometry.solid()),
        subdivision_(subdivision),
        assembly_(assembly),
        engines_(engines),
        sink_(sink),
        theta_(theta),
        dropped_(subdivision.leaf.size(), false),
        first_diagram_(subdivision.leaf.size(), kNone) {
    for (const auto l : assembly.undecided) dropped_[l] = true;
    number_edges();
  }
  bool run(const MedialResult& result, const SubdivisionOptions& options);

 private:
  bool line(const char* name, Json content);
  void number_edges();
  [[nodiscard]] Json site(SiteId s) const;
  [[nodiscard]] Json excluded(std::span<const SiteId> from, std::span<const SiteId> kept) const;
  [[nodiscard]] std::optional<Json> diagram(const FaceDiagram& face, const Leaf& leaf);
  [[nodiscard]] Json graph(const FaceDiagram& face) const;
  [[nodiscard]] static Json cells(const CellComplex& complex);
  [[nodiscard]] static long euler(const CellComplex& complex);
  [[nodiscard]] Json header(const SubdivisionOptions& options) const;
  bool write_tree(std::uint32_t node, std::span<const SiteId> candidates);
  bool write_leaf(std::uint32_t index, std::span<const SiteId> candidates);
  [[nodiscard]] std::vector<ArcName> arc_names() const;
  bool write_interfaces();
  bool write_complex(const MedialResult& result);
  bool write_collapses(const CellComplex& complex, const Filtration& filtration);

  const SiteGeometry& geometry_;
  const Solid& solid_;
  const Subdivision& subdivision_;
  const Assembly& assembly_;
  EngineSet& engines_;
  const CertificateSink& sink_;
  std::optional<double> theta_;
  std::vector<bool> dropped_;
  // Diagrams are numbered as they are written: the first of a leaf's faces; those of interfaces.
  std::uint32_t diagrams_ = 0;
  std::vector<std::uint32_t> first_diagram_;
  std::map<const FaceDiagram*, std::uint32_t> own_diagram_;
  /// Of diagrams whose arcs are not as those of the complex: where these are.
  std::map<std::uint32_t, std::vector<ArcMatch>> order_;
  bool complete_ = true;  // every diagram is there, as in the complex
  std::vector<std::uint32_t> edge_number_;
  std::size_t lines_ = 0;
};

bool Writer::line(const char* name, Json content) {
  ++lines_;
  Json record;
  record[name] = std::move(content);
  return sink_(record.dump());
}

/// Edges are numbered as they first appear in the triangles.
void Writer::number_edges() {
  edge_number_.assign(solid_.edge.size(), kNone);
  std::uint32_t next = 0;
  for (const SolidTriangle& t : solid_.triangle)
    for (const auto e : t.edge)
      if (edge_number_[e] == kNone) edge_number_[e] = next++;
}

Json Writer::site(SiteId s) const { return site_number(geometry_.index(), edge_number_, s); }

Json Writer::excluded(std::span<const SiteId> from, std::span<const SiteId> kept) const {
  Json j = Json::array();
  for (const SiteId s : from)
    if (std::ranges::find(kept, s) == kept.end()) j.push_back(site(s));
  return j;
}

Json Writer::graph(const FaceDiagram& face) const {
  using Kind = FaceNode::Kind;
  std::vector<bool> loop(face.node.size(), false);
  for (const FaceArc& a : face.arc)
    if (a.from == a.to) loop[a.from] = true;
  Json events = Json::array(), arcs = Json::array();
  std::vector<std::size_t> number(face.node.size(), 0);
  for (std::size_t n = 0; n < face.node.size(); ++n) {
    const FaceNode& node = face.node[n];
    if ((node.kind != Kind::kEvent && node.kind != Kind::kRim) || loop[n]) continue;
    number[n] = events.size();
    events.push_back(
        {node.kind == Kind::kRim ? "rim" : "event", node.u0, node.u1, node.v0, node.v1});
  }
  const auto end = [&](std::uint32_t n) -> Json {
    const FaceNode& node = face.node[n];
    if (node.kind == Kind::kSide) return Json::array({"side", node.side, node.breakpoint});
    if (node.kind == Kind::kConvexEdge)
      return Json::array({"edge", edge_number_[node.boundary_edge]});
    if (loop[n]) return Json::array({"loop"});
    return Json::array({"event", number[n]});
  };
  for (const FaceArc& a : face.arc)
    arcs.push_back(Json::array({end(a.from), end(a.to), site(a.left), site(a.right)}));
  return {{"events", events}, {"arcs", arcs}};
}

/// Cells by where they come from.
Json Writer::cells(const CellComplex& complex) {
  std::map<std::string, std::size_t> count;
  for (const char* name : {"ties", "events", "rims", "convex points", "convex vertices", "apices",
                           "arcs", "convex edges", "spokes"})
    count[name] = 0;
  for (const ComplexVertex& v : complex.vertex) switch (v.kind) {
      case ComplexVertex::Kind::kArcPoint:
        ++count["ties"];
        break;
      case ComplexVertex::Kind::kEvent:
        ++count["events"];
        break;
      case ComplexVertex::Kind::kRim:
        ++count["rims"];
        break;
      case ComplexVertex::Kind::kConvexEdge:
        ++count["convex points"];
        break;
      case ComplexVertex::Kind::kBoundary:
        ++count["convex vertices"];
        break;
      case ComplexVertex::Kind::kCone:
        ++count["apices"];
        break;
      case ComplexVertex::Kind::kMesh:
        BLUM_CHECK(false);  // certificates are about the complex
    }
  for (const ComplexEdge& e : complex.edge)
    ++count[e.kind == ComplexEdge::Kind::kArc          ? "arcs"
            : e.kind == ComplexEdge::Kind::kConvexEdge ? "convex edges"
                                                       : "spokes"];
  return count;
}

long Writer::euler(const CellComplex& complex) {
  return static_cast<long>(complex.vertex.size() + complex.triangle.size()) -
         static_cast<long>(complex.edge.size());
}

/// Null where the engine does not decide it as it did before.
std::optional<Json> Writer::diagram(const FaceDiagram& face, const Leaf& leaf) {
  const FaceProblem problem{&solid_, face.rect, leaf.candidates, leaf.triangles};
  std::vector<PartRecord> records;
  FaceDiagram again = engines_.production().face(problem, face.side, records);
  std::optional<std::vector<ArcMatch>> match;
  if (again.status == FaceStatus::kDecided) match = match_arcs(face, again);
  if (!match) {
    complete_ = false;
    return std::nullopt;
  }
  bool same = true;
  for (std::uint32_t k = 0; k < match->size(); ++k) same &= (*match)[k] == ArcMatch{k, false};
  if (!same) order_.emplace(diagrams_, *std::move(match));
  ++diagrams_;
  Json j = part_claims(geometry_, engines_.production().predicates(), edge_number_, records, again);
  return Json{{"parts", std::move(j)}, {"graph", graph(again)}};
}

Json Writer::header(const SubdivisionOptions& options) const {
  std::vector<std::array<std::uint32_t, 3>> triangles;
  for (const SolidTriangle& t : solid_.triangle) triangles.push_back(t.vertex);
  const Box3& box = subdivision_.node[0].box;
  return {
      {"format", "blum-certificate"},
      {"version", verify::kFormatVersion},
      {"model",
       {{"points", solid_.point.size()},
        {"triangles", triangles.size()},
        {"fingerprint", verify::fingerprint({solid_.point, triangles})}}},
      {"options",
       {{"seed", options.seed},
        {"resolve", options.resolve},
        {"max_leaf_diameter", options.max_leaf_diameter}}},
      {"box", {{"low", {box.lo.x, box.lo.y, box.lo.z}}, {"high", {box.hi.x, box.hi.y, box.hi.z}}}}};
}

bool Writer::write_leaf(std::uint32_t index, std::span<const SiteId> candidates) {
  const Leaf& leaf = subdivision_.leaf[index];
  if (leaf.theorem == LeafTheorem::kOutside) return line("leaf", {{"theorem", "outside"}});
  const auto undecided = [&](const char* reason) {
    return line("leaf", {{"theorem", "undecided"}, {"reason", reason}});
  };
  if (leaf.theorem == LeafTheorem::kUndecided) return undecided(undecided_reason_name(leaf.reason));
  if (dropped_[index]) return undecided(undecided_reason_name(UndecidedReason::kFaceUndecided));
  Json faces = Json::array();
  first_diagram_[index] = diagrams_;
  for (const auto& face : leaf.face) {
    std::optional<Json> p = diagram(*face, leaf);
    if (!p) return undecided("a face was decided with other candidates only");
    faces.push_back(*std::move(p));
  }
  const bool conical = leaf.theorem == LeafTheorem::kConical;
  Json j = {{"theorem", conical ? "conical" : "boundary"},
            {"excluded", excluded(candidates, leaf.candidates)},
            {"faces", std::move(faces)}};
  if (conical) j["vertex"] = leaf.boundary_vertex;
  return line("leaf", std::move(j));
}

bool Writer::write_tree(std::uint32_t index, std::span<const SiteId> candidates) {
  const CellNode& node = subdivision_.node[index];
  if (node.axis < 0) return write_leaf(node.leaf, candidates);
  // What the subdivision excluded here, too.
  const std::vector<SiteId> kept =
      engines_.production().prune(candidates, node.box.lo, node.box.hi);
  return line("node",
              {{"axis", node.axis}, {"cut", node.cut}, {"excluded", excluded(candidates, kept)}}) &&
         write_tree(node.child, kept) && write_tree(node.child + 1, kept);
}

bool Writer::write_interfaces() {
  for (const GluedInterface& i : assembly_.interface) {
    const Rect& r = i.diagram->rect;
    const auto side = static_cast<std::size_t>(2 * r.axis);
    if (i.diagram == subdivision_.leaf[i.low].face[side + 1] ||
        i.diagram == subdivision_.leaf[i.high].face[side])
      continue;
    own_diagram_[i.diagram.get()] = diagrams_;
    std::optional<Json> p = diagram(*i.diagram, subdivision_.leaf[i.donor]);
    if (!p) continue;  // the checker will say that it is missing
    (*p)["rect"] = {r.axis, r.level, r.u0, r.u1, r.v0, r.v1};
    (*p)["leaf"] = i.donor;
    if (!line("interface", *std::move(p))) return false;
  }
  return true;
}

bool Writer::write_complex(const MedialResult& result) {
  std::map<std::uint32_t, std::size_t> cones;
  for (const ComplexCone& c : result.complex.cone) ++cones[c.leaf];
  return line("complex", {{"euler", euler(result.complex)},
                          {"cells", cells(result.complex)},
                          {"cones", Json(std::vector(cones.begin(), cones.end()))}}) &&
         line("betti", result.betti);
}

/// By edge of the complex.
std::vector<ArcName> Writer::arc_names() const {
  std::vector<ArcName> names;
  for (const GluedInterface& i : assembly_.interface) {
    const auto side = static_cast<std::size_t>(2 * i.diagram->rect.axis);
    const auto own = own_diagram_.find(i.diagram.get());
    const auto number = own != own_diagram_.end() ? own->second
                        : i.diagram == subdivision_.leaf[i.low].face[side + 1]
                            ? first_diagram_[i.low] + static_cast<std::uint32_t>(side) + 1
                            : first_diagram_[i.high] + static_cast<std::uint32_t>(side);
    const auto order = order_.find(number);
    names.resize(std::max(names.size(), i.first_edge + i.diagram->arc.size()));
    for (std::uint32_t k = 0; k < i.diagram->arc.size(); ++k) {
      const ArcMatch match = order == order_.end() ? ArcMatch{k, false} : order->second[k];
      names[i.first_edge + k] = {number, match.arc, match.reversed};
    }
  }
  return names;
}

/// The collapses of values below theta, and what is left.
bool Writer::write_collapses(const CellComplex& complex, const Filtration& filtration) {
  const std::vector<ArcName> arcs = arc_names();
  const CellNames names(geometry_, complex, edge_number_, arcs);
  for (std::size_t s = 0; s < filtration.step.size(); ++s) {
    const CollapseStep& step = filtration.step[s];
    if (step.value >= *theta_) break;
    const std::size_t end =
        s + 1 < filtration.step.size() ? filtration.step[s + 1].begin : filtration.collapse.size();
    for (std::size_t k = step.begin; k < end;) {
      Json pairs = Json::array();
      for (; k < end && pairs.size() < kMostPairs; ++k)
        pairs.push_back(names.pair(filtration.collapse[k]));
      if (!line("collapse",
                {{"cost", step.cost}, {"value", step.value}, {"cells", std::move(pairs)}}))
        return false;
    }
  }
  const CellComplex left =
      subcomplex(complex, closure_of_values(complex, filtration.value, *theta_)).complex;
  return line("pruned", {{"theta", *theta_},
                         {"euler", euler(left)},
                         {"cells", cells(left)},
                         {"betti", betti_numbers(left)}});
}

bool Writer::run(const MedialResult& result, const SubdivisionOptions& options) {
  if (!line("header", header(options)) || !write_tree(0, geometry_.candidates())) return false;
  if (result.certified &&
      (!write_interfaces() || !write_complex(result) ||
       (theta_ && complete_ && !write_collapses(result.complex, *result.filtration))))
    return false;
  return line("end", {{"certified", result.certified}, {"lines", lines_ + 1}}) && complete_;
}

}  // namespace

bool write_certificate(const SiteGeometry& geometry, const Subdivision& subdivision,
                       const Assembly& assembly, const MedialResult& result,
                       const SubdivisionOptions& options, std::optional<double> theta_deg,
                       EngineSet& engines, const CertificateSink& sink) {
  BLUM_REQUIRE(!theta_deg || result.filtration);
  return Writer(geometry, subdivision, assembly, theta_deg, engines, sink).run(result, options);
}

}  // namespace blum
