// PNG files of 8-bit RGBA, rows from the top: snapshots, board photographs, reports. Any thread; milliseconds.
#pragma once

#include <cstdint>
#include <span>
#include <string>

#include <glm/glm.hpp>

#include "calibration/calibration_error.h"

namespace calibration {

/// `rgba`: size_px.x * size_px.y * 4 bytes. Writes to exactly `path`, whatever its extension. Throws CalibrationError
/// when it cannot be written.
void writePng(const std::string& path, glm::ivec2 size_px, std::span<const std::uint8_t> rgba);

}  // namespace calibration
