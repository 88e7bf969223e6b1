// Measures of a root canal treatment on a built-in first molar at 0.04 mm: CPU time of all threads, bytes kept.
#include <cstdio>

#include "app/procedure/root_canal/access_outcomes.h"
#include "app/procedure/root_canal/canal_outcomes.h"
#include "app/procedure/root_canal/perforation.h"
#include "assets/synthetic/built_in_teeth.h"
#include "tests/bench/cpu_time.h"

int main() {
  const assets::JawParameters jaw;
  const assets::Patient patient = assets::syntheticJaw(jaw);
  const assets::BuiltInTooth built = assets::builtInTooth(jaw, 46);
  const assets::ToothCanals tooth = assets::canalsOf(built);
  const double began_ms = bench::cpu_ms();
  const app::ToothBlocks before(*assets::fineBuiltInTooth(built, patient.ct));
  std::printf("%-34s %8.1f ms   %.1f MB\n", "tooth as it was", bench::cpu_ms() - began_ms,
              1e-6 * double(before.bytes()));
  bench::printCost("a canal: E1 to E6, E9", [&] {
    return app::canalOutcomes(before, before, tooth.canals, 0, app::furcationSide_P(tooth, 0)).least_wall_mm;
  });
  bench::printCost("perforations", [&] { return double(app::perforations(before, before, tooth).size()); });
  bench::printCost("roof", [&] { return app::roofOutcome(before, tooth).removed; });
  bench::printCost("outline", [&] { return app::outlineOutcome(before, before, tooth).ideal_mm2; });
  bench::printCost("lost tissue", [&] { return app::lostTissue(before, before, tooth).dentine_mm3; });
  bench::printCost("straight line to a canal", [&] { return app::straightLine(before, tooth.canals[0]).blocked_mm3; });
}
