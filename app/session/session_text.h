// The JSON texts of a session file: start, removed volumes, seal. Tissues are stored by key, so programs with other
// tissues can read them. Unknown keys are ignored, missing ones have defaults. Any thread; allocates. Throws
// SessionError for invalid text.
#pragma once

#include <array>
#include <cstdint>
#include <map>
#include <optional>
#include <span>
#include <string>
#include <string_view>

#include "app/session/session_start.h"

namespace app {

/// Removed mm³ by the key of the tissue; zeros are not listed.
using RemovedByTissue = std::map<std::string, double>;

RemovedByTissue removedByKey(std::span<const double> removed_mm3_by_tissue);
std::string removedText(const RemovedByTissue& removed_mm3);
RemovedByTissue removedFromText(std::string_view text);

/// This program's label for each stored label.
using LabelTable = std::array<std::uint8_t, 256>;

/// For labels numbered in this order; unknown keys are unlabelled.
LabelTable labelsOfKeys(std::span<const std::string_view> keys);

/// Call before allocating voxels. Throws SessionError.
void refuseInvalidGrid(const assets::VolumeGrid& grid);

struct SessionAbout {
  StoredStart start;  ///< without voxels
  LabelTable label{};
  std::vector<double> laid_before_age_s;  ///< by increment
};

std::string aboutText(const SessionStart& start);
SessionAbout aboutFromText(std::string_view text);

/// How the recording ended.
struct SessionEnd {
  std::uint64_t ticks = 0, lost = 0;
  std::optional<std::uint64_t> bone_digest;  ///< of the final bone; none: not stored
};

std::string sealText(const SessionEnd& end);
SessionEnd sealFromText(std::string_view text);

}  // namespace app
