// SPDX-License-Identifier: GPL-3.0-or-later
#include "tests/support/exact_touch.h"

#include <algorithm>
#include <vector>

namespace sheet::test {

namespace {

__extension__ typedef __int128 Integer;
constexpr int deepest = 12; // halvings: coefficients of degree 4 then stay below 2^100

// Σ coefficients[k] t^k
struct Polynomial {
  std::vector<Integer> coefficients;
};

Polynomial operator+(const Polynomial& a, const Polynomial& b) {
  Polynomial sum{std::vector<Integer>(std::max(a.coefficients.size(), b.coefficients.size()), 0)};
  for (std::size_t i = 0; i < a.coefficients.size(); ++i)
    sum.coefficients[i] += a.coefficients[i];
  for (std::size_t i = 0; i < b.coefficients.size(); ++i)
    sum.coefficients[i] += b.coefficients[i];
  return sum;
}

Polynomial operator*(const Polynomial& a, const Polynomial& b) {
  Polynomial product{std::vector<Integer>(a.coefficients.size() + b.coefficients.size() - 1, 0)};
  for (std::size_t i = 0; i < a.coefficients.size(); ++i)
    for (std::size_t j = 0; j < b.coefficients.size(); ++j)
      product.coefficients[i + j] += a.coefficients[i] * b.coefficients[j];
  return product;
}

Polynomial operator-(const Polynomial& a, const Polynomial& b) { return a + Polynomial{{-1}} * b; }

using Vector = std::array<Polynomial, 3>;

Vector operator-(const Vector& a, const Vector& b) { return {a[0] - b[0], a[1] - b[1], a[2] - b[2]}; }

Vector cross(const Vector& a, const Vector& b) {
  return {a[1] * b[2] - a[2] * b[1], a[2] * b[0] - a[0] * b[2], a[0] * b[1] - a[1] * b[0]};
}

Polynomial dot(const Vector& a, const Vector& b) { return a[0] * b[0] + a[1] * b[1] + a[2] * b[2]; }

// Over an interval, up to a positive factor; degree 3 or 4.
using Bernstein = std::vector<Integer>;

Bernstein bernstein(const Polynomial& p, int degree) {
  // b_i = Σ_j C(i, j) / C(degree, j) a_j; times 3 or 12 it is an integer
  const std::array<int, 5> choose = degree == 3 ? std::array{1, 3, 3, 1, 0} : std::array{1, 4, 6, 4, 1};
  const int factor = degree == 3 ? 3 : 12;
  Bernstein b(static_cast<std::size_t>(degree) + 1, 0);
  for (std::size_t i = 0; i < b.size(); ++i) {
    Integer i_choose_j = 1;
    for (std::size_t j = 0; j <= i && j < p.coefficients.size(); ++j) {
      b[i] += i_choose_j * (factor / choose[j]) * p.coefficients[j];
      i_choose_j = i_choose_j * static_cast<Integer>(i - j) / static_cast<Integer>(j + 1);
    }
  }
  return b;
}

// De Casteljau's division without its halves: row k has the factor 2^k, which is made the same for all.
void halve(const Bernstein& b, Bernstein& early, Bernstein& late) {
  const std::size_t n = b.size();
  Bernstein row = b;
  early.resize(n);
  late.resize(n);
  for (std::size_t k = 0; k < n; ++k) {
    const Integer factor = Integer(1) << (n - 1 - k);
    early[k] = row[0] * factor;
    late[n - 1 - k] = row[n - 1 - k] * factor;
    for (std::size_t i = 0; i + 1 < n - k; ++i)
      row[i] = row[i] + row[i + 1];
  }
}

bool all_above(const Bernstein& b) {
  return std::all_of(b.begin(), b.end(), [](Integer x) { return x > 0; });
}
bool all_below(const Bernstein& b) {
  return std::all_of(b.begin(), b.end(), [](Integer x) { return x < 0; });
}
bool none_below(const Bernstein& b) {
  return std::none_of(b.begin(), b.end(), [](Integer x) { return x < 0; });
}

Touch decide(const Bernstein& plane, const Bernstein& area, const std::vector<Bernstein>& inside, int depth) {
  if (all_above(plane) || all_below(plane) || std::any_of(inside.begin(), inside.end(), all_below))
    return Touch::no;
  const Integer first = plane.front(), last = plane.back();
  if (((first >= 0 && last <= 0) || (first <= 0 && last >= 0)) && all_above(area) &&
      std::all_of(inside.begin(), inside.end(), none_below))
    return Touch::yes;
  if (depth == deepest)
    return Touch::undecided;
  std::array<Bernstein, 2> planes, areas;
  std::array<std::vector<Bernstein>, 2> insides;
  halve(plane, planes[0], planes[1]);
  halve(area, areas[0], areas[1]);
  for (const Bernstein& b : inside) {
    std::array<Bernstein, 2> halves;
    halve(b, halves[0], halves[1]);
    insides[0].push_back(halves[0]);
    insides[1].push_back(halves[1]);
  }
  Touch answer = Touch::no;
  for (std::size_t i = 0; i < 2; ++i) {
    const Touch half = decide(planes[i], areas[i], insides[i], depth + 1);
    if (half == Touch::yes)
      return half;
    if (half == Touch::undecided)
      answer = half;
  }
  return answer;
}

} // namespace

Touch exact_touch(bool edges, const std::array<IntegerPoint, 4>& start, const std::array<IntegerPoint, 4>& end) {
  std::array<Vector, 4> x;
  for (std::size_t i = 0; i < 4; ++i)
    for (std::size_t k = 0; k < 3; ++k)
      x[i][k].coefficients = {start[i][k], end[i][k] - start[i][k]};
  std::vector<Polynomial> inside;
  Polynomial plane, area;
  if (edges) {
    const Vector u = x[1] - x[0], v = x[3] - x[2], w = x[2] - x[0], n = cross(u, v);
    plane = dot(n, w);
    area = dot(n, n);
    inside = {dot(cross(w, v), n), dot(cross(w, u), n)};
    inside.push_back(area - inside[0]);
    inside.push_back(area - inside[1]);
  } else {
    const Vector a = x[1] - x[0], b = x[2] - x[0], c = x[3] - x[0], n = cross(b - a, c - a);
    plane = dot(cross(a, b), c);
    area = dot(n, n);
    inside = {dot(cross(b, c), n), dot(cross(c, a), n), dot(cross(a, b), n)};
  }
  std::vector<Bernstein> conditions;
  for (const Polynomial& p : inside)
    conditions.push_back(bernstein(p, 4));
  return decide(bernstein(plane, 3), bernstein(area, 4), conditions, 0);
}

} // namespace sheet::test
