// A periapical radiograph of the built-in jaw's first molar: 410 x 310 pixels on one thread, beside a slow twin that
// walks a ninth of the rays in steps of a fifth of a voxel, and how far the two differ. CPU time of this thread.
#include <cmath>
#include <cstdio>

#include "assets/scan/periapical.h"
#include "assets/synthetic/jaw.h"
#include "tests/bench/extraction_parts.h"

namespace {

constexpr int kEvery = 3;  ///< pixel of a row, and row

struct Walked {
  double ms = 0.0, rms_mm = 0.0;
};

/// Nearest voxels along the last 60 mm before the film; tissues weaken as bone does.
Walked walk(const assets::CtVolume& ct, const std::vector<std::uint8_t>& bone, const assets::PeriapicalView& view,
            const std::vector<float>& fast_mm) {
  Walked walked;
  const double step_mm = 0.2 * ct.grid.spacing_mm;
  double squares = 0.0;
  int rays = 0;
  const double began_us = bench::threadTime_us();
  for (int y = 0; y < view.size_px.y; y += kEvery)
    for (int x = 0; x < view.size_px.x; x += kEvery) {
      const glm::dvec3 film = view.corner_P_mm + view.pixel_mm * (double(x) * view.right_P + double(y) * view.down_P);
      const glm::dvec3 way = glm::normalize(view.source_P_mm - film);
      double sum_mm = 0.0;
      for (double mm = 0.5 * step_mm; mm < 60.0; mm += step_mm) {
        const glm::ivec3 ijk(glm::round(ct.grid.indexFromPoint(film + mm * way)));
        if (ct.grid.contains(ijk)) sum_mm += step_mm * bone[ct.grid.index(ijk)] / 255.0;
      }
      const double off_mm = sum_mm - fast_mm[static_cast<std::size_t>(y * view.size_px.x + x)];
      squares += off_mm * off_mm;
      ++rays;
    }
  walked.ms = 1e-3 * (bench::threadTime_us() - began_us) * kEvery * kEvery;
  walked.rms_mm = std::sqrt(squares / rays);
  return walked;
}

}  // namespace

int main() {
  const assets::CtVolume ct = assets::syntheticJaw({}).ct;
  constexpr int kFirstMolar = 46;
  for (const double shift_deg : {0.0, 20.0}) {
    const auto view = assets::periapicalViewOf(ct, kFirstMolar, shift_deg);
    if (!view) return 1;
    const double ms = 1e-3 * bench::p10_us(9, [&] { assets::radiographOf(ct.grid, ct.solid, ct.label, *view); });
    // Without labels all is bone: what the slow walk sums.
    const Walked walked = walk(ct, ct.solid, *view, assets::radiographOf(ct.grid, ct.solid, {}, *view));
    std::printf(
        "tooth %d, tube shifted %2.0f degrees: %5.1f ms; slow walk %7.1f ms (%.0f times), rms %.3f mm of bone\n",
        kFirstMolar, shift_deg, ms, walked.ms, walked.ms / ms, walked.rms_mm);
  }
  return 0;
}
