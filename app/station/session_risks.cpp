#include "app/station/session_risks.h"

#include "app/case/clearance_source.h"
#include "assets/synthetic/jaw.h"

namespace app {

assets::RiskStructures risksOfSession(const StoredStart& start, const assets::Patient& within) {
  const bool is_one_tooth = start.setup.canals || start.setup.prepared;
  const bool is_old = start.teeth.empty() && !start.setup.site && !is_one_tooth;
  if (is_old && start.setup.built_in) {
    const assets::Patient again = assets::syntheticJaw(*start.setup.built_in);
    // Of another revision of the built-in patient: not the same jaw.
    if (again.ct.grid == start.grid && again.ct.label == start.label) return cachedRiskStructures(again);
  }
  return cachedRiskStructures(within);
}

}  // namespace app
