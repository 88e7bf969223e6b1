// A molar of 560 mm3 in its socket at 0.25 mm: what a body of its own takes, the move of a block to another, and making
// it ready for forceps.
#include <cmath>
#include <cstdio>

#include "haptics/body/piece_split.h"
#include "haptics/bone/stroke_history.h"
#include "haptics/ligament/piece_site.h"
#include "tests/bench/extraction_parts.h"
#include "tests/haptics/tooth_phantom.h"

namespace bench {
namespace {

double toothDistance_mm(const glm::dvec3& p) {
  const double crown = (glm::length((p - glm::dvec3(0, 0, 3.6)) / glm::dvec3(5.5, 5.0, 4.2)) - 1.0) * 4.2;
  const double down_mm = std::clamp(-p.z, 0.0, 11.0), radius_mm = 2.5 - 1.6 * down_mm / 11.0;
  const double root = std::min(std::hypot(p.x - 2.6, p.y, p.z + down_mm), std::hypot(p.x + 2.6, p.y, p.z + down_mm));
  return std::min(crown, root - radius_mm);
}

}  // namespace

void benchSite() {
  const haptics::phantom::ToothPhantom solid = haptics::phantom::solidOf(
      {160, 120, 160}, 0.25,
      [](const glm::dvec3& p) { return std::min(toothDistance_mm(p), std::max(p.z, 0.2 - toothDistance_mm(p))); });
  std::vector<std::uint8_t> label(solid.solid.size(), 1), is_tooth(solid.solid.size(), 0);
  assets::forVoxels(solid.grid, [&](glm::ivec3 ijk, std::size_t v) {
    if (toothDistance_mm(solid.grid.centre_P_mm(ijk)) < 0.1) label[v] = 5, is_tooth[v] = 1;
  });
  haptics::Bodies bodies(solid.grid, solid.solid, label, is_tooth);
  const haptics::CarvedBone& tooth = bodies.bones()[1];
  std::printf("a tooth of %zu voxels as a body: %.1f MB, an empty one %.1f MB\n", tooth.grid().voxelCount(),
              1e-6 * static_cast<double>(tooth.bytes()), 1e-6 * static_cast<double>(bodies.bones()[2].bytes()));

  const haptics::SocketSource source(bodies);
  const std::array<haptics::PiecePose, haptics::kMaxPieces> X_PQ{};
  haptics::SocketScene scene;
  const double copy_ms = 1e-3 * p10_us(9, [&] { scene = source.scene(0, X_PQ); });
  const haptics::DistanceField first = source.firstSocket();
  const double first_ms = 1e-3 * p10_us(9, [&] { source.firstSocket(); });
  std::size_t samples = 0;
  const double site_ms =
      1e-3 * p10_us(9, [&] { samples = haptics::makePieceSite(scene, first)->hold.samples().size(); });
  std::printf("  copy of %zu voxels around it %.1f ms, first socket %.0f ms, a site with %zu samples %.0f ms\n",
              scene.around.size(), copy_ms, first_ms, samples, site_ms);

  std::vector<std::uint8_t> half = tooth.solidInGridOrder();
  assets::forVoxels(tooth.grid(), [&](glm::ivec3 ijk, std::size_t v) {
    if (tooth.grid().centre_P_mm(ijk).x > 0.0) half[v] = 0;
  });
  const haptics::SplitPlan plan = haptics::splitPlan(tooth.grid(), half);
  haptics::StrokeHistory strokes(bodies.bones());
  const double began_us = threadTime_us();
  for (const auto& block : plan.blocks) bodies.moveBlock(0, 1, block.block, block.given, &strokes);
  std::printf("  half of it to another body: %zu blocks, %.2f us each\n", plan.blocks.size(),
              (threadTime_us() - began_us) / static_cast<double>(plan.blocks.size()));
}

}  // namespace bench
