// See CMakeLists.txt for its flags.
#include "tests/bench/render/headlight_body.h"

namespace bench::avx512 {

void headlight(const HeadlightJob& job) noexcept { render::cpu::headlightOf(job); }

}  // namespace bench::avx512
