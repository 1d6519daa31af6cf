#include "blum/arrangement/engine_json.hpp"

#include <nlohmann/json.hpp>
#include <stdexcept>

namespace blum {
namespace {

using Json = nlohmann::json;

// Arrays of numbers keep the documents short; each pair below writes and reads one type.

Json sites(std::span<const SiteId> ids) {
  Json out = Json::array();
  for (const SiteId s : ids) out.push_back(s.value);
  return out;
}
std::vector<SiteId> read_sites(const Json& j) {
  std::vector<SiteId> out;
  for (const Json& s : j) out.push_back({s.get<std::uint32_t>()});
  return out;
}

Json rect(const Rect& r) { return {r.axis, r.level, r.u0, r.u1, r.v0, r.v1}; }
int read_axis(const Json& j) {
  const int axis = j.get<int>();
  if (axis < 0 || axis > 2) throw std::out_of_range("axis");
  return axis;
}
Rect read_rect(const Json& j) {
  return {read_axis(j.at(0)),    j.at(1).get<double>(), j.at(2).get<double>(),
          j.at(3).get<double>(), j.at(4).get<double>(), j.at(5).get<double>()};
}

Json segment(const Segment& s) { return {s.axis, s.u, s.v, s.t0, s.t1}; }
Segment read_segment(const Json& j) {
  return {read_axis(j.at(0)), j.at(1).get<double>(), j.at(2).get<double>(), j.at(3).get<double>(),
          j.at(4).get<double>()};
}

std::uint32_t index(const Json& j, std::size_t size) {
  const auto k = j.get<std::uint32_t>();
  if (k >= size) throw std::out_of_range("index " + std::to_string(k));
  return k;
}
/// Names the values of an enumeration by their numbers.
template <class E>
E enumerator(const Json& j, E last) {
  return static_cast<E>(index(j, static_cast<std::size_t>(last) + 1));
}

Json solid(const Solid& s) {
  Json points = Json::array(), edges = Json::array(), triangles = Json::array();
  for (const Point3& p : s.point) points.push_back({p.x, p.y, p.z});
  for (const SolidEdge& e : s.edge)
    edges.push_back(
        {e.vertex[0], e.vertex[1], e.triangle[0], e.triangle[1], static_cast<int>(e.kind)});
  for (const SolidTriangle& t : s.triangle)
    triangles.push_back({t.vertex[0], t.vertex[1], t.vertex[2], t.edge[0], t.edge[1], t.edge[2]});
  std::vector<std::uint32_t> degenerate;
  for (std::uint32_t v = 0; v < s.point.size(); ++v)
    if (s.vertex_degenerate[v]) degenerate.push_back(v);
  return {{"points", points},
          {"edges", edges},
          {"triangles", triangles},
          {"degenerate_vertices", degenerate}};
}

/// Points, edges, triangles and their incidences; facets, shells and the frame are left out.
Solid read_solid(const Json& j) {
  Solid s;
  const Json &points = j.at("points"), &edges = j.at("edges"), &triangles = j.at("triangles");
  for (const Json& p : points)
    s.point.push_back({p.at(0).get<double>(), p.at(1).get<double>(), p.at(2).get<double>()});
  std::vector<std::vector<std::uint32_t>> edges_at(s.point.size());
  for (const Json& e : edges) {
    const auto k = static_cast<std::uint32_t>(s.edge.size());
    s.edge.push_back({{index(e.at(0), points.size()), index(e.at(1), points.size())},
                      {index(e.at(2), triangles.size()), index(e.at(3), triangles.size())},
                      enumerator(e.at(4), EdgeKind::kReflex)});
    for (const std::uint32_t v : s.edge.back().vertex) edges_at[v].push_back(k);
  }
  for (const Json& t : triangles) {
    SolidTriangle triangle;
    for (std::size_t k = 0; k < 3; ++k) {
      triangle.vertex[k] = index(t.at(k), points.size());
      triangle.edge[k] = index(t.at(k + 3), edges.size());
    }
    s.triangle.push_back(triangle);
  }
  for (const auto& own : edges_at) {
    s.vertex_edge_begin.push_back(static_cast<std::uint32_t>(s.vertex_edge.size()));
    s.vertex_edge.insert(s.vertex_edge.end(), own.begin(), own.end());
  }
  s.vertex_edge_begin.push_back(static_cast<std::uint32_t>(s.vertex_edge.size()));
  s.vertex_degenerate.assign(s.point.size(), false);
  for (const Json& v : j.at("degenerate_vertices"))
    s.vertex_degenerate[index(v, points.size())] = true;
  return s;
}

Json segment_diagram(const SegmentDiagram& d) {
  Json breakpoints = Json::array(), intervals = Json::array();
  for (const Breakpoint& b : d.breakpoint)
    breakpoints.push_back({static_cast<int>(b.kind), b.lo, b.hi, b.triangle, b.below.value,
                           b.above.value, b.lo_triangle, b.hi_triangle});
  for (const auto& i : d.interval) intervals.push_back({i.inside, i.witness.value});
  return {{"segment", segment(d.segment)}, {"breakpoints", breakpoints}, {"intervals", intervals}};
}

std::shared_ptr<const SegmentDiagram> read_segment_diagram(const Json& j) {
  SegmentDiagram d;
  d.segment = read_segment(j.at("segment"));
  for (const Json& b : j.at("breakpoints")) {
    Breakpoint p;
    p.kind = enumerator(b.at(0), Breakpoint::Kind::kTie);
    p.lo = b.at(1).get<double>();
    p.hi = b.at(2).get<double>();
    p.triangle = b.at(3).get<std::uint32_t>();
    p.below = {b.at(4).get<std::uint32_t>()};
    p.above = {b.at(5).get<std::uint32_t>()};
    p.lo_triangle = b.at(6).get<std::uint32_t>();
    p.hi_triangle = b.at(7).get<std::uint32_t>();
    if (!(p.lo <= p.hi) || p.lo < d.segment.t0 || p.hi > d.segment.t1 ||
        (!d.breakpoint.empty() && p.lo < d.breakpoint.back().hi))
      throw std::out_of_range("place of a breakpoint");
    d.breakpoint.push_back(p);
  }
  for (const Json& i : j.at("intervals"))
    d.interval.push_back({i.at(0).get<bool>(), {i.at(1).get<std::uint32_t>()}});
  if (d.interval.size() != d.breakpoint.size() + 1) throw std::out_of_range("intervals");
  return std::make_shared<const SegmentDiagram>(std::move(d));
}

Json face_diagram(const FaceDiagram& d) {
  Json out{{"rect", rect(d.rect)}};
  for (const auto& s : d.side) out["sides"].push_back(segment_diagram(*s));
  out["side_regions"] = d.side_region;
  Json &nodes = out["nodes"] = Json::array(), &arcs = out["arcs"] = Json::array(),
       &regions = out["regions"] = Json::array(), &pieces = out["pieces"] = Json::array(),
       &traces = out["traces"] = Json::array(), &points = out["trace_points"] = Json::array();
  for (const FaceNode& n : d.node)
    nodes.push_back({{"kind", static_cast<int>(n.kind)},
                     {"side", n.side},
                     {"breakpoint", n.breakpoint},
                     {"boundary_edge", n.boundary_edge},
                     {"piece", n.piece},
                     {"box", {n.u0, n.u1, n.v0, n.v1}},
                     {"governors", sites(n.governors)},
                     {"exact", n.exact}});
  for (const FaceArc& a : d.arc)
    arcs.push_back({a.from, a.to, a.left.value, a.right.value, a.region[0], a.region[1]});
  for (const FaceRegion& r : d.region)
    regions.push_back({{"labels", sites(r.labels)}, {"piece", r.piece}});
  for (const FacePiece& p : d.piece) pieces.push_back(p.boundary_circles);
  for (const FaceTrace& t : d.trace) traces.push_back({t.triangle, t.region});
  for (const FaceTracePoint& t : d.trace_point) points.push_back(t.boundary_edge);
  return out;
}

FaceNode read_node(const Json& j, const FaceDiagram& d) {
  FaceNode n;
  n.kind = enumerator(j.at("kind"), FaceNode::Kind::kConvexEdge);
  n.side = j.at("side").get<std::uint8_t>();
  n.breakpoint = j.at("breakpoint").get<std::uint32_t>();
  if (n.kind == FaceNode::Kind::kSide && d.side.at(n.side)->breakpoint.size() <= n.breakpoint)
    throw std::out_of_range("breakpoint of a node");
  n.boundary_edge = j.at("boundary_edge").get<std::uint32_t>();
  n.piece = index(j.at("piece"), d.piece.size());
  const Json& box = j.at("box");
  n.u0 = box.at(0).get<double>();
  n.u1 = box.at(1).get<double>();
  n.v0 = box.at(2).get<double>();
  n.v1 = box.at(3).get<double>();
  n.governors = read_sites(j.at("governors"));
  n.exact = j.at("exact").get<bool>();
  return n;
}

FaceDiagram read_face_diagram(const Json& j) {
  FaceDiagram d;
  d.rect = read_rect(j.at("rect"));
  for (const Json& p : j.at("pieces")) d.piece.push_back({p.get<std::uint32_t>()});
  for (const Json& r : j.at("regions"))
    d.region.push_back({read_sites(r.at("labels")), index(r.at("piece"), d.piece.size())});
  for (std::size_t s = 0; s < 4; ++s) {
    d.side[s] = read_segment_diagram(j.at("sides").at(s));
    d.side_region[s] = j.at("side_regions").at(s).get<std::vector<std::uint32_t>>();
    if (d.side_region[s].size() != d.side[s]->interval.size())
      throw std::out_of_range("regions of a side");
    for (std::size_t k = 0; k < d.side_region[s].size(); ++k)
      if (d.side[s]->interval[k].inside ? d.side_region[s][k] >= d.region.size()
                                        : d.side_region[s][k] != FaceDiagram::kOutside)
        throw std::out_of_range("region of an interval");
  }
  for (const Json& n : j.at("nodes")) d.node.push_back(read_node(n, d));
  for (const Json& a : j.at("arcs"))
    d.arc.push_back({index(a.at(0), d.node.size()),
                     index(a.at(1), d.node.size()),
                     {a.at(2).get<std::uint32_t>()},
                     {a.at(3).get<std::uint32_t>()},
                     {index(a.at(4), d.region.size()), index(a.at(5), d.region.size())}});
  for (const Json& t : j.at("traces"))
    d.trace.push_back({t.at(0).get<std::uint32_t>(), index(t.at(1), d.region.size())});
  for (const Json& t : j.at("trace_points")) d.trace_point.push_back({t.get<std::uint32_t>()});
  return d;
}

FaceStatus read_status(const Json& j) { return enumerator(j.at("status"), FaceStatus::kUndecided); }

Json decided(const char* what, Json diagram) {
  return {{"status", static_cast<int>(FaceStatus::kDecided)}, {what, std::move(diagram)}};
}

template <class T, class Read>
Result<T> parsed(std::string_view text, Read&& read) {
  try {
    return read(Json::parse(text));
  } catch (const Json::exception& e) {
    return Error{ErrorCode::kBadArgument, e.what(), {}, std::nullopt};
  } catch (const std::out_of_range& e) {
    return Error{ErrorCode::kBadArgument, e.what(), {}, std::nullopt};
  }
}

}  // namespace

std::string solid_request(const Solid& s) { return Json{{"solid", solid(s)}}.dump(); }

std::string segment_request(const Segment& s, std::span<const SiteId> candidates,
                            std::span<const std::uint32_t> triangles) {
  return Json{{"segment", segment(s)},
              {"candidates", sites(candidates)},
              {"triangles", std::vector(triangles.begin(), triangles.end())}}
      .dump();
}

std::string face_request(const FaceProblem& p) {
  return Json{{"rect", rect(p.rect)},
              {"candidates", sites(p.candidates)},
              {"triangles", std::vector(p.triangles.begin(), p.triangles.end())},
              {"interior", p.interior}}
      .dump();
}

Result<EngineRequest> read_request(std::string_view text) {
  return parsed<EngineRequest>(text, [](const Json& j) {
    EngineRequest r;
    if (j.contains("solid")) {
      r.kind = EngineRequest::Kind::kSolid;
      r.solid = read_solid(j.at("solid"));
      return r;
    }
    if (j.contains("segment")) {
      r.kind = EngineRequest::Kind::kSegment;
      r.segment = read_segment(j.at("segment"));
    } else {
      r.rect = read_rect(j.at("rect"));
      r.interior = j.at("interior").get<bool>();
    }
    r.candidates = read_sites(j.at("candidates"));
    r.triangles = j.at("triangles").get<std::vector<std::uint32_t>>();
    return r;
  });
}

std::string failure_answer(FaceStatus status, std::string_view reason) {
  return Json{{"status", static_cast<int>(status)}, {"reason", reason}}.dump();
}
std::string segment_answer(const SegmentDiagram& d) {
  return decided("segment", segment_diagram(d)).dump();
}
std::string face_answer(const FaceDiagram& d) { return decided("face", face_diagram(d)).dump(); }

Result<SegmentReply> read_segment_answer(std::string_view text) {
  return parsed<SegmentReply>(text, [](const Json& j) {
    SegmentReply r;
    r.status = read_status(j);
    if (r.status == FaceStatus::kDecided) {
      r.diagram = read_segment_diagram(j.at("segment"));
    } else {
      r.reason = j.at("reason").get<std::string>();
    }
    return r;
  });
}

Result<FaceDiagram> read_face_answer(std::string_view text) {
  return parsed<FaceDiagram>(text, [](const Json& j) {
    const FaceStatus status = read_status(j);
    if (status == FaceStatus::kDecided) return read_face_diagram(j.at("face"));
    FaceDiagram d;
    d.status = status;
    d.reason = j.at("reason").get<std::string>();
    return d;
  });
}

}  // namespace blum
