// Catmull-Rom splines (1974) through equally weighted knots. Units and frame of the knots. Any thread; a few flops.
#pragma once

#include <algorithm>
#include <cstddef>
#include <functional>
#include <iterator>

namespace assets {

/// The curve between b and c at t in 0..1.
template <class Value>
Value catmullRom(const Value& a, const Value& b, const Value& c, const Value& d, double t) {
  return 0.5 *
         (2.0 * b + t * (c - a) + t * t * (2.0 * a - 5.0 * b + 4.0 * c - d) + t * t * t * (3.0 * b - a - 3.0 * c + d));
}

/// Between knots `span` and `span` + 1 of an open curve, whose end knots count twice. `value`: of a knot.
template <class Knots, class Projection = std::identity>
auto catmullRomAt(const Knots& knots, std::size_t span, double t, Projection value = {}) {
  const auto at = [&](std::size_t n) { return std::invoke(value, knots[std::min(n, std::size(knots) - 1)]); };
  return catmullRom(at(span == 0 ? 0 : span - 1), at(span), at(span + 1), at(span + 2), t);
}

}  // namespace assets
