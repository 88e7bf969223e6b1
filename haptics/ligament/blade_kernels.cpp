#include "haptics/ligament/blade_kernels.h"

#include "assets/instruction_set.h"

namespace haptics {

// Direct calls, so that tests/architecture/servo_symbols.cmake can follow them.
int nearBlade(const BladeOutline& blade, const BladePlace& place, const BladeSamples& samples, float within,
              std::uint16_t* index, int most) noexcept {
#if defined(__x86_64__)
  if (assets::chosenInstructionSet() == assets::InstructionSet::avx512)
    return avx512::nearBlade(blade, place, samples, within, index, most);
  if (assets::chosenInstructionSet() == assets::InstructionSet::avx2)
    return avx2::nearBlade(blade, place, samples, within, index, most);
#endif
  return portable::nearBlade(blade, place, samples, within, index, most);
}

void bladeGaps(const BladeOutline& blade, const BladePlace& place, const BladeSamples& samples,
               const BladeGaps& gaps) noexcept {
#if defined(__x86_64__)
  if (assets::chosenInstructionSet() == assets::InstructionSet::avx512)
    return avx512::bladeGaps(blade, place, samples, gaps);
  if (assets::chosenInstructionSet() == assets::InstructionSet::avx2)
    return avx2::bladeGaps(blade, place, samples, gaps);
#endif
  return portable::bladeGaps(blade, place, samples, gaps);
}

}  // namespace haptics
