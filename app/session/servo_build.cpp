#include "app/session/servo_build.h"

#include "assets/instruction_set.h"
#include "haptics/servo/servo_revision.h"

namespace app {

bool ServoBuild::sumsIdentically(const ServoBuild& other) const {
  const auto portable = assets::nameOf(assets::InstructionSet::portable);
  return (instruction_set == portable) == (other.instruction_set == portable);
}

ServoBuild thisServo() {
  return {haptics::kServoRevision, std::string(assets::nameOf(assets::chosenInstructionSet()))};
}

}  // namespace app
