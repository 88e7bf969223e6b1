// Three Floats: vectors and colours of kLanes rays, with GLSL's names. Include only in kernel sources, as lanes.h.
#pragma once

#include "render/cpu/lanes.h"

namespace render::cpu {
namespace {

struct Float3 {
  Float x, y, z;
};

/// For the constants shared with the shaders.
inline Float3 vec3(double x, double y, double z) {
  return {splat(static_cast<float>(x)), splat(static_cast<float>(y)), splat(static_cast<float>(z))};
}
inline Float3 vec3(float x, float y, float z) { return {splat(x), splat(y), splat(z)}; }
inline Float3 vec3(Float value) { return {value, value, value}; }

inline Float3 operator+(const Float3& a, const Float3& b) { return {a.x + b.x, a.y + b.y, a.z + b.z}; }
inline Float3 operator-(const Float3& a, const Float3& b) { return {a.x - b.x, a.y - b.y, a.z - b.z}; }
inline Float3 operator*(const Float3& a, const Float3& b) { return {a.x * b.x, a.y * b.y, a.z * b.z}; }
inline Float3 operator*(Float s, const Float3& a) { return {s * a.x, s * a.y, s * a.z}; }
inline Float3 operator*(float s, const Float3& a) { return {s * a.x, s * a.y, s * a.z}; }
inline Float3 operator+(const Float3& a, float s) { return {a.x + s, a.y + s, a.z + s}; }
inline Float3 operator-(const Float3& a) { return {-a.x, -a.y, -a.z}; }

inline Float dot(const Float3& a, const Float3& b) { return a.x * b.x + a.y * b.y + a.z * b.z; }
inline Float length(const Float3& a) { return squareRoot(dot(a, a)); }
inline Float3 normalised(const Float3& a) { return inverseSquareRoot(dot(a, a)) * a; }
inline Float3 cross(const Float3& a, const Float3& b) {
  return {a.y * b.z - a.z * b.y, a.z * b.x - a.x * b.z, a.x * b.y - a.y * b.x};
}
inline Float3 mix(const Float3& from, const Float3& to, Float part) {
  return {mix(from.x, to.x, part), mix(from.y, to.y, part), mix(from.z, to.z, part)};
}
inline Float3 select(Mask mask, const Float3& yes, const Float3& no) {
  return {select(mask, yes.x, no.x), select(mask, yes.y, no.y), select(mask, yes.z, no.z)};
}

/// With edges per lane.
inline Float smoothStep(Float low, Float high, Float value) {
  const Float t = clamp((value - low) / (high - low), 0.0f, 1.0f);
  return t * t * (3.0f - 2.0f * t);
}

}  // namespace
}  // namespace render::cpu
