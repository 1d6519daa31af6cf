#include "brute_sweep.hpp"

#include <algorithm>

#include "blum/kernel/check.hpp"
#include "brute_critical.hpp"

namespace blum::brute {
namespace {

/// Coordinates go down to 2^-1074, and abscissae are roots of products of several of their squares.
constexpr slong kMostBits = 16384;

std::size_t at(int k) { return static_cast<std::size_t>(k); }

/// A short rational strictly between two disjoint enclosures, another one for each attempt.
Rational between(const Real& lo, const Real& hi, int attempt) {
  BLUM_CHECK(lo.below(hi));
  Rational weight(1 + (attempt * 23 + 31) % 63, 64);
  weight.canonicalize();
  Real width, wide;  // wide = (1 - weight) * lo + weight * hi, with many bits
  arb_sub(width.get(), hi.get(), lo.get(), kMostBits);
  arb_mul(wide.get(), width.get(), enclose(weight, 64).get(), kMostBits);
  arb_add(wide.get(), wide.get(), lo.get(), kMostBits);
  arb_mul_2exp_si(width.get(), width.get(), -8);
  fmpz_t mantissa, exponent;
  fmpz_init(mantissa);
  fmpz_init(exponent);
  Rational out;
  bool found = false;
  for (slong bits = 8; !found; bits *= 2) {
    if (bits > kMostBits) {
      fmpz_clear(mantissa);
      fmpz_clear(exponent);
      throw PrecisionSpent("critical abscissae closer than 2^-16384");
    }
    Real x, error;
    arf_set_round(arb_midref(x.get()), arb_midref(wide.get()), bits, ARF_RND_NEAR);
    if (!lo.below(x) || !x.below(hi)) continue;
    arf_sub(arb_midref(error.get()), arb_midref(x.get()), arb_midref(wide.get()), ARF_PREC_EXACT,
            ARF_RND_DOWN);
    arb_abs(error.get(), error.get());
    if (!error.below(width)) continue;  // each weight its own number
    found = true;
    arf_get_fmpz_2exp(mantissa, exponent, arb_midref(x.get()));
    mpz_class m;
    fmpz_get_mpz(m.get_mpz_t(), mantissa);
    out = m;
    const slong e = fmpz_get_si(exponent);
    if (e >= 0) {
      mpq_mul_2exp(out.get_mpq_t(), out.get_mpq_t(), static_cast<mp_bitcnt_t>(e));
    } else {
      mpq_div_2exp(out.get_mpq_t(), out.get_mpq_t(), static_cast<mp_bitcnt_t>(-e));
    }
  }
  fmpz_clear(mantissa);
  fmpz_clear(exponent);
  return out;
}

Rational between(const Algebraic& a, const Algebraic& b, int attempt) {
  slong precision = 64;
  while (!a.enclosure(precision).below(b.enclosure(precision))) precision *= 2;
  for (;; precision *= 2) {
    try {
      return between(a.enclosure(precision), b.enclosure(precision), attempt);
    } catch (const PrecisionSpent&) {  // of enclosures wider than what is between them
      if (precision > kMostBits) throw;
    }
  }
}

/// All places of a fiber.
std::vector<Place> places(const Fiber& fiber) {
  std::vector<Place> out;
  for (int p = 0; p <= 2 * fiber.points(); ++p) out.push_back(fiber.place(p));
  for (std::size_t p = 0; p < out.size(); p += 2)
    if (!out[p].triangle.empty()) throw BadPosition("a boundary triangle lies in the plane");
  return out;
}

class Sweeper {
 public:
  explicit Sweeper(const Setting& setting) : s_(setting) {}

  Sweep run() {
    const std::vector<Algebraic> critical = critical_abscissae(s_);
    const int n = static_cast<int>(critical.size());
    BLUM_CHECK(n >= 2);
    std::vector<Section> left;  // the sections of the strip before
    for (int k = 0; k < n; ++k) {
      out_.critical.push_back(std::make_unique<Fiber>(s_, critical[at(k)]));
      std::vector<Section> right;
      std::vector<Place> here = places(*out_.critical.back());
      std::vector<char> inside = inside_from_left(here, left);
      if (k + 1 < n) right = strip(k, critical[at(k)], critical[at(k + 1)], here, inside);
      column(k, here, inside, left, right);
      left = std::move(right);
    }
    return std::move(out_);
  }

 private:
  struct Section {
    Fiber::Branch on;
    int id = -1;          ///< element
    int cell_above = -1;  ///< element, -1: outside the rectangle
    bool boundary = false;
  };

