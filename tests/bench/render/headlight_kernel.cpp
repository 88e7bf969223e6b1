// Compiled once for each instruction set (kernel_sources in render/CMakeLists.txt).

#include "render/cpu/lanes.h"
#include "tests/bench/render/headlight.h"

namespace render::cpu {
namespace {

/// Four values from `at` on along a row, as two pairs.
struct Row {
  Float before, low, high, behind;
};
inline Row rowOf(const std::uint16_t* field, Int at) {
  const IntPair four = gather64<2>(field, at);
  return {toFloat(four.low & 0xffff), toFloat(shiftRightLogical(four.low, 16)), toFloat(four.high & 0xffff),
          toFloat(shiftRightLogical(four.high, 16))};
}
/// Two values, mixed.
inline Float between(const std::uint16_t* field, Int at, Float part) {
  const Int two = gather32<2>(field, at);
  return mix(toFloat(two & 0xffff), toFloat(shiftRightLogical(two, 16)), part);
}

void headlightOf(const bench::HeadlightJob& job) {
  for (int n = 0; n < job.count; n += kLanes) {
    const Mask real = firstLanes(job.count - n);
    const Int ray = load(job.ray + n) & real;
    const Float length = select(real, load(job.length + n), 0.0f);
    const Float dx = gather(job.x, ray, real), dy = gather(job.y, ray, real), dz = gather(job.z, ray, real);
    // Places from the border's corner, kept within the volume.
    const Float x = maximum(multiplyAdd(length, dx, splat(job.eye[0] + 1.0f)), 1.0f);
    const Float y = maximum(multiplyAdd(length, dy, splat(job.eye[1] + 1.0f)), 1.0f);
    const Float z = maximum(multiplyAdd(length, dz, splat(job.eye[2] + 1.0f)), 1.0f);
    const Int i = toInt(x), j = toInt(y), k = toInt(z);
    const Float fx = x - toFloat(i), fy = y - toFloat(j), fz = z - toFloat(k);
    const Int at = (i + j * job.row + k * job.slice) & real;

    // Central differences of the eight corners share twelve rows.
    const auto across = [&](Int first, Float& slope) {
      const Row row = rowOf(job.smooth, (first - 1) & real);
      slope = mix(row.high - row.before, row.behind - row.low, fx);
      return mix(row.low, row.high, fx);
    };
    Float s00, s10, s01, s11;
    const Float v00 = across(at, s00), v10 = across(at + job.row, s10);
    const Float v01 = across(at + job.slice, s01), v11 = across(at + job.row + job.slice, s11);
    const auto only = [&](Int first) { return between(job.smooth, first & real, fx); };
    const Float gx = mix(mix(s00, s10, fy), mix(s01, s11, fy), fz);
    const Float gy = mix(mix(v10 - only(at - job.row), only(at + 2 * job.row) - v00, fy),
                         mix(v11 - only(at + job.slice - job.row), only(at + job.slice + 2 * job.row) - v01, fy), fz);
    const Float gz = mix(mix(v01 - only(at - job.slice), v11 - only(at + job.row - job.slice), fy),
                         mix(only(at + 2 * job.slice) - v00, only(at + job.row + 2 * job.slice) - v10, fy), fz);

    const Float facing = absolute(multiplyAdd(gx, dx, multiplyAdd(gy, dy, gz * dz))) *
                         inverseSquareRoot(multiplyAdd(gx, gx, multiplyAdd(gy, gy, multiplyAdd(gz, gz, splat(1.0f)))));
    const Float c2 = facing * facing, c4 = c2 * c2, c16 = c4 * c4 * c4 * c4;
    const Float weight = load(job.weight + n), diffuse = weight * (0.2f + 0.7f * facing),
                shine = weight * 0.3f * c16 * c4;

    // The nearest voxel's colour, kept as its square root.
    const Int nearest = toInt(x + 0.5f) + toInt(y + 0.5f) * job.row + toInt(z + 0.5f) * job.slice;
    const Int appearance = gather(job.appearance, nearest, real);
    const auto channel = [&](int shift) {
      const Float root = toFloat(shiftRightLogical(appearance, shift) & 255) * (1.0f / 255.0f);
      return multiplyAdd(root * root, diffuse, shine);
    };
    float r[kLanes], g[kLanes], b[kLanes];
    store(r, channel(0));
    store(g, channel(8));
    store(b, channel(16));
    const int filled = job.count - n < kLanes ? job.count - n : kLanes;
    for (int lane = 0; lane < filled; ++lane) {
      const std::int32_t to = job.ray[n + lane];
      job.r[to] += r[lane];
      job.g[to] += g[lane];
      job.b[to] += b[lane];
    }
  }
}

}  // namespace
}  // namespace render::cpu

namespace bench::KERNEL_SET {

void headlight(const HeadlightJob& job) noexcept { render::cpu::headlightOf(job); }

}  // namespace bench::KERNEL_SET
