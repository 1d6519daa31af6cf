/// Dyadic: an exact dyadic rational (Arb's arf without rounding), closed under + - *.
#pragma once

#include <arf.h>

#include <utility>

namespace blum::exact {

class Dyadic {
 public:
  Dyadic() { arf_init(v_); }
  Dyadic(double x) {  // NOLINT: an exact conversion, wanted implicit
    arf_init(v_);
    arf_set_d(v_, x);
  }
  Dyadic(const Dyadic& o) {
    arf_init(v_);
    arf_set(v_, o.v_);
  }
  Dyadic(Dyadic&& o) noexcept {
    arf_init(v_);
    arf_swap(v_, o.v_);
  }
  Dyadic& operator=(const Dyadic& o) {
    if (this != &o) arf_set(v_, o.v_);
    return *this;
  }
  Dyadic& operator=(Dyadic&& o) noexcept {
    arf_swap(v_, o.v_);
    return *this;
  }
  ~Dyadic() { arf_clear(v_); }

  friend Dyadic operator+(const Dyadic& a, const Dyadic& b) {
    Dyadic r;
    arf_add(r.v_, a.v_, b.v_, ARF_PREC_EXACT, ARF_RND_DOWN);
    return r;
  }
  friend Dyadic operator-(const Dyadic& a, const Dyadic& b) {
    Dyadic r;
    arf_sub(r.v_, a.v_, b.v_, ARF_PREC_EXACT, ARF_RND_DOWN);
    return r;
  }
  friend Dyadic operator*(const Dyadic& a, const Dyadic& b) {
    Dyadic r;
    arf_mul(r.v_, a.v_, b.v_, ARF_PREC_EXACT, ARF_RND_DOWN);
    return r;
  }
  Dyadic& operator+=(const Dyadic& b) {
    arf_add(v_, v_, b.v_, ARF_PREC_EXACT, ARF_RND_DOWN);
    return *this;
  }
  [[nodiscard]] int sign() const { return arf_sgn(v_); }
  [[nodiscard]] double to_double_down() const { return arf_get_d(v_, ARF_RND_FLOOR); }
  [[nodiscard]] double to_double_up() const { return arf_get_d(v_, ARF_RND_CEIL); }
  friend int compare(const Dyadic& a, const Dyadic& b) { return arf_cmp(a.v_, b.v_); }
  friend int compare_absolute(const Dyadic& a, const Dyadic& b) { return arf_cmpabs(a.v_, b.v_); }
  friend bool operator==(const Dyadic& a, const Dyadic& b) { return arf_equal(a.v_, b.v_) != 0; }

 private:
  arf_t v_;
};

}  // namespace blum::exact
