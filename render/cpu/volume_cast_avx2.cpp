// Compiled for AVX2; see CMakeLists.txt.
#include "render/cpu/volume_cast_body.h"

namespace render::avx2 {

void castSurface(CastJob& job) noexcept { cpu::surface(job); }
void castTranslucent(CastJob& job) noexcept { cpu::through(job); }

}  // namespace render::avx2
