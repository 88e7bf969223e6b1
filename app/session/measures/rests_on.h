// Which of a rehearsal's numbers rest on the operated tooth (numbers of teeth, labels of bone and tooth, the plan made
// for it) or on the mandibular canal: where the program found these in a scan and no person has confirmed them, such a
// number is told as not confirmed. Ids of measures and keys of metrics.h. Pure; any thread; nanoseconds.
#pragma once

#include <string_view>

#include "assets/proposed.h"
#include "assets/risk_structures.h"

namespace app {

/// What the number of this id or key rests on.
assets::Proposed restsOn(std::string_view id);

/// False: it rests on what nobody has confirmed.
inline bool isConfirmed(std::string_view id, const assets::Proposed& proposed) {
  const assets::Proposed rests = restsOn(id);
  return !(rests.tooth && proposed.tooth) && !(rests.canal && proposed.canal);
}

/// A distance to this structure: lingual surface and second molar are told by the operated tooth.
inline bool isConfirmed(assets::RiskStructure structure, const assets::Proposed& proposed) {
  return structure == assets::RiskStructure::canal ? !proposed.canal : !proposed.tooth;
}

}  // namespace app
