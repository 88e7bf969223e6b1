// How the surface of a mesh is shaded. The numbers are those of the shaders. Any thread.
#pragma once

#include "render/shaders/shared_numbers.glsl"

namespace render {

enum class Finish { skin = FINISH_SKIN, gum = FINISH_GUM, instrument = FINISH_INSTRUMENT, guide = FINISH_GUIDE };

}  // namespace render
