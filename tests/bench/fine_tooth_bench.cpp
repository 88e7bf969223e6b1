// Built-in teeth on a fine grid, block by block: CPU time of all threads, how many blocks have to be filled, the live
// bone made of it, dense and sparse, and a point of the pulp's distance.
#include <cstdio>
#include <random>

#include "assets/synthetic/built_in_teeth.h"
#include "haptics/bone/stroke_history.h"
#include "tests/bench/cpu_time.h"

namespace {

struct Voxels {
  std::vector<std::uint8_t> solid, label;
};

Voxels voxelsOf(const assets::ToothSampler& tooth) {
  const assets::VolumeGrid& grid = tooth.grid();
  Voxels out{std::vector<std::uint8_t>(grid.voxelCount()), std::vector<std::uint8_t>(grid.voxelCount())};
  const auto put = [&](glm::ivec3 block, const auto& solid_of, const auto& label_of) {
    for (int v = 0; v < assets::ToothSampler::kVoxels; ++v) {
      const std::size_t at = grid.index(block * assets::ToothSampler::kEdge + glm::ivec3(v & 3, v >> 2 & 3, v >> 4));
      out.solid[at] = solid_of(static_cast<std::size_t>(v)), out.label[at] = label_of(static_cast<std::size_t>(v));
    }
  };
  assets::forBlocks(
      tooth,
      [&](glm::ivec3 block, assets::ToothSampler::Same one) {
        put(
            block, [&](std::size_t) { return one.solid; }, [&](std::size_t) { return one.label; });
      },
      [&](glm::ivec3 block, const auto& solid, const auto& label) {
        put(
            block, [&](std::size_t v) { return solid[v]; }, [&](std::size_t v) { return label[v]; });
      });
  return out;
}

/// The live bone, and what undo keeps of it, in MB.
void live(const assets::ToothSampler& tooth) {
  const Voxels voxels = voxelsOf(tooth);
  for (const auto storage : {haptics::BlockStorage::dense, haptics::BlockStorage::sparse}) {
    const double began_ms = bench::cpu_ms();
    const haptics::CarvedBone bone(tooth.grid(), voxels.solid, voxels.label, storage);
    std::printf("  live, %s: %7zu slots, %6zu of them in reserve, %6.1f MB, undo %.1f MB, made in %4.0f ms, %016llx\n",
                storage == haptics::BlockStorage::dense ? "dense " : "sparse", bone.slots(), bone.slotsLeft(),
                static_cast<double>(bone.bytes()) / 1e6,
                static_cast<double>(haptics::StrokeHistory(bone).bytes()) / 1e6, bench::cpu_ms() - began_ms,
                static_cast<unsigned long long>(bone.digest()));
  }
}

}  // namespace

int main() {
  assets::JawParameters jaw;
  const assets::Patient patient = assets::syntheticJaw(jaw);
  std::printf("%-6s %8s %10s %8s %8s %8s %8s\n", "tooth", "mm", "blocks", "filled", "share", "make ms", "fill ms");
  for (const int fdi : {46, 47, 45})
    for (const double spacing_mm : {0.04, 0.06}) {
      const assets::BuiltInTooth tooth = assets::builtInTooth(jaw, fdi);
      const double began_ms = bench::cpu_ms();
      const auto sampler = assets::fineBuiltInTooth(tooth, patient.ct, spacing_mm);
      const double made_ms = bench::cpu_ms();
      std::size_t same = 0, filled = 0, sum = 0;
      assets::forBlocks(
          *sampler, [&](glm::ivec3, assets::ToothSampler::Same one) { ++same, sum += one.solid; },
          [&](glm::ivec3, const auto& solid, const auto& label) { ++filled, sum += solid[0] + label[0]; });
      const double ended_ms = bench::cpu_ms();
      std::printf("%-6d %8.2f %10zu %8zu %7.1f%% %8.1f %8.1f  (%zu)\n", fdi, spacing_mm, same + filled, filled,
                  100.0 * static_cast<double>(filled) / static_cast<double>(same + filled), made_ms - began_ms,
                  ended_ms - made_ms, sum % 10);
      live(*sampler);
    }

  const assets::ToothCanals canals = assets::canalsOf(assets::builtInTooth(jaw, 46));
  const assets::PulpDistance pulp(canals);
  std::mt19937 random(1);
  std::normal_distribution<double> aside_mm(0.0, 0.3);
  std::vector<glm::dvec3> points;
  for (int n = 0; n < 100000; ++n) {
    const auto& canal = canals.canals[static_cast<std::size_t>(n % 3)];
    points.push_back(canal.at(1e-5 * n * canal.length_mm()).p_P_mm +
                     glm::dvec3(aside_mm(random), aside_mm(random), aside_mm(random)));
  }
  double sum_mm = 0.0;
  const double began_ms = bench::cpu_ms();
  for (const glm::dvec3& p : points) sum_mm += pulp.at_mm(p);
  std::printf("distance to the pulp's wall: %.0f ns a point (%.1f)\n",
              1e6 * (bench::cpu_ms() - began_ms) / static_cast<double>(points.size()), sum_mm);
}
