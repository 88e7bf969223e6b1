// The bone of an experiment and the probed site: a built-in phantom (flat cortical bone, or trabecular bone under a
// flat cut), a volume file, or a patient's jaw at the buccal trough. Frame P, mm. Start-up only: a phantom takes
// milliseconds, a patient a second or, the first time, up to a minute.
#pragma once

#include "app/psychophysics/protocol.h"
#include "assets/patient.h"

namespace app {

struct ProbedBone {
  assets::Patient patient;  ///< title and ct, and the rest of the source
  ProbeSite site;
};

/// Throws UsageError or assets::LoadError: no such file, or no bone under the site.
ProbedBone probedBone(const Protocol& protocol);

}  // namespace app
