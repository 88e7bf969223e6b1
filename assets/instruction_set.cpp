#include "assets/instruction_set.h"

#include <cstdlib>
#include <string_view>

namespace assets {
namespace {

struct Machine {
  bool avx2 = false, avx512 = false;
  InstructionSet chosen = InstructionSet::portable;
};

Machine detect() {
  Machine machine;
#if defined(__x86_64__)
  machine.avx2 = __builtin_cpu_supports("avx2") && __builtin_cpu_supports("fma");
  machine.avx512 = machine.avx2 && __builtin_cpu_supports("avx512f") && __builtin_cpu_supports("avx512bw") &&
                   __builtin_cpu_supports("avx512dq") && __builtin_cpu_supports("avx512vl");
#endif
  const char* name = std::getenv("MOLAR_INSTRUCTIONS");
  const std::string_view requested = name == nullptr ? "" : name;
  if (requested == "portable") return machine;
  if (machine.avx2) machine.chosen = InstructionSet::avx2;
  if (machine.avx512 && requested != "avx2") machine.chosen = InstructionSet::avx512;
  return machine;
}

/// Initialised before main, so that the servo only loads it.
const Machine kMachine = detect();

}  // namespace

bool available(InstructionSet set) noexcept {
  if (set == InstructionSet::avx2) return kMachine.avx2;
  return set == InstructionSet::portable || kMachine.avx512;
}

InstructionSet chosenInstructionSet() noexcept { return kMachine.chosen; }

}  // namespace assets
