#include "render/cpu/shade_kernels.h"

#include <array>
#include <cmath>

#include "render/cpu/srgb_pieces.h"

namespace render {
namespace {

double exact(double x) { return 255.0 * (1.055 * std::pow(x, 1.0 / 2.4) - 0.055); }

SrgbPieces pieces() {
  SrgbPieces table{};
  for (int p = 0; p < kSrgbPieces; ++p) {
    const double octave = std::ldexp(1.0, p / 8 - 9), from = octave * (1.0 + (p % 8) / 8.0), to = from + octave / 8.0;
    // The chord is below the curve: raise it by half of the largest difference.
    const double lift = 0.5 * (exact(0.5 * (from + to)) - 0.5 * (exact(from) + exact(to)));
    table.low[p] = static_cast<float>(exact(from) + lift);
    table.rise[p] = static_cast<float>(exact(to) - exact(from));
  }
  return table;
}

}  // namespace

const SrgbPieces kSrgbTable = pieces();

// Defined by shade_kernel.cpp.
namespace portable {
extern const ShadeKernels kShadeKernels;
}
#if defined(__x86_64__)
namespace avx2 {
extern const ShadeKernels kShadeKernels;
}
namespace avx512 {
extern const ShadeKernels kShadeKernels;
}
#else
namespace avx2 = portable;
namespace avx512 = portable;
#endif

const ShadeKernels& shadeKernels(assets::InstructionSet set) {
  static constexpr std::array kKernels{&portable::kShadeKernels, &avx2::kShadeKernels, &avx512::kShadeKernels};
  return *kKernels[static_cast<std::size_t>(set)];
}

const ShadeKernels& shadeKernels() { return shadeKernels(assets::chosenInstructionSet()); }

}  // namespace render
