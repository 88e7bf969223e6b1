#include "haptics/file/wall_kernels.h"

#include "assets/instruction_set.h"

namespace haptics {

// Direct calls, so that tests/architecture/servo_symbols.cmake can follow them.
bool castRays(const WallVoxels& wall, const SectionRays& rays, RayDepths& out) noexcept {
#if defined(__x86_64__)
  if (assets::chosenInstructionSet() == assets::InstructionSet::avx512) return avx512::castRays(wall, rays, out);
  if (assets::chosenInstructionSet() == assets::InstructionSet::avx2) return avx2::castRays(wall, rays, out);
#endif
  return portable::castRays(wall, rays, out);
}

}  // namespace haptics
