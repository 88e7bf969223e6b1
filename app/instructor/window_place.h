// Where the instructor's window opens on the surgeon's own monitor: beside the surgeon's picture, never over it, and
// where it was left the last time. Pixels of the desktop from its top left. Pure but for the file; main thread.
#pragma once

#include <optional>
#include <string>

#include "render/display/window.h"

namespace app {

/// The smallest useful size: the panel and a small picture beside it.
inline constexpr glm::ivec2 kLeastInstructor_px{640, 560};
inline constexpr glm::ivec2 kUsualInstructor_px{1360, 900};

/// The largest strip of the monitor that the surgeon's window leaves free; none where it is smaller than the least.
std::optional<render::DesktopBox> placeBeside(const render::DesktopBox& surgeons, const render::DesktopBox& monitor);

/// Whether a box covers no pixel of the other.
bool areApart(const render::DesktopBox& one, const render::DesktopBox& other);

/// $XDG_CONFIG_HOME/molar/instructor_window.toml.
std::string instructorWindowFile();
/// None: not written yet, or not readable.
std::optional<render::DesktopBox> rememberedPlace(const std::string& file);
/// What cannot be written is forgotten.
void rememberPlace(const std::string& file, const render::DesktopBox& place);

}  // namespace app
