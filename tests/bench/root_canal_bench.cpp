// Measures of a root canal treatment on a built-in first molar at 0.04 mm: CPU time of all threads, bytes kept. What a
// rehearsal asks after a stroke: a canal filed a little wider, a bur a little deeper.
#include <cstdio>
#include <random>

#include "app/procedure/root_canal/treatment_meter.h"
#include "assets/synthetic/built_in_teeth.h"
#include "tests/bench/cpu_time.h"

namespace {

/// Half of what is left of the voxels within a distance of a place.
void cut(const app::ToothBlocks& before, app::ToothNow& now, app::TreatmentMeter& meter, const glm::dvec3& at_P,
         double radius_mm) {
  const assets::VolumeGrid& grid = before.grid();
  const glm::dvec3 at = grid.indexFromPoint(at_P);
  const double around = radius_mm / grid.spacing_mm;
  const glm::ivec3 low = glm::max(glm::ivec3(glm::floor((at - around) / 4.0)), glm::ivec3(0));
  const glm::ivec3 end = glm::min(glm::ivec3(glm::floor((at + around) / 4.0)) + 1, grid.size / 4);
  assets::forVoxels(low, end, [&](glm::ivec3 block) {
    app::ToothNow::Bytes bytes;
    std::size_t v = 0;
    assets::forVoxels(4 * block, 4 * block + 4, [&](glm::ivec3 ijk) {
      const std::uint8_t is = now.voxel(ijk);
      bytes[v++] = glm::distance(grid.centre_P_mm(ijk), at_P) < radius_mm ? static_cast<std::uint8_t>(is / 2) : is;
    });
    now.set(block, bytes);
    meter.change(block, bytes);
  });
}

}  // namespace

int main() {
  const assets::JawParameters jaw;
  const assets::Patient patient = assets::syntheticJaw(jaw);
  const assets::BuiltInTooth built = assets::builtInTooth(jaw, 46);
  const assets::ToothCanals tooth = assets::canalsOf(built);
  const double began_ms = bench::cpu_ms();
  const app::ToothBlocks before(*assets::fineBuiltInTooth(built, patient.ct));
  std::printf("%-44s %8.1f ms   %.1f MB\n", "tooth as it was", bench::cpu_ms() - began_ms,
              1e-6 * double(before.bytes()));
  bench::printCost("a canal: E1 to E6, E9", [&] {
    app::CanalSections sections(before, before, tooth.canals[0], app::furcationSide_P(tooth, 0));
    return app::canalOutcomes(sections, 0.0).least_wall_mm;
  });
  bench::printCost("perforations", [&] { return double(app::perforations(before, before, tooth).size()); });
  bench::printCost("roof", [&] { return app::roofOutcome(before, tooth).removed; });
  bench::printCost("outline", [&] { return app::outlineOutcome(before, before, tooth).ideal_mm2; });
  bench::printCost("straight line to a canal", [&] { return app::straightLine(before, tooth.canals[0]).blocked_mm3; });

  app::ToothNow now(before);
  app::TreatmentMeter meter(tooth, before);
  const app::FileUse files(tooth);
  const auto measured = [&](const char* what, const auto& change) {
    change();
    const double start_ms = bench::cpu_ms();
    const app::Treatment treatment = meter.measure(files);
    std::printf("%-44s %8.1f ms   %.2f mm3 cut\n", what, bench::cpu_ms() - start_ms,
                treatment.lost.enamel_mm3 + treatment.lost.dentine_mm3);
  };
  measured("all of it, first", [] {});
  const glm::dvec3 up = tooth.frame.axes_P[2], roof = tooth.frame.inP({0.0, 0.0, tooth.chamber.roof_mm});
  measured("after an access cavity", [&] {
    for (double mm = 7.0; mm > -1.0; mm -= 0.1) cut(before, now, meter, roof + mm * up, 1.2);
    for (double mm = 7.0; mm > -1.0; mm -= 0.1) cut(before, now, meter, roof + mm * up, 1.1);
  });
  std::mt19937 random(1);
  const auto filed = [&](std::size_t canal, double share) {
    const assets::ToothCanal& of = tooth.canals[canal];
    for (double along_mm = 1.0; along_mm < share * of.length_mm(); along_mm += 0.05)
      cut(before, now, meter, of.at(along_mm).p_P_mm, of.at(along_mm).wide_mm + 0.02 * double(random() % 3));
  };
  measured("after a stroke of a file, all of a canal", [&] { filed(0, 0.98); });
  measured("the next one", [&] { filed(0, 0.98); });
  measured("in the other root", [&] { filed(tooth.canals.size() - 1, 0.98); });
  measured("after a stroke of a bur in the cavity", [&] { cut(before, now, meter, roof + 0.9 * up, 1.5); });
  measured("after a file went through the foramen", [&] { filed(0, 1.01); });
}
