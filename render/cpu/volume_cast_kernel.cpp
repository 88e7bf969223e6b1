// The kernels of volume_cast.h, compiled once for each instruction set; internal linkage but for the table. They follow
// shaders/ray_march.glsl, ray_cast.glsl and ray_translucent.glsl, except for the skipping of empty space. Positions
// count from the corner of the border of SolidCells, so they are not negative inside the volume; lengths in voxels.
#include "render/cpu/lanes.h"
#include "render/cpu/volume_cast_kernels.h"

namespace render::cpu {
namespace {

constexpr int kMaxRays = 256, kBeamRays = 64;
constexpr int kEdge = 8, kRowWords = 9, kLayerWords = 72, kBrickWords = 576;  // SolidCells
constexpr float kGuard = 1e-3f;  // a skip ends this much early, so that rounding cannot carry it past something solid
constexpr float kFar = 1e9f;
constexpr float kFull = 255.0f * 32767.0f;  // value of a sample in solid matter
constexpr float kIso = 0.5f * kFull;
constexpr int kBisections = 6;
constexpr float kOpaque = 0.98f;

struct Position {
  Float x, y, z;
};

/// kLanes rays: unit direction, its inverse, entry, length to it, and index of the last sample (negative: none).
struct Rays {
  Position direction, inverse, entry;
  Float near, last;
};

inline Float inverseOf(Float direction) { return 1.0f / select(absolute(direction) < 1e-9f, splat(1e-9f), direction); }

inline Position positionAt(const Rays& rays, Float t) {
  return {multiplyAdd(t, rays.direction.x, rays.entry.x), multiplyAdd(t, rays.direction.y, rays.entry.y),
          multiplyAdd(t, rays.direction.z, rays.entry.z)};
}

/// Rays from directions, beginnings and limits in mm.
inline Rays aimed(const CastJob& job, Float x, Float y, Float z, Float begin_mm, Float limit_mm) {
  Rays rays;
  rays.direction = {x, y, z};
  rays.inverse = {inverseOf(x), inverseOf(y), inverseOf(z)};
  const Float* const inverse[3] = {&rays.inverse.x, &rays.inverse.y, &rays.inverse.z};
  Float near = begin_mm * job.voxels_per_mm, far = limit_mm * job.voxels_per_mm;
  for (int a = 0; a < 3; ++a) {
    const Float p = (kEdge - 1.0f - job.eye[a]) * *inverse[a], q = (job.size[a] + kEdge - job.eye[a]) * *inverse[a];
    near = maximum(near, minimum(p, q));
    far = minimum(far, maximum(p, q));
  }
  rays.near = near;
  rays.last = select(near < far, floor((far - near) / job.step), splat(-1.0f));
  rays.entry = {multiplyAdd(near, x, splat(job.eye[0])), multiplyAdd(near, y, splat(job.eye[1])),
                multiplyAdd(near, z, splat(job.eye[2]))};
  return rays;
}

/// A cone around rays from the eye: at length t each of them is within t · spread of t · axis, per coordinate.
struct Cone {
  float axis[3], spread[3];
};

inline Cone coneOf(const CastJob& job, int first, int count) {
  Cone cone{};
  const float* const directions[3] = {job.x, job.y, job.z};
  for (int a = 0; a < 3; ++a) {
    Float low = splat(2.0f), high = splat(-2.0f);
    for (int n = first; n < first + count; n += kLanes) {
      const Float d = load(directions[a] + n);
      const Mask real = firstLanes(first + count - n);
      low = minimum(low, select(real, d, low));
      high = maximum(high, select(real, d, high));
    }
    float least = 2.0f, most = -2.0f;
    for (int n = 0; n < kLanes; ++n) {
      least = low[n] < least ? low[n] : least;
      most = high[n] > most ? high[n] : most;
    }
    cone.axis[a] = 0.5f * (least + most);
    cone.spread[a] = 0.5f * (most - least) + 1e-6f;
  }
  return cone;
}

/// Length over which all rays of the cone meet nothing solid; kFar if they never do.
float emptyLength(const CastJob& job, const Cone& cone) {
  // Range in which they can be in the volume.
  float from = 0.0f, to = kFar, low_slope[3], high_slope[3];
  for (int a = 0; a < 3; ++a) {
    low_slope[a] = cone.axis[a] - cone.spread[a];
    high_slope[a] = cone.axis[a] + cone.spread[a];
    const float to_low = kEdge - 1.0f - job.eye[a], to_high = job.size[a] + kEdge - job.eye[a];
    if (to_low > 0.0f) {
      if (high_slope[a] <= 0.0f) return kFar;
      from = from > to_low / high_slope[a] ? from : to_low / high_slope[a];
    } else if (high_slope[a] < 0.0f) {
      to = to < to_low / high_slope[a] ? to : to_low / high_slope[a];
    }
    if (to_high < 0.0f) {
      if (low_slope[a] >= 0.0f) return kFar;
      from = from > to_high / low_slope[a] ? from : to_high / low_slope[a];
    } else if (low_slope[a] > 0.0f) {
      to = to < to_high / low_slope[a] ? to : to_high / low_slope[a];
    }
  }

  // From empty box to empty box; everything outside the table is empty.
  float t = from - kGuard > 0.0f ? from - kGuard : 0.0f;
  while (t < to) {
    int brick[3], index = 0;
    for (int a = 2; a >= 0; --a) {
      const float p = job.eye[a] + t * cone.axis[a];
      const int cell = p > 0.0f ? static_cast<int>(p < 1e6f ? p : 1e6f) : 0, at = cell / kEdge;
      brick[a] = at < job.bricks[a] ? at : job.bricks[a] - 1;
      index = index * job.bricks[a] + brick[a];
    }
    const int away = -job.table[index];
    if (away <= 0) return t;
    float leave = kFar;
    for (int a = 0; a < 3; ++a) {
      const int low = brick[a] - away + 1, high = brick[a] + away;
      // A wide cone may reach out of the box, or not be in it yet.
      if (low > 0 && job.eye[a] + t * low_slope[a] < static_cast<float>(low * kEdge)) return t;
      if (high < job.bricks[a] && job.eye[a] + t * high_slope[a] > static_cast<float>(high * kEdge)) return t;
      if (low > 0 && low_slope[a] < 0.0f) {
        const float reached = (static_cast<float>(low * kEdge) - job.eye[a]) / low_slope[a];
        leave = leave < reached ? leave : reached;
      }
      if (high < job.bricks[a] && high_slope[a] > 0.0f) {
        const float reached = (static_cast<float>(high * kEdge) - job.eye[a]) / high_slope[a];
        leave = leave < reached ? leave : reached;
      }
    }
    leave -= kGuard;
    if (leave < t + 0.25f) return t;
    t = leave;
  }
  return kFar;
}

/// The cell of a position.
struct Cell {
  Int i, j, k;
};
inline Cell cellAt(const Position& position) { return {toInt(position.x), toInt(position.y), toInt(position.z)}; }
inline Int brickIndex(const CastJob& job, const Cell& cell) {
  return (cell.i >> 3) + ((cell.j >> 3) + (cell.k >> 3) * job.bricks[1]) * job.bricks[0];
}

/// Trilinear from the words of the eight corners.
inline Float interpolated(IntPair corners, const Position& position, const Cell& cell) {
  const Float x = position.x - toFloat(cell.i), y = position.y - toFloat(cell.j), z = position.z - toFloat(cell.k);
  const Int high = toInt(multiplyAdd(z, splat(32767.0f), splat(0.5f))), parts = (high << 16) | (32767 - high);
  constexpr std::int32_t kEven = 0x00ff00ff;
  const Float low_j = toFloat(pairSums(corners.low & kEven, parts));
  const Float high_j = toFloat(pairSums(shiftRightLogical(corners.low, 8) & kEven, parts));
  const Float low_j_next = toFloat(pairSums(corners.high & kEven, parts));
  const Float high_j_next = toFloat(pairSums(shiftRightLogical(corners.high, 8) & kEven, parts));
  return mix(mix(low_j, high_j, y), mix(low_j_next, high_j_next, y), x);
}

/// `where`: the table entry of the brick.
inline Float sampleCells(const CastJob& job, Int where, const Position& position, const Cell& cell) {
  const Int word = (where >> 8) * kBrickWords + (cell.i & 7) + (cell.j & 7) * kRowWords + (cell.k & 7) * kLayerWords;
  return interpolated(gather64<4>(job.words, word), position, cell);
}

/// The same from the field, in lanes of the mask.
inline Float sampleField(const CastJob& job, Mask wanted, const Position& position, const Cell& outer) {
  // Rounding may put the entry of a ray just outside the border.
  const Int border = splat(kEdge - 1);
  const Cell cell{maximum(outer.i, border), maximum(outer.j, border), maximum(outer.k, border)};
  const Int at = (cell.i - (kEdge - 1)) + (cell.j - (kEdge - 1)) * job.row + (cell.k - (kEdge - 1)) * job.slice;
  const auto corners = [&](Int first) {
    return gather(job.solid, first, wanted) | (gather(job.solid, first + job.row, wanted) << 8) |
           (gather(job.solid, first + job.slice, wanted) << 16) |
           (gather(job.solid, first + job.row + job.slice, wanted) << 24);
  };
  return interpolated({corners(at), corners(at + 1)}, position, cell);
}

/// Samples in lanes of the mask; 0 where there are no cells.
template <bool kSkip>
inline Float sample(const CastJob& job, Mask wanted, const Position& position) {
  const Cell cell = cellAt(position);
  if constexpr (!kSkip) return sampleField(job, wanted, position, cell);
  const Int where = gather(job.table, brickIndex(job, cell), wanted);
  return select(where >= 0, sampleCells(job, maximum(where, splat(0)), position, cell), 0.0f);
}

/// Lanes whose cell is in an eighth of a brick that has something solid; `where` is not negative.
inline Mask isSolidEighth(Int where, const Cell& cell) {
  const Int bit = ((cell.i >> 2) & 1) | ((cell.j >> 1) & 2) | (cell.k & 4);
  return ((where >> bit) & 1) != 0;
}

/// Index of the first sample behind the empty bricks around a cell or, if the brick has cells, behind its eighth.
inline Float skipped(const CastJob& job, const Rays& rays, const Cell& cell, Int where, Float k) {
  const Mask is_brick = where < 0;
  const Int edge = select(is_brick, splat(8), splat(4)), above = select(is_brick, where * -8, splat(4));
  const auto leave = [&](Int at, Float direction, Float inverse, Float entry) {
    const Int base = at & -edge;
    const Int bound = select(direction > 0.0f, base + above, base - above + edge);
    return (toFloat(bound) - entry) * inverse;
  };
  const Float length = minimum(leave(cell.i, rays.direction.x, rays.inverse.x, rays.entry.x),
                               minimum(leave(cell.j, rays.direction.y, rays.inverse.y, rays.entry.y),
                                       leave(cell.k, rays.direction.z, rays.inverse.z, rays.entry.z))) -
                       kGuard;
  return maximum(k + 1.0f, ceiling(length / job.step));
}

/// Index of the first sample that can be solid.
inline Float firstSample(const CastJob& job, const Rays& rays, float from) {
  return maximum(ceiling((from - kGuard - rays.near) / job.step), 0.0f);
}

/// Marches along kLanes rays; visit(lanes, values, position, k) returns the rays that end there.
template <bool kSkip, class Visit>
inline void march(const CastJob& job, const Rays& rays, Mask active, Float k, Visit visit) {
  active &= k <= rays.last;
  [[maybe_unused]] const int last_brick = job.bricks[0] * job.bricks[1] * job.bricks[2] - 1;
  while (any(active)) {
    const Position position = positionAt(rays, k * job.step);
    const Cell cell = cellAt(position);
    Mask wanted = active;
    Float value;
    if constexpr (kSkip) {
      // For all lanes, so that the next step does not depend on the result of this one.
      const Int where = gather32<4>(job.table, clamp(brickIndex(job, cell), 0, last_brick));
      const Mask empty = (where < 0) | ~isSolidEighth(where, cell);
      wanted &= ~empty;
      Float next = k + 1.0f;
      if (any(empty & active)) next = select(empty, skipped(job, rays, cell, where, k), next);
      if (any(wanted)) {
        value = sampleCells(job, where & ~empty, position, cell);
        active &= ~visit(wanted, value, position, k);
      }
      k = next;
    } else {
      value = sampleField(job, wanted, position, cell);
      active &= ~visit(wanted, value, position, k);
      k = k + 1.0f;
    }
    active &= k <= rays.last;
  }
}

/// Rays of the batch by index.
inline Rays chosen(const CastJob& job, Int number, Mask wanted) {
  return aimed(job, gather(job.x, number, wanted), gather(job.y, number, wanted), gather(job.z, number, wanted),
               gather(job.begin_mm, number, wanted), gather(job.limit_mm, number, wanted));
}

/// Calls cast(first, from) for every kLanes rays that can hit something; they are empty up to `from`.
template <class Cast>
inline void forPackets(const CastJob& job, Cast cast) {
  for (int beam = 0; beam < job.count; beam += kBeamRays) {
    const int end = beam + kBeamRays < job.count ? beam + kBeamRays : job.count;
    const float from = job.skip ? emptyLength(job, coneOf(job, beam, end - beam)) : 0.0f;
    if (from < kFar)
      for (int first = beam; first < end; first += kLanes) cast(first, from);
  }
}

template <bool kSkip>
inline void surfaceBy(CastJob& job) {
  // March to the first solid sample; rays that have one are stored contiguously.
  alignas(64) std::int32_t ray[kMaxRays + kLanes];
  alignas(64) float number[kMaxRays + kLanes];
  int hits = 0;
  forPackets(job, [&](int first, float from) {
    const Rays rays = aimed(job, load(job.x + first), load(job.y + first), load(job.z + first),
                            load(job.begin_mm + first), load(job.limit_mm + first));
    Mask found = splat(0);
    Float at = splat(0.0f);
    march<kSkip>(job, rays, firstLanes(job.count - first), firstSample(job, rays, from),
                 [&](Mask wanted, Float value, const Position&, Float k) {
                   const Mask solid = wanted & (value >= kIso);
                   found |= solid;
                   at = select(solid, k, at);
                   return solid;
                 });
    compress(ray + hits, laneNumbers() + first, found);
    hits += compress(number + hits, at, found);
  });

  // Bisect between the last two samples.
  for (int n = 0; n < hits; n += kLanes) {
    const Mask real = firstLanes(hits - n);
    const Int which = load(ray + n) & real;
    const Rays rays = chosen(job, which, real);
    const Float k = select(real, load(number + n), 1.0f);
    Float low = (k - 1.0f) * job.step, high = k * job.step;
    for (int i = 0; i < kBisections; ++i) {
      const Float middle = 0.5f * (low + high);
      const Mask solid = sample<kSkip>(job, real & (k > 0.0f), positionAt(rays, middle)) >= kIso;
      high = select(solid, middle, high);
      low = select(solid, low, middle);
    }
    if (job.points + kLanes > job.capacity) job.room(job);
    store(job.ray + job.points, which);
    store(job.length + job.points, rays.near + select(k > 0.0f, high, 0.0f));
    store(job.weight + job.points, splat(1.0f));
    job.points += hits - n < kLanes ? hits - n : kLanes;
  }
}

template <bool kSkip>
inline void translucentBy(CastJob& job) {
  for (int n = 0; n < job.count; n += kLanes) {
    store(job.sum + n, splat(0.0f));
    store(job.reach + n, splat(-1.0f));
  }
  const float start = job.ramp_start * kFull, per_value = job.ramp_per_solid * 256.0f / kFull;
  forPackets(job, [&](int first, float from) {
    const Rays rays = aimed(job, load(job.x + first), load(job.y + first), load(job.z + first),
                            load(job.begin_mm + first), load(job.limit_mm + first));
    Float sum = splat(0.0f), reach = splat(-1.0f);
    march<kSkip>(job, rays, firstLanes(job.count - first), firstSample(job, rays, from),
                 [&](Mask wanted, Float value, const Position& position, Float k) {
                   Mask shows = wanted & (value > start);
                   if (none(shows)) return shows;

                   // Opacity of the step, by the tissue of the nearest voxel.
                   const Float share = minimum((value - start) * per_value, 256.0f);
                   const Cell near = cellAt({position.x + 0.5f, position.y + 0.5f, position.z + 0.5f});
                   const Int at =
                       (near.i - (kEdge - 1)) + (near.j - (kEdge - 1)) * job.row + (near.k - (kEdge - 1)) * job.slice;
                   const Int label = minimum(gather(job.label, at, shows), splat(job.last_label));
                   const Int interval = minimum(toInt(share), splat(255));
                   const IntPair ends = gather64<4>(job.opacity, (label * 257 + interval) & shows);
                   const Float alpha = mix(floatOfBits(ends.low), floatOfBits(ends.high), share - toFloat(interval));
                   shows &= alpha > 0.0f;

                   // Its share of the ray.
                   const Float weight = select(shows, (1.0f - sum) * alpha, 0.0f),
                               length = multiplyAdd(k, splat(job.step), rays.near);
                   sum = sum + weight;
                   reach = select((reach < 0.0f) & (sum >= 0.5f), length, reach);
                   if (job.points + kLanes > job.capacity) job.room(job);
                   compress(job.ray + job.points, laneNumbers() + first, shows);
                   compress(job.length + job.points, length, shows);
                   job.points += compress(job.weight + job.points, weight, shows);
                   return shows & (sum >= kOpaque);
                 });
    store(job.sum + first, sum);
    store(job.reach + first, reach);
  });
}

void surface(CastJob& job) {
  if (job.skip)
    surfaceBy<true>(job);
  else
    surfaceBy<false>(job);
}
void translucent(CastJob& job) {
  if (job.skip)
    translucentBy<true>(job);
  else
    translucentBy<false>(job);
}

}  // namespace
}  // namespace render::cpu

namespace render::KERNEL_SET {

const CastKernels kCastKernels{cpu::surface, cpu::translucent};

}  // namespace render::KERNEL_SET