  int add(Element e) {
    out_.element.push_back(std::move(e));
    return static_cast<int>(out_.element.size()) - 1;
  }
  Element& element(int id) { return out_.element[at(id)]; }

  /// Position on a critical fiber that a section runs into.
  static int image(const Fiber& fiber, const Section& s) {
    return 2 * fiber.point_of(s.on.curve, s.on.branch) + 1;
  }
  /// The cell of a strip that touches an interval of the fiber beside it.
  static int cell_at(const Fiber& fiber, const std::vector<Section>& sections, int position) {
    int cell = -1;
    for (const Section& s : sections)
      if (image(fiber, s) < position) cell = s.cell_above;
    BLUM_CHECK(cell >= 0);
    return cell;
  }

  /// For each position of a critical fiber: inside the solid? Known for intervals, and for the
  /// points beside them that are not on the boundary; on the first fiber nothing is.
  std::vector<char> inside_from_left(const std::vector<Place>& here,
                                     const std::vector<Section>& left) {
    std::vector<char> inside(here.size(), 0);
    if (left.empty()) return inside;
    for (std::size_t p = 0; p < here.size(); p += 2)
      if (here[p].within)
        inside[p] =
            element(cell_at(*out_.critical.back(), left, static_cast<int>(p))).inside ? 1 : 0;
    return inside;
  }

  /// Cuts the strip between two critical abscissae into sections and cells.
  std::vector<Section> strip(int k, const Algebraic& lo, const Algebraic& hi,
                             const std::vector<Place>& before,
                             const std::vector<char>& inside_before) {
    for (int attempt = 0;; ++attempt) {
      BLUM_CHECK(attempt < 60);
      const Rational s = between(lo, hi, attempt);
      auto fiber = std::make_unique<Fiber>(s_, rational(s));
      const std::vector<Place> here = places(*fiber);
      int lowest = 0;  // the lowest interval within the rectangle
      while (!here[at(lowest)].within || lowest % 2 != 0) ++lowest;
      // Is it inside? Asked once; then carried over the fiber to the left of the strip.
      bool in = false;
      int known = 0;
      while (known < static_cast<int>(before.size()) &&
             (known % 2 != 0 || !before[at(known)].within))
        ++known;
      if (known < static_cast<int>(before.size())) {
        in = inside_before[at(known)] != 0;
        for (int p = 1; p < static_cast<int>(here.size()); p += 2) {
          if (here[at(p)].triangle.empty()) continue;
          const Function& trace = s_.plane[at(here[at(p)].triangle[0])];
          if (2 * out_.critical.back()->point_of(trace.curve[0].first, 0) + 1 < known) in = !in;
        }
      } else {
        const Rational v = between(fiber->value(lowest / 2 - 1), fiber->value(lowest / 2), 0);
        const Rational u = s - s_.shear * v;
        Vector p;
        for (std::size_t c = 0; c < 3; ++c) p[c] = s_.x[c].cu * u + s_.x[c].cv * v + s_.x[c].c;
        in = s_.interior || inside(*s_.solid, p);
      }
      std::vector<Section> sections;
      if (cut(k, *fiber, here, lowest, in, sections)) {
        out_.sample.push_back(std::move(fiber));
        return sections;
      }
    }
  }

