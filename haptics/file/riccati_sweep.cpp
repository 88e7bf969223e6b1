#include "haptics/file/riccati_sweep.h"

#include <cmath>

#include "haptics/file/positive_part.h"

namespace haptics {
namespace {

using glm::dmat2;
using glm::dmat3;
using glm::dvec2;
using glm::dvec3;

/// Two unit vectors across a direction.
struct Plane {
  dvec3 e1, e2;

  dvec2 of(const dvec3& v) const { return {glm::dot(e1, v), glm::dot(e2, v)}; }
  dvec3 out(const dvec2& d) const { return d.x * e1 + d.y * e2; }
};

Plane across(const dvec3& direction) {
  const dvec3 aside = std::fabs(direction.x) < 0.7 ? dvec3(1.0, 0.0, 0.0) : dvec3(0.0, 1.0, 0.0);
  const dvec3 normal = glm::cross(direction, aside), e1 = normal / std::sqrt(glm::dot(normal, normal));
  return {e1, glm::cross(direction, e1)};
}

/// Two columns of three.
struct Pair {
  dvec3 a, b;

  dvec3 times(const dvec2& d) const { return d.x * a + d.y * b; }
  dvec2 dotted(const dvec3& v) const { return {glm::dot(a, v), glm::dot(b, v)}; }
};

/// What elimination of a link's tilt leaves behind.
struct Eliminated {
  dmat2 inverse;
  Pair by_place;  ///< curvature of tilt and place of the node before
  dmat2 by_tilt;  ///< of tilt and the tilt before: rows that one
  dvec2 slope;
};

dmat3 outer(const dvec3& a, const dvec3& b) { return glm::outerProduct(a, b); }

/// Inverse of a symmetric m, shifted until it is positive: then `is_positive` becomes false.
dmat3 positiveInverse(dmat3 m, double shift, bool& is_positive) {
  for (int n = 0; n < 24; ++n) {
    const double first = m[0][0], second = m[0][0] * m[1][1] - m[0][1] * m[0][1], third = glm::determinant(m);
    if (first > 0.0 && second > 0.0 && third > 0.0) return glm::inverse(m);
    is_positive = false;
    for (int axis = 0; axis < 3; ++axis) m[axis][axis] += shift;
    shift *= 4.0;
  }
  return dmat3(0.0);
}

}  // namespace

ChainStep newtonStep(const FileChain& chain, const ChainShape& shape, const ChainBalance& balance,
                     const RestTurns& rest, const BaseSpring& base, bool tames) noexcept {
  const ShaftLoad& stop = balance.stop;
  const std::size_t links = chain.links;
  const double l = chain.link_mm;
  PerNode<Plane> plane;
  for (std::size_t i = 0; i <= links; ++i) plane[i] = across(shape.direction[i]);
  PerNode<Eliminated> eliminated;
  PerNode<dvec2> slope;  // of the energy along each link's own tilt, for the descent

  // The value of all beyond a node: P, Q, R its curvature in place and tilt, p, r its slope.
  const auto stiffness = [&](std::size_t node) {
    const dmat3& exact = balance.stiffness_N_per_mm[node];
    return tames ? positivePart(exact) : exact;
  };
  ChainStep step;
  dmat3 P = stiffness(links);
  Pair Q{dvec3(0.0), dvec3(0.0)};
  dmat2 R(0.0);
  dvec3 p = -balance.force_N[links], beyond_N = balance.force_N[links];
  dvec2 r(0.0), slope_after(0.0);
  for (std::size_t i = links; i >= 1; --i) {
    const Plane& own = plane[i];
    dvec3 before = shape.direction[i - 1];
    Plane last = plane[i - 1];
    if (!rest.straight) {
      before = rest.turn[i] * before;
      last = {rest.turn[i] * last.e1, rest.turn[i] * last.e2};
    }
    const JointBend& bend = balance.bend[i];
    const double cosine = glm::dot(before, shape.direction[i]);
    const dvec2 b = own.of(before), a = last.of(shape.direction[i]);
    const double whole = bend.f1 * cosine;
    const dmat2 own_curve =
        dmat2(whole + bend.f2 * b.x * b.x, bend.f2 * b.x * b.y, bend.f2 * b.x * b.y, whole + bend.f2 * b.y * b.y);
    const dmat2 last_curve =
        dmat2(whole + bend.f2 * a.x * a.x, bend.f2 * a.x * a.y, bend.f2 * a.x * a.y, whole + bend.f2 * a.y * a.y);
    // cross(x, y): rows the tilt before, columns this one; glm's first index is the column.
    dmat2 cross;
    cross[0][0] = -bend.f1 * glm::dot(last.e1, own.e1) + bend.f2 * a.x * b.x;
    cross[1][0] = -bend.f1 * glm::dot(last.e1, own.e2) + bend.f2 * a.x * b.y;
    cross[0][1] = -bend.f1 * glm::dot(last.e2, own.e1) + bend.f2 * a.y * b.x;
    cross[1][1] = -bend.f1 * glm::dot(last.e2, own.e2) + bend.f2 * a.y * b.y;
    const dvec2 own_slope = -bend.f1 * b, last_slope = -bend.f1 * a;

    // Curvature and slope in this link's tilt.
    const Pair P_tilt{P * own.e1, P * own.e2};
    dmat2 H;
    H[0][0] = l * l * glm::dot(own.e1, P_tilt.a) + 2.0 * l * glm::dot(own.e1, Q.a) + R[0][0] + own_curve[0][0];
    H[1][1] = l * l * glm::dot(own.e2, P_tilt.b) + 2.0 * l * glm::dot(own.e2, Q.b) + R[1][1] + own_curve[1][1];
    H[1][0] = l * l * glm::dot(own.e1, P_tilt.b) + l * (glm::dot(own.e1, Q.b) + glm::dot(own.e2, Q.a)) + R[1][0] +
              own_curve[1][0];
    H[0][1] = H[1][0];
    Pair G{l * P_tilt.a + Q.a, l * P_tilt.b + Q.b};
    dvec2 h = l * own.of(p) + r + own_slope;
    double stretch_Nmm = l * glm::dot(beyond_N, shape.direction[i]);
    slope[i] = own_slope - l * own.of(beyond_N) + slope_after;
    slope_after = last_slope;

    // A load on the shaft within this link.
    if (stop.link == i) {
      const double arm = stop.share * l;
      const Pair C_tilt{stop.stiffness_N_per_mm * own.e1, stop.stiffness_N_per_mm * own.e2};
      H[0][0] += arm * arm * glm::dot(own.e1, C_tilt.a);
      H[1][1] += arm * arm * glm::dot(own.e2, C_tilt.b);
      H[1][0] += arm * arm * glm::dot(own.e1, C_tilt.b);
      H[0][1] = H[1][0];
      G.a += arm * C_tilt.a;
      G.b += arm * C_tilt.b;
      h -= arm * own.of(stop.force_N);
      slope[i] -= arm * own.of(stop.force_N);
      stretch_Nmm += arm * glm::dot(stop.force_N, shape.direction[i]);
    }

    // Compression bends away; where that leaves no definite link it is left out.
    const double joint = chain.bend[i].stiffness_Nmm_per_rad;
    if (stretch_Nmm < 0.0 && tames) stretch_Nmm = 0.0;
    H[0][0] += stretch_Nmm;
    H[1][1] += stretch_Nmm;
    double determinant = H[0][0] * H[1][1] - H[1][0] * H[1][0];
    if (!(H[0][0] > 1e-3 * joint) || !(determinant > 1e-3 * joint * H[0][0])) {
      step.is_definite = false;
      const double least = joint + std::fabs(H[0][0]) + std::fabs(H[1][1]) + std::fabs(H[1][0]);
      H[0][0] += least;
      H[1][1] += least;
      determinant = H[0][0] * H[1][1] - H[1][0] * H[1][0];
    }
    const dmat2 inverse = dmat2(H[1][1], -H[1][0], -H[1][0], H[0][0]) / determinant;
    eliminated[i] = {inverse, G, cross, h};

    const Pair G_solved{G.times(inverse[0]), G.times(inverse[1])};
    const dmat2 B_solved = dmat2(cross * inverse[0], cross * inverse[1]);
    P -= outer(G_solved.a, G.a) + outer(G_solved.b, G.b);
    p -= G_solved.times(h);
    if (i > 1) {
      P += stiffness(i - 1);
      p -= balance.force_N[i - 1];
      beyond_N += balance.force_N[i - 1];
    }
    if (stop.link == i) {
      P += stop.stiffness_N_per_mm;
      p -= stop.force_N;
      beyond_N += stop.force_N;
    }
    // Q' = -G H^-1 B', R' = A - B H^-1 B'.
    const dmat2 crossed = glm::transpose(cross);
    Q = {-G_solved.times(crossed[0]), -G_solved.times(crossed[1])};
    R = last_curve - B_solved * crossed;
    r = last_slope - B_solved * h;
  }

  // Forwards from the handle.
  step.felt_N_per_mm = P;
  if (!base.rigid) {
    const dmat3 gives = positiveInverse(P + dmat3(base.N_per_mm), base.N_per_mm, step.is_definite);
    step.base_mm = gives * (base.pull_N - p);
    step.follow = base.N_per_mm * gives;
    step.descent_Nmm = glm::dot(base.pull_N + beyond_N, step.base_mm);
  }
  dvec3 way = step.base_mm;
  double farthest2 = glm::dot(way, way);
  dvec2 tilt(0.0);
  for (std::size_t i = 1; i <= links; ++i) {
    const Eliminated& link = eliminated[i];
    const dvec2 v = link.by_place.dotted(way) + glm::transpose(link.by_tilt) * tilt + link.slope;
    tilt = -(link.inverse * v);
    step.descent_Nmm -= glm::dot(tilt, slope[i]);
    step.turn[i] = plane[i].out(tilt);
    way += l * step.turn[i];
    farthest2 = std::fmax(farthest2, glm::dot(way, way));
  }
  step.farthest_mm = std::sqrt(farthest2);
  return step;
}

ChainShape moved(const FileChain& chain, const ChainShape& shape, const ChainStep& step, double share) noexcept {
  ChainShape next = shape;
  next.node_mm[0] += share * step.base_mm;
  for (std::size_t i = 1; i <= chain.links; ++i) {
    const dvec3 turned = shape.direction[i] + share * step.turn[i];
    next.direction[i] = turned / std::sqrt(glm::dot(turned, turned));
  }
  next.place(chain);
  return next;
}

}  // namespace haptics
