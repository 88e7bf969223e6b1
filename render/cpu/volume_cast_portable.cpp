// Compiled for any machine; see CMakeLists.txt.
#include "render/cpu/volume_cast_body.h"

namespace render::portable {

void castSurface(CastJob& job) noexcept { cpu::surface(job); }
void castTranslucent(CastJob& job) noexcept { cpu::through(job); }

}  // namespace render::portable
