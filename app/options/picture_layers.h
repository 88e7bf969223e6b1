// What may be shown besides tooth and bone, by the names people type (`--layers`, a script) and read (the instructor's
// window). One table. Any thread.
#pragma once

#include <array>
#include <string_view>

#include "render/frame.h"

namespace app {

struct PictureLayer {
  std::string_view name;   ///< as people type it
  std::string_view label;  ///< as they read it
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
