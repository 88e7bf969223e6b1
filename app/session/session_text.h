// The JSON texts of a session file: what the session is about, what has gone of which tissue, what the seal says.
// Tissues go by their keys, so a program with more, fewer or other numbers of them reads the same. A reader takes the
// keys it knows and has defaults for the rest. Any thread; allocates. Throws SessionError for what can not be read.
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

/// mm³ by the key of the tissue; what nothing is gone of is not listed.
using RemovedByTissue = std::map<std::string, double>;

RemovedByTissue removedByKey(std::span<const double> removed_mm3_by_tissue);
std::string removedText(const RemovedByTissue& removed_mm3);
RemovedByTissue removedFromText(std::string_view text);

/// Own label by stored label.
using LabelTable = std::array<std::uint8_t, 256>;

/// For labels that were numbered so; one of another name here, or none, is unlabelled.
LabelTable labelsOfKeys(std::span<const std::string_view> keys);

/// Judges a stored grid before voxels are allocated by it.
void refuseInvalidGrid(const assets::VolumeGrid& grid);

struct SessionAbout {
  StoredStart start;  ///< without voxels
  LabelTable label{};
};

std::string aboutText(const SessionStart& start);
SessionAbout aboutFromText(std::string_view text);

/// How the recording ended.
struct SessionEnd {
  std::uint64_t ticks = 0, lost = 0;
  std::optional<std::uint64_t> bone_digest;  ///< of the bone that was left; none: it was not kept
};

std::string sealText(const SessionEnd& end);
SessionEnd sealFromText(std::string_view text);

}  // namespace app
