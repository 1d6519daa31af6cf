// Ball arithmetic encloses the exact result, whatever the operands: compared with exact rationals.
#include "blum/kernel/ball.hpp"

#include <gmpxx.h>
#include <gtest/gtest.h>

#include <random>

namespace blum {
namespace {

using Random = std::mt19937_64;

bool holds(const Ball& b, const mpq_class& x) {
  return b.rad >= 0 && abs(x - mpq_class(b.mid)) <= mpq_class(b.rad);
}

/// A number of any size, often 0, a power of two, or short.
double number(Random& random, int least, int most) {
  const int e = std::uniform_int_distribution(least, most)(random);
  const double sign = random() % 2 == 0 ? 1 : -1;
  switch (random() % 6) {
    case 0:
      return 0;
    case 1:
      return sign * std::ldexp(1, e);
    case 2:
      return sign * std::ldexp(double(random() % 16 + 1), e);
    default:
      return sign * std::ldexp(std::uniform_real_distribution(0.5, 1.0)(random), e);
  }
}

struct Pair {
  Ball ball;
  mpq_class exact;  ///< a point of the ball
};

Pair operand(Random& random, int least, int most) {
  Pair p;
  const double mid = number(random, least, most);
  double rad = 0;
  switch (random() % 4) {
    case 0:
      break;
    case 1:
      rad = std::abs(mid) * std::ldexp(1, -int(random() % 60));
      break;
    default:
      rad = std::abs(number(random, least, most));
      break;
  }
  p.ball = {mid, rad};
  // Often an end of the ball.
  mpq_class t(static_cast<long>(random() % 3) - 1);
  if (random() % 2 == 0) t = mpq_class(static_cast<long>(random() % 2001) - 1000, 1000);
  t.canonicalize();
  p.exact = mpq_class(mid) + t * mpq_class(rad);
  return p;
}

void check(Random& random, int least, int most) {
  Pair a = operand(random, least, most), b = operand(random, least, most);
  if (random() % 4 == 0) {  // cancellation
    b.ball.mid = -a.ball.mid * (random() % 2 == 0 ? 1 : 1 + 0x1p-52);
    b.exact = b.ball.mid;
  }
  EXPECT_TRUE(holds(a.ball + b.ball, a.exact + b.exact));
  EXPECT_TRUE(holds(a.ball - b.ball, a.exact - b.exact));
  EXPECT_TRUE(holds(-a.ball, -a.exact));
  EXPECT_TRUE(holds(a.ball * b.ball, a.exact * b.exact))
      << a.ball.mid << ' ' << a.ball.rad << ' ' << b.ball.mid << ' ' << b.ball.rad;
  EXPECT_TRUE(holds(square(a.ball), a.exact * a.exact));
  EXPECT_TRUE(mpq_class(a.ball.low()) <= a.exact);
  EXPECT_TRUE(mpq_class(a.ball.high()) >= a.exact);
  EXPECT_TRUE(mpq_class(a.ball.magnitude()) >= abs(a.exact));
  if (const int s = a.ball.sign(); s != 2) {
    EXPECT_EQ(s, sgn(a.exact));
  }
  if (const Ball x = a.ball - b.ball; x.sign() != 2) {
    EXPECT_EQ(x.sign(), cmp(a.exact, b.exact) > 0 ? 1 : cmp(a.exact, b.exact) < 0 ? -1 : 0);
  }
  if (b.ball.sign() == 1 || b.ball.sign() == -1) {
    EXPECT_TRUE(holds(divide(a.ball, b.ball), a.exact / b.exact))
        << a.ball.mid << ' ' << a.ball.rad << " / " << b.ball.mid << ' ' << b.ball.rad;
  }
  if (a.ball.sign() == 1) {
    const Ball r = root(a.ball);  // (mid - rad)^2 <= exact <= (mid + rad)^2
    const mpq_class lo = mpq_class(r.mid) - mpq_class(r.rad),
                    hi = mpq_class(r.mid) + mpq_class(r.rad);
    EXPECT_TRUE((lo <= 0 || lo * lo <= a.exact) && hi >= 0 && hi * hi >= a.exact)
        << a.ball.mid << ' ' << a.ball.rad;
  }
}

TEST(Ball, RandomOperands_EncloseTheExactResult) {
  Random random(1);
  for (int k = 0; k < 60000; ++k) check(random, -60, 60);
}

TEST(Ball, OperandsOfOneSize_EncloseTheExactResult) {
  Random random(2);
  for (int k = 0; k < 60000; ++k) check(random, -1, 1);
}

TEST(Ball, LargeAndSmallOperands_EncloseTheExactResult) {
  Random random(3);
  for (int k = 0; k < 40000; ++k) check(random, -480, 480);
}

TEST(Ball, Underflow_IsEnclosed) {
  Random random(4);
  for (int k = 0; k < 40000; ++k) {
    const Pair a = operand(random, -540, -500), b = operand(random, -560, -500);
    EXPECT_TRUE(holds(a.ball * b.ball, a.exact * b.exact))
        << a.ball.mid << ' ' << a.ball.rad << ' ' << b.ball.mid << ' ' << b.ball.rad;
  }
}

TEST(Ball, ExactZero_IsCertain) {
  EXPECT_EQ((Ball(0.0) * Ball(3.0)).sign(), 0);
  EXPECT_EQ((Ball(0.25) - Ball(0.25)).sign(), 0);
  EXPECT_EQ((Ball(0.25) - Ball(0.25 + 0x1p-54)).sign(), -1);
  EXPECT_EQ((Ball(1.0, 0x1p-60) - Ball(1.0)).sign(), 2);
  EXPECT_EQ((Ball(0x1p-600) * Ball(0x1p-600)).sign(), 2) << "underflow is no zero";
}

TEST(Ball, DotAndCross_EncloseTheExactResult) {
  Random random(5);
  for (int k = 0; k < 20000; ++k) {
    Point3 p, q, r, s;
    for (int i = 0; i < 3; ++i) {
      p[i] = number(random, -30, 2);
      q[i] = random() % 3 == 0 ? p[i] : number(random, -30, 2);
      r[i] = number(random, -30, 2);
      s[i] = random() % 3 == 0 ? r[i] * (1 + 0x1p-52) : number(random, -30, 2);
    }
    const BallVector a = difference(p, q), b = difference(r, s);
    mpq_class d = 0;
    std::array<mpq_class, 3> x, y;
    for (int i = 0; i < 3; ++i) {
      const auto m = static_cast<std::size_t>(i);
      x[m] = mpq_class(p[i]) - mpq_class(q[i]);
      y[m] = mpq_class(r[i]) - mpq_class(s[i]);
      d += x[m] * y[m];
    }
    EXPECT_TRUE(holds(dot(a, b), d));
    const BallVector c = cross(a, b);
    for (std::size_t i = 0; i < 3; ++i) {
      const std::size_t j = (i + 1) % 3, l = (i + 2) % 3;
      EXPECT_TRUE(holds(c[i], x[j] * y[l] - x[l] * y[j]));
    }
  }
}

}  // namespace
}  // namespace blum
