// A tooth that is prepared for a restoration: which one, how it stands, and the name of the ideal it is measured
// against; or the ideal itself, of a file. Frame P, mm. Plain data; any thread.
#pragma once

#include <cstdint>
#include <optional>
#include <string>
#include <vector>

#include "assets/opposing_teeth.h"
#include "assets/tooth_canals.h"
#include "assets/volume_grid.h"

namespace assets {

/// What is to be left of the crown, as a file gave it. Never more than the tooth has; what stands around is as it was.
struct GivenIdeal {
  std::string digest;               ///< SHA-256 of the file, hexadecimal; its name and place are not kept
  VolumeGrid grid;                  ///< a box of the patient's grid
  std::vector<std::uint8_t> solid;  ///< 0..255, i fastest
};

/// PreparedTooth::ideal where it was given by a file.
inline constexpr const char* kGivenIdeal = "file";

struct PreparedTooth {
  int fdi = 0;
  ToothFrame frame;
  std::string ideal;                ///< "crown:all-ceramic"; kGivenIdeal
  std::string caries;               ///< where a lesion was placed: "occlusal"; empty: none
  std::optional<GivenIdeal> given;  ///< none: by rule
  ToothBite bite = {};
  std::optional<OpposingTeeth> opposing = {};  ///< none: made of the tooth itself
};

}  // namespace assets
