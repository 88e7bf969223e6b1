// Layers that can be shown besides tooth and bone: one table for `--layers`, scripts and the instructor's window. Any
// thread.
#pragma once

#include <array>
#include <string_view>

#include "render/frame.h"

namespace app {

struct PictureLayer {
  std::string_view name;   ///< on the command line and in scripts
  std::string_view label;  ///< in the instructor's window
  bool render::Layers::*on;
};

inline constexpr std::array<PictureLayer, 6> kPictureLayers = {{
    {"gum", "Gum", &render::Layers::gingiva},
    {"canal", "Mandibular canal", &render::Layers::mandibular_canal},
    {"clearance", "Clearance bands", &render::Layers::clearance},
    {"plan", "Planned cut", &render::Layers::planned_cut},
    {"ghost", "Ghost tool", &render::Layers::ghost_tool},
    {"slices", "CT slices", &render::Layers::slices},
}};

}  // namespace app
