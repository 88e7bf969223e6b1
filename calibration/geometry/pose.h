// Rigid poses, points and free vectors with their frame in the type: `X_WT * p_T` is a Point<World>; a product of
// frames that do not match does not compile. mm and unit quaternions, double. Trivially copyable; a few flops, no
// allocation; any thread. No scale or shear: the workstation is 1:1.
#pragma once

#include <cmath>

#include <glm/glm.hpp>
#include <glm/gtc/quaternion.hpp>

namespace calibration {

inline bool isFinite(const glm::dvec2& v) noexcept { return std::isfinite(v.x) && std::isfinite(v.y); }
inline bool isFinite(const glm::dvec3& v) noexcept { return isFinite(glm::dvec2(v)) && std::isfinite(v.z); }

/// A position in frame A, mm.
template <class A>
struct Point {
  glm::dvec3 mm{0.0};
};

/// A direction, velocity or force in frame A; the variable's name has the unit.
template <class A>
struct Vector {
  glm::dvec3 xyz{0.0};
};

template <class A>
Vector<A> operator-(const Point<A>& a, const Point<A>& b) {
  return {a.mm - b.mm};
}
template <class A>
Point<A> operator+(const Point<A>& p, const Vector<A>& v_mm) {
  return {p.mm + v_mm.xyz};
}
template <class A>
Vector<A> operator+(const Vector<A>& a, const Vector<A>& b) {
  return {a.xyz + b.xyz};
}
template <class A>
Vector<A> operator-(const Vector<A>& a, const Vector<A>& b) {
  return {a.xyz - b.xyz};
}
template <class A>
Vector<A> operator*(double s, const Vector<A>& v) {
  return {s * v.xyz};
}

/// X_AB: the pose of frame B in frame A.
template <class A, class B>
struct Pose {
  glm::dquat rotation{1.0, 0.0, 0.0, 0.0};  ///< R_AB, unit, w first
  glm::dvec3 translation_mm{0.0};           ///< origin of B in A

  Pose<B, A> inverse() const {
    const glm::dquat R_BA = glm::conjugate(rotation);
    return {R_BA, R_BA * -translation_mm};
  }

  /// Column-major 4x4 for OpenGL and for files.
  glm::dmat4 matrix() const {
    glm::dmat4 m = glm::mat4_cast(rotation);
    m[3] = glm::dvec4(translation_mm, 1.0);
    return m;
  }
};

template <class A, class B, class C>
Pose<A, C> operator*(const Pose<A, B>& X_AB, const Pose<B, C>& X_BC) {
  return {X_AB.rotation * X_BC.rotation, X_AB.rotation * X_BC.translation_mm + X_AB.translation_mm};
}
template <class A, class B>
Point<A> operator*(const Pose<A, B>& X_AB, const Point<B>& p_B) {
  return {X_AB.rotation * p_B.mm + X_AB.translation_mm};
}
template <class A, class B>
Vector<A> operator*(const Pose<A, B>& X_AB, const Vector<B>& v_B) {
  return {X_AB.rotation * v_B.xyz};
}

}  // namespace calibration
