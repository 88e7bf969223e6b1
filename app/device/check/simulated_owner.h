// A simulated owner that does at once what the check requests: moves there at up to 250 mm/s, presses, lets go. Frame
// D, mm. perform(): one thread; the script: the device's, which must not outlive this object.
#pragma once

#include <atomic>

#include "app/device/check/dialogue.h"
#include "haptics/device/simulated/hand_script.h"
#include "haptics/device/simulated/phantom_mechanics.h"

namespace app {

class SimulatedOwner final : public Owner {
 public:
  explicit SimulatedOwner(const haptics::PhantomMechanics& phantom);

  haptics::HandScript script();
  void perform(OwnerTask task) override { task_.store(task); }

 private:
  glm::dvec3 goal_mm(OwnerTask task) const;

  glm::dvec3 rest_mm_, middle_mm_, corner_mm_;
  glm::dquat rotation_;
  std::atomic<OwnerTask> task_{OwnerTask::rest};
};

}  // namespace app
