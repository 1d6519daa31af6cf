/// The two upper stages of the predicates: 128-bit balls (Arb) and exact dyadic numbers (arf).
/// Predicates are polynomials in double coordinates, so the exact stage needs neither division nor
/// common denominators.
#pragma once

#include <arb.h>
#include <arf.h>

#include <utility>

namespace blum::detail {

class Wide {
 public:
  static constexpr slong kPrecision = 128;
  Wide() { arb_init(x_); }
  Wide(double v) {
    arb_init(x_);
    arb_set_d(x_, v);
  }
  Wide(const Wide& o) {
    arb_init(x_);
    arb_set(x_, o.x_);
  }
  Wide(Wide&& o) noexcept {
    arb_init(x_);
    arb_swap(x_, o.x_);
  }
  Wide& operator=(Wide o) noexcept {
    arb_swap(x_, o.x_);
    return *this;
  }
  ~Wide() { arb_clear(x_); }
  [[nodiscard]] int sign() const {
    if (arb_is_positive(x_)) return 1;
    if (arb_is_negative(x_)) return -1;
    return arb_is_zero(x_) ? 0 : 2;
  }
  friend Wide operator+(const Wide& a, const Wide& b) {
    Wide r;
    arb_add(r.x_, a.x_, b.x_, kPrecision);
    return r;
  }
  friend Wide operator-(const Wide& a, const Wide& b) {
    Wide r;
    arb_sub(r.x_, a.x_, b.x_, kPrecision);
    return r;
  }
  friend Wide operator*(const Wide& a, const Wide& b) {
    Wide r;
    arb_mul(r.x_, a.x_, b.x_, kPrecision);
    return r;
  }
  [[nodiscard]] arb_srcptr get() const { return x_; }
  [[nodiscard]] arb_ptr get() { return x_; }

 private:
  arb_t x_;
};

class Exact {
 public:
  Exact() { arf_init(x_); }
  Exact(double v) {
    arf_init(x_);
    arf_set_d(x_, v);
  }
  Exact(const Exact& o) {
    arf_init(x_);
    arf_set(x_, o.x_);
  }
  Exact(Exact&& o) noexcept {
    arf_init(x_);
    arf_swap(x_, o.x_);
  }
  Exact& operator=(Exact o) noexcept {
    arf_swap(x_, o.x_);
    return *this;
  }
  ~Exact() { arf_clear(x_); }
  [[nodiscard]] int sign() const { return arf_sgn(x_); }
  friend Exact operator+(const Exact& a, const Exact& b) {
    Exact r;
    arf_add(r.x_, a.x_, b.x_, ARF_PREC_EXACT, ARF_RND_DOWN);
    return r;
  }
  friend Exact operator-(const Exact& a, const Exact& b) {
    Exact r;
    arf_sub(r.x_, a.x_, b.x_, ARF_PREC_EXACT, ARF_RND_DOWN);
    return r;
  }
  friend Exact operator*(const Exact& a, const Exact& b) {
    Exact r;
    arf_mul(r.x_, a.x_, b.x_, ARF_PREC_EXACT, ARF_RND_DOWN);
    return r;
  }

 private:
  arf_t x_;
};

}  // namespace blum::detail
