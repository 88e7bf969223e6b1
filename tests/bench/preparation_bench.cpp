// Measures of a tooth preparation on a built-in first molar at the voxels of a rehearsal: CPU time of all threads. Cut
// to 0.2 mm short of its ideal.
#include <cstdio>

#include "app/case/prepared_tooth.h"
#include "app/case/treated_tooth.h"
#include "app/procedure/preparation/bite_watch.h"
#include "app/procedure/preparation/preparation_outcomes.h"
#include "app/procedure/preparation/preparation_paint.h"
#include "assets/synthetic/jaw.h"
#include "tests/bench/cpu_time.h"

int main() {
  const assets::JawParameters jaw;
  const app::FineTooth tooth =
      app::fineToothAlone(assets::syntheticJaw(jaw), jaw, 46, app::kPreparedVoxel_mm, "--tooth");
  const app::Crown crown(app::ToothBlocks(*tooth.fine), tooth.canals.frame);
  std::printf("crown: %.1f M voxels\n", 1e-6 * static_cast<double>(crown.solid.grid().voxelCount()));
  app::IdealRule rule = app::idealRule("crown:all-ceramic", "--ideal");
  std::optional<app::PreparationMeasure> measure;
  bench::printCost("the ideal, once", [&] {
    measure.emplace(crown, rule, "--ideal");
    return 0.0;
  });
  rule.occlusal_mm -= 0.2;
  rule.margin_mm -= 0.2;
  const app::BoxBytes made = app::PreparedIdeal(crown, rule, "--ideal").left(crown);
  bench::printCost("P1 to P8, after a stroke", [&] { return measure->outcomesOf(made).deviation.rms_mm; });
  const app::PreparedIdeal ideal(crown, measure->rule(), "--ideal");
  bench::printCost("  P1", [&] {
    return app::removedMaterial(crown, made, measure->ideal(), [&](const glm::dvec3& p) { return ideal.zone(p); })
        .under_mm3();
  });
  const app::IdealDistance distance(measure->ideal());
  bench::printCost("  P2, P8: deviation",
                   [&] { return app::deviationOf(crown, made, measure->ideal(), distance).rms_mm; });
  bench::printCost("  splinters", [&] { return static_cast<double>(app::attached(crown, made).bytes().size()); });
  bench::printCost("  P3, P4, P6: walls",
                   [&] { return app::StumpWalls(crown, made, 0.0, crown.top_mm).radius_mm(0, 40); });
  std::optional<app::CrownColumns> columns;
  bench::printCost("  P5: columns", [&] {
    columns.emplace(crown, made, 1.0);
    return columns->undercut_mm3(glm::dvec2(0.0));
  });
  bench::printCost("  P5: way of insertion", [&] { return app::bestInsertion(*columns).undercut_mm3; });
  const app::PreparationOutcomes outcomes = measure->outcomesOf(made);
  bench::printCost("what is painted on the live tooth", [&] {
    return static_cast<double>(app::preparationPaint(*measure, made, outcomes).deviation.size());
  });
  std::optional<app::BittenTooth> bitten;
  bench::printCost("what opposes it, made, once", [&] {
    bitten.emplace(crown, assets::PreparedTooth{46, crown.frame, rule.name.data(), "", {}});
    return 0.0;
  });
  bench::printCost("a bite on articulating paper", [&] { return bitten->bitten(made, 0.04).bite.clearance_mm; });
}