  /// Returns false if another sample is needed: two curves cross just here.
  bool cut(int k, const Fiber& fiber, const std::vector<Place>& here, int lowest, bool in,
           std::vector<Section>& sections) {
    static const std::vector<int> kNone;
    std::vector<char> inside(here.size(), 0);
    for (int p = lowest; p < static_cast<int>(here.size()) && here[at(p)].within; p += 2) {
      inside[at(p)] = in ? 1 : 0;
      if (p + 1 < static_cast<int>(here.size()) && !here[at(p + 1)].triangle.empty()) in = !in;
    }
    const auto governors = [&](int p) -> const std::vector<int>& {
      return inside[at(p)] ? here[at(p)].governor : kNone;
    };
    int below = -1;
    for (int p = lowest - 1; p < static_cast<int>(here.size()) && here[at(p)].within; p += 2) {
      const Place& place = here[at(p)];
      const bool boundary = !place.triangle.empty();
      if (place.triangle.size() > 1) throw BadPosition("a boundary edge lies in the plane");
      const bool is_inside = !boundary && (inside[at(p - 1)] || inside[at(p + 1)]);
      const bool matters =
          place.sides != 0 || boundary ||
          (is_inside && (governors(p - 1) != place.governor || governors(p + 1) != place.governor));
      if (!matters) continue;
      if (fiber.point(p / 2).size() != 1) return false;
      Section section{fiber.point(p / 2)[0], -1, -1, boundary};
      section.id = static_cast<int>(sections.size());
      sections.push_back(section);
    }
    // Now the sample is good: make the elements.
    std::size_t next = 0;
    for (int p = lowest - 1; next < sections.size(); p += 2) {
      Section& section = sections[next];
      const Fiber::Branch& on = fiber.point(p / 2)[0];
      if (on.curve != section.on.curve || on.branch != section.on.branch) continue;
      ++next;
      const Place& place = here[at(p)];
      const bool above_within = next < sections.size();
      Element e{Element::Kind::kSection, k, p / 2, false, place.sides, place.triangle,
                place.governor,          {}};
      e.inside = !section.boundary && (inside[at(p - 1)] || inside[at(p + 1)]);
      if (!e.inside && !section.boundary) e.governor.clear();
      section.id = add(std::move(e));
      int above = -1;
      if (above_within) {
        above =
            add({Element::Kind::kCell, k, 0, inside[at(p + 1)] != 0, 0, {}, governors(p + 1), {}});
        BLUM_CHECK(!element(above).inside || !element(above).governor.empty());
      }
      element(section.id).beside = {-1, -1, below, above};
      section.cell_above = above;
      below = above;
    }
    return true;
  }

  /// Makes the points and intervals of a critical fiber and joins the sections to them.
  void column(int k, const std::vector<Place>& here, std::vector<char>& inside,
              const std::vector<Section>& left, const std::vector<Section>& right) {
    const Fiber& fiber = *out_.critical.back();
    const int n = static_cast<int>(here.size());
    std::vector<char> marked(at(n), 0);
    int previous = 0;
    for (const auto* sections : {&left, &right}) {
      previous = 0;
      for (const Section& s : *sections) {
        const int p = image(fiber, s);
        BLUM_CHECK(p >= previous && here[at(p)].within);
        marked[at(p)] = 1;
        previous = p;
      }
    }
    const auto governors_differ = [&](int p, int q) {
      return inside[at(q)] && here[at(p)].governor != here[at(q)].governor;
    };
    for (int p = 1; p < n; p += 2) {
      const Place& place = here[at(p)];
      if (!place.within) continue;
      if (place.sides != 0 || !place.triangle.empty() || governors_differ(p, p - 1) ||
          governors_differ(p, p + 1))
        marked[at(p)] = 1;
      if (!place.triangle.empty()) continue;
      inside[at(p)] = inside[at(p - 1)] || inside[at(p + 1)];
      if (!here[at(p - 1)].within && !here[at(p + 1)].within) {  // the first or last corner
        const std::vector<Section>& some = left.empty() ? right : left;
        inside[at(p)] = element(some.front().cell_above).inside ? 1 : 0;
      }
    }
    std::vector<int> id(at(n), -1);
    int below = -1, interval = -1;  // the last point; the interval above it, if it is open
    for (int p = 0; p < n; ++p) {
      const Place& place = here[at(p)];
      if (!place.within) continue;
      if (p % 2 == 0) {
        if (interval >= 0) continue;
        const int l = cell_at(fiber, left, p), r = cell_at(fiber, right, p);
        Element e{Element::Kind::kInterval, k, p / 2, inside[at(p)] != 0, 0, {}, {}, {}};
        BLUM_CHECK(element(l).inside == e.inside && element(r).inside == e.inside);
        if (e.inside) {
          e.governor = place.governor;
          BLUM_CHECK(element(l).governor == e.governor && element(r).governor == e.governor);
        }
        e.beside = {below, -1, l, r};
        interval = add(std::move(e));
      } else if (marked[at(p)]) {
        Element e{Element::Kind::kPoint, k, p / 2, inside[at(p)] != 0, place.sides, place.triangle,
                  place.governor,        {}};
        if (!e.inside && e.triangle.empty()) e.governor.clear();
        id[at(p)] = below = add(std::move(e));
        if (interval >= 0) element(interval).beside[1] = below;
        interval = -1;
      }
    }
    for (const Section& s : left) element(s.id).beside[1] = id[at(image(fiber, s))];
    for (const Section& s : right) element(s.id).beside[0] = id[at(image(fiber, s))];
  }

  const Setting& s_;
  Sweep out_;
};

}  // namespace

Sweep sweep(const Setting& setting) { return Sweeper(setting).run(); }

}  // namespace blum::brute
