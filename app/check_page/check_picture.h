// The check page of a patient as one picture, without a window and without looking for anything: what was found, for
// whoever looks into the folder. Frame P. Any one thread; 0.5 s for 512^3.
#pragma once

#include <cstdint>
#include <string>
#include <vector>

#include "assets/patient.h"
#include "assets/segment/jaw_segmentation.h"
#include "render/image.h"

namespace app {

/// What a patient holds, as if it had just been found; without labels.
assets::JawSegmentation foundIn(const assets::Patient& patient);

/// What its voxels belong to. Of what the program found teeth without a number are bone until it is found again: most
/// of them are upper ones.
std::vector<std::uint8_t> whatIn(const assets::Patient& patient);

render::Image checkPicture(const assets::Patient& patient);

/// As check.png in its folder. Throws CalibrationError.
void keepCheckPicture(const assets::Patient& patient, const std::string& folder);

}  // namespace app
