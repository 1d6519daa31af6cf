#include "reader.hpp"

#include <algorithm>
#include <cmath>

namespace blum::verify {
namespace {

constexpr std::size_t kMostChanges = 1u << 30;

const nlohmann::json& list_of(const nlohmann::json& j, std::size_t size) {
  if (!j.is_array() || j.size() != size) throw Unreadable("a list of another length");
  return j;
}

}  // namespace

double read_number(const nlohmann::json& j) {
  const double x = j.is_number() ? j.get<double>() : NAN;
  if (!std::isfinite(x)) throw Unreadable("not a finite number");
  return x;
}

std::uint32_t read_index(const nlohmann::json& j, std::size_t limit) {
  if (!j.is_number_unsigned() || j.get<std::uint64_t>() >= limit)
    throw Unreadable("an index is out of range");
  return j.get<std::uint32_t>();
}

void Reader::fill() {
  if (!record_.is_null()) return;
  std::string text;
  if (!std::getline(in_, text)) throw Unreadable("the certificate is cut short");
  ++line_;
  record_ = nlohmann::json::parse(text);
  if (!record_.is_object() || record_.size() != 1)
    throw Unreadable("a line is not an object with one member");
}

nlohmann::json Reader::next(const char* name) {
  if (!at(name)) throw Unreadable(std::string("expected \"") + name + "\"");
  nlohmann::json content = std::move(record_.begin().value());
  record_ = nullptr;
  return content;
}

void Reader::end() {
  if (in_.peek() != std::istream::traits_type::eof()) throw Unreadable("lines after the end");
}

bool Reader::at(const char* name) {
  fill();
  return record_.begin().key() == name;
}

Graph read_graph(const nlohmann::json& j, const Shape& shape) {
  Graph graph;
  for (const auto& e : j.at("events")) {
    list_of(e, 5);
    GraphEvent event;
    const std::string kind = e.at(0);
    event.rim = kind == "rim";
    if (!event.rim && kind != "event") throw Unreadable("unknown kind of event: " + kind);
    for (std::size_t k = 0; k < 4; ++k) event.box[k] = read_number(e.at(k + 1));
    graph.event.push_back(event);
  }
  for (const auto& a : j.at("arcs")) {
    list_of(a, 4);
    GraphArc arc;
    for (std::size_t k = 0; k < 2; ++k) {
      const auto& end = a.at(k);
      const std::string kind = end.at(0);
      arc.site[k] = read_index(a.at(k + 2), shape.sites());
      if (kind == "side")
        arc.end[k] = {GraphEnd::Kind::kSide, read_index(list_of(end, 3).at(1), 4),
                      read_index(end.at(2), kMostChanges)};
      else if (kind == "edge")
        arc.end[k] = {GraphEnd::Kind::kConvexEdge,
                      read_index(list_of(end, 2).at(1), shape.edge.size()), 0};
      else if (kind == "event")
        arc.end[k] = {GraphEnd::Kind::kEvent, read_index(list_of(end, 2).at(1), graph.event.size()),
                      0};
      else if (kind == "loop")
        arc.end[k] = {GraphEnd::Kind::kLoop, 0, 0};
      else
        throw Unreadable("unknown kind of end: " + kind);
    }
    graph.arc.push_back(arc);
  }
  return graph;
}

Box3 read_box(const nlohmann::json& j) {
  Box3 b;
  for (int k = 0; k < 3; ++k) {
    b.lo[k] = read_number(j.at("low").at(static_cast<std::size_t>(k)));
    b.hi[k] = read_number(j.at("high").at(static_cast<std::size_t>(k)));
  }
  return b;
}

std::vector<Site> read_sites(const nlohmann::json& j, std::uint32_t limit) {
  std::vector<Site> sites;
  if (!j.is_array()) throw Unreadable("sites are not a list");
  for (const auto& s : j) sites.push_back(read_index(s, limit));
  std::ranges::sort(sites);
  if (std::ranges::adjacent_find(sites) != sites.end()) throw Unreadable("a site is listed twice");
  return sites;
}

namespace {

Direction read_direction(const nlohmann::json& j, std::size_t at, const Shape& shape) {
  if (!j.at(at).is_array()) return {read_number(j.at(at)), read_number(j.at(at + 1)), {}};
  Direction w;
  w.line = {read_index(j.at(at).at(0), shape.point.size()),
            read_index(j.at(at).at(1), shape.point.size())};
  return w;
}

}  // namespace

std::vector<PartNode> read_parts(const nlohmann::json& j, const Shape& shape) {
  std::vector<PartNode> parts;
  if (!j.is_array()) throw Unreadable("parts are not a list");
  for (const auto& p : j) {
    PartNode node;
    const std::string kind = p.at(0);
    if (kind == "u" || kind == "v") {
      node.axis = kind == "u" ? 0 : 1;
      node.cut = read_number(p.at(1));
      parts.push_back(std::move(node));
      continue;
    }
    Claim& c = node.claim;
    if (kind == "outside") {
      parts.push_back(std::move(node));
      continue;
    }
    c.sites = read_sites(p.at(1), shape.sites());
    if (kind == "star" || kind == "feet") {
      c.by_feet = kind == "feet";
      for (const auto& d : p.at(2))
        c.direction.emplace_back(read_index(d.at(0), shape.sites()), read_direction(d, 1, shape));
    } else if (kind == "chords" || kind == "feet chords") {
      c.type = Claim::Type::kChords;
      c.by_feet = kind == "feet chords";
      for (const auto& d : p.at(2))
        c.between.push_back({read_index(d.at(0), shape.sites()), read_index(d.at(1), shape.sites()),
                             read_direction(d, 2, shape)});
      for (const auto& t : p.at(3))
        c.parted.push_back({read_index(t.at(0), shape.sites()), read_index(t.at(1), shape.sites()),
                            read_index(t.at(2), shape.sites())});
    } else if (kind == "cone") {
      c.type = Claim::Type::kCone;
      c.vertex = read_index(p.at(2), shape.point.size());
    } else if (kind == "rim") {
      c.type = Claim::Type::kRim;
      c.vertex = read_index(p.at(2), shape.point.size());
      c.edge = {read_index(p.at(3), shape.edge.size()), read_index(p.at(4), shape.edge.size())};
    } else if (kind == "exact" || kind == "slice" || kind == "link") {
      c.type = Claim::Type::kNotShown;
    } else {
      throw Unreadable("unknown kind of part: " + kind);
    }
    parts.push_back(std::move(node));
  }
  return parts;
}

}  // namespace blum::verify
