// The plain appearance that the bench compares with VTK's: a lamp at the eye, diffuse and a highlight, the normal by
// central differences of the smoothed field, the colour of the nearest voxel. What VTK computes per sample, and no
// more. Written in lanes and compiled for the machine's instruction sets like the product's kernels.
#pragma once

#include <cstdint>

#include "assets/instruction_set.h"

namespace bench {

struct HeadlightJob {
  const std::uint16_t* smooth;  ///< voxel (-1,-1,-1), and the strides of both fields
  const std::uint32_t* appearance;
  std::int32_t row, slice;
  float eye[3];             ///< continuous index
  const float *x, *y, *z;   ///< of the rays
  const std::int32_t* ray;  ///< of the points
  const float *length, *weight;
  std::int32_t count;
  float *r, *g, *b;  ///< of the rays: the light is added
};

void headlight(const HeadlightJob& job, assets::InstructionSet set);

namespace portable {
void headlight(const HeadlightJob& job) noexcept;
}
#if defined(__x86_64__)
namespace avx2 {
void headlight(const HeadlightJob& job) noexcept;
}
namespace avx512 {
void headlight(const HeadlightJob& job) noexcept;
}
#endif

}  // namespace bench
