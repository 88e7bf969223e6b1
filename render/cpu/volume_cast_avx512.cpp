// Compiled for AVX-512; see CMakeLists.txt.
#include "render/cpu/volume_cast_body.h"

namespace render::avx512 {

void castSurface(CastJob& job) noexcept { cpu::surface(job); }
void castTranslucent(CastJob& job) noexcept { cpu::through(job); }

}  // namespace render::avx512
