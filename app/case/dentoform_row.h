// A single tooth set into a row as a dentoform has it: the tooth stays where its volume has it, and the built-in
// patient's bone, gum and the teeth beside (in front a row of its own) are brought to it by the frames of the two
// teeth, moved apart until they touch it. Upper teeth stand in the same row, turned over. The row is coarse (voxels of
// 0.25 mm) and its teeth are tissue other_teeth. Frame P of the tooth's volume, mm. Start-up only; some seconds, 5
// bytes a voxel.
#pragma once

#include <string>
#include <vector>

#include "assets/import/tooth_volume.h"
#include "assets/patient.h"
#include "assets/synthetic/jaw.h"

namespace app {

/// The jaw whose row a premolar or molar is set into.
assets::JawParameters dentoformJaw(int fdi);

/// Whether a row has a place for it: every tooth of adults.
bool isInDentoform(int fdi);
/// An incisor or a canine: it stands in assets::frontRow().
bool isInFront(int fdi);

struct DentoformTooth {
  assets::Patient patient;
  std::vector<std::string> remarks;
};

/// `jaw`: the volume of the built-in patient of dentoformJaw(fdi), or the front row. Throws UsageError, beginning with
/// `name`, where the tooth leaves no room for those beside it.
DentoformTooth dentoformTooth(const assets::ToothVolume& tooth, const assets::CtVolume& jaw, int fdi,
                              const std::string& name);

}  // namespace app
