#include "haptics/bone/instruction_set.h"

#include <cstdlib>
#include <string_view>

namespace haptics {
namespace {

InstructionSet choose() {
  const char* name = std::getenv("MOLAR_INSTRUCTIONS");
  const std::string_view wish = name == nullptr ? "" : name;
  if (wish == "portable") return InstructionSet::portable;
  if (available(InstructionSet::avx512) && wish != "avx2") return InstructionSet::avx512;
  return available(InstructionSet::avx2) ? InstructionSet::avx2 : InstructionSet::portable;
}

const InstructionSet kChosen = choose();

}  // namespace

bool available(InstructionSet set) noexcept {
#if defined(__x86_64__)
  if (set == InstructionSet::avx2) return __builtin_cpu_supports("avx2") && __builtin_cpu_supports("fma");
  if (set == InstructionSet::avx512)
    return __builtin_cpu_supports("avx512f") && __builtin_cpu_supports("avx512bw") &&
           __builtin_cpu_supports("avx512dq") && __builtin_cpu_supports("avx512vl") && available(InstructionSet::avx2);
#endif
  return set == InstructionSet::portable;
}

InstructionSet chosenInstructionSet() noexcept { return kChosen; }

}  // namespace haptics
