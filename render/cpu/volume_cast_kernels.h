// Arguments of a casting kernel as plain values and pointers, with no inline functions that could be compiled for one
// instruction set and linked into another. Private to volume_cast.
#pragma once

#include <cstdint>

namespace render {

struct CastJob {
  // The cells, and the field for rays without skipping.
  const std::uint32_t* words;
  const std::int32_t* table;
  std::int32_t bricks[3];
  const std::uint8_t* solid;  ///< voxel (-1,-1,-1)
  std::int32_t row, slice;
  float size[3];
  // The rays; arrays are readable to the next multiple of 16.
  float eye[3];  ///< from the corner of the cells' border, as all positions here
  const float *x, *y, *z, *begin_mm, *limit_mm;
  std::int32_t count;
  float voxels_per_mm, step;
  bool skip;
  // Results; `room` reserves 16 more and updates the three pointers.
  void (*room)(CastJob& job);
  void* owner;
  std::int32_t *ray, points, capacity;
  float *length, *weight;
  // The translucent view only.
  const std::uint8_t* label;  ///< voxel (-1,-1,-1); strides as solid
  const float* opacity;       ///< kIntervals + 1 of every label
  std::int32_t last_label;
  float ramp_start, ramp_per_solid;
  float *sum, *reach;
};

struct CastKernels {
  void (*surface)(CastJob& job);
  void (*translucent)(CastJob& job);
};

namespace portable {
extern const CastKernels kCastKernels;
}
#if defined(__x86_64__)
namespace avx2 {
extern const CastKernels kCastKernels;
}
namespace avx512 {
extern const CastKernels kCastKernels;
}
#else
namespace avx2 = portable;
namespace avx512 = portable;
#endif

}  // namespace render
