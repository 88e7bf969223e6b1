// A single tooth set into a row as a dentoform has it: the tooth stays where its volume has it, and the built-in
// patient's bone, gum and the teeth beside are brought to it by the frames of the two teeth, moved apart until they
// touch it. Upper teeth stand in the same row, turned over. The row is coarse (voxels of 0.25 mm) and its teeth are
// tissue other_teeth. Frame P of the tooth's volume, mm. Start-up only; some seconds, 5 bytes a voxel.
#pragma once

#include <string>
#include <vector>

#include "assets/import/tooth_volume.h"
#include "assets/patient.h"
#include "assets/synthetic/jaw.h"

namespace app {

/// The jaw whose row a tooth is set into.
assets::JawParameters dentoformJaw(int fdi);

/// Whether the row has a place for it.
bool isInDentoform(int fdi);

struct DentoformTooth {
  assets::Patient patient;
  std::vector<std::string> remarks;
};

/// `jaw`: the built-in patient of dentoformJaw(fdi). Throws UsageError, beginning with `name`, where the tooth leaves
/// no room for those beside it.
DentoformTooth dentoformTooth(const assets::ToothVolume& tooth, const assets::Patient& jaw, int fdi,
                              const std::string& name);

}  // namespace app
