// Pictures as PNG files: snapshots, board photographs, reports. 8-bit RGBA, rows from the top.
// Any thread; milliseconds. Not the renderer's images in memory, not video.
#pragma once

#include <cstdint>
#include <span>
#include <string>

#include <glm/glm.hpp>

#include "calibration/calibration_error.h"

namespace calibration {

/// `rgba`: size_px.x * size_px.y * 4 bytes, top row first. Writes exactly to `path`, whatever its ending; the caller
/// renames it into place. Throws CalibrationError when it can not be written.
void writePng(const std::string& path, glm::ivec2 size_px, std::span<const std::uint8_t> rgba);

}  // namespace calibration
