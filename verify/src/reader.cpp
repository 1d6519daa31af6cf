#include "reader.hpp"

#include <algorithm>
#include <cmath>

namespace blum::verify {

using nlohmann::json;

void Reader::fill() {
  if (!record_.is_null()) return;
  std::string text;
  if (!std::getline(in_, text)) throw Unreadable("the certificate is cut short");
  ++line_;
  record_ = json::parse(text);
  if (!record_.is_object() || record_.size() != 1)
    throw Unreadable("a line is not an object with one member");
}

json Reader::next(const char* name) {
  if (!at(name)) throw Unreadable(std::string("expected \"") + name + "\"");
  json content = std::move(record_.begin().value());
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

double read_number(const json& j) {
  const double x = j.is_number() ? j.get<double>() : NAN;
  if (!std::isfinite(x)) throw Unreadable("not a finite number");
  return x;
}

std::uint32_t read_index(const json& j, std::size_t limit) {
  if (!j.is_number_unsigned() || j.get<std::uint64_t>() >= limit)
    throw Unreadable("an index is out of range");
  return j.get<std::uint32_t>();
}

const json& read_list(const json& j, std::size_t size) {
  if (!j.is_array() || (size != kAnySize && j.size() != size))
    throw Unreadable("not a list, or of another length");
  return j;
}

std::vector<Site> read_sites(const json& j, std::uint32_t limit) {
  std::vector<Site> sites;
  for (const auto& s : read_list(j)) sites.push_back(read_index(s, limit));
  std::ranges::sort(sites);
  if (std::ranges::adjacent_find(sites) != sites.end()) throw Unreadable("a site is listed twice");
  return sites;
}

Graph read_graph(const json& j, const Shape& shape) {
  Graph graph;
  for (const auto& e : j.at("events")) {
    const std::string kind = read_list(e, 5).at(0);
    if (kind != "rim" && kind != "event") throw Unreadable("unknown kind of event: " + kind);
    graph.event.push_back({kind == "rim", {}});
    for (std::size_t k = 0; k < 4; ++k) graph.event.back().box[k] = read_number(e.at(k + 1));
  }
  const auto end = [&](const json& e) -> Graph::End {
    const std::string kind = e.at(0);
    const auto index = [&](std::size_t size, std::size_t limit) {
      return read_index(read_list(e, size).at(1), limit);
    };
    if (kind == "side") return {Graph::kSide, index(3, 4), read_index(e.at(2), kMost)};
    if (kind == "edge") return {Graph::kConvexEdge, index(2, shape.edge.size()), 0};
    if (kind == "event") return {Graph::kEvent, index(2, graph.event.size()), 0};
    if (kind != "loop") throw Unreadable("unknown kind of end: " + kind);
    return {Graph::kLoop, 0, 0};
  };
  for (const auto& a : j.at("arcs"))
    graph.arc.push_back({{end(read_list(a, 4).at(0)), end(a.at(1))},
                         {read_index(a.at(2), shape.sites()), read_index(a.at(3), shape.sites())}});
  return graph;
}

std::vector<PartNode> read_parts(const json& j, const Shape& shape) {
  const auto site = [&](const json& s) { return read_index(s, shape.sites()); };
  const auto vertex = [&](const json& v) { return read_index(v, shape.point.size()); };
  const auto direction = [&](const json& d, std::size_t k) {
    if (!d.at(k).is_array()) return Direction{read_number(d.at(k)), read_number(d.at(k + 1)), {}};
    return Direction{0, 0, {{vertex(d.at(k).at(0)), vertex(d.at(k).at(1))}}};
  };
  std::vector<PartNode> parts;
  for (const auto& p : read_list(j)) {
    parts.emplace_back();
    const std::string kind = p.at(0);
    if (kind == "u" || kind == "v") {
      parts.back().axis = kind == "u" ? 0 : 1;
      parts.back().cut = read_number(p.at(1));
      continue;
    }
    if (kind == "outside") continue;
    // A proposal, if the program has another reason; in older versions a list of sites, with
    // directions or without.
    Claim& c = parts.back().claim;
    c.proposed = kind == "exact" || kind == "slice";
    const bool older = c.proposed && (read_list(p.at(1)).empty() || !p[1][0].is_string());
    const json& q = c.proposed && !older ? p[1] : p;
    const std::string claimed = older ? "star" : q.at(0);
    c.sites = read_sites(q.at(1), shape.sites());
    c.by_feet = claimed == "feet" || claimed == "feet chords";
    if (claimed == "star" || claimed == "feet") {
      if (!older || (q.size() > 2 && q[2].is_array()))
        for (const auto& d : q.at(2)) c.direction.emplace_back(site(d.at(0)), direction(d, 1));
    } else if (claimed == "chords" || claimed == "feet chords") {
      c.type = Claim::Type::kChords;
      for (const auto& d : q.at(2))
        c.between.push_back({site(d.at(0)), site(d.at(1)), direction(d, 2)});
      for (const auto& t : q.at(3))
        c.parted.push_back({site(t.at(0)), site(t.at(1)), site(t.at(2))});
    } else if (claimed == "cone" || claimed == "rim") {
      c.type = claimed == "cone" ? Claim::Type::kCone : Claim::Type::kRim;
      c.vertex = vertex(q.at(2));
      for (std::size_t k = 0; claimed == "rim" && k < 2; ++k)
        c.edge[k] = read_index(q.at(3 + k), shape.edge.size());
    } else {
      throw Unreadable("unknown kind of part: " + claimed);
    }
  }
  return parts;
}

}  // namespace blum::verify
