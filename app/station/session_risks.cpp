#include "app/station/session_risks.h"

#include "app/case/clearance_source.h"
#include "assets/synthetic/jaw.h"

namespace app {

assets::RiskStructures risksOfSession(const StoredStart& start) {
  assets::Patient patient;
  patient.ct.grid = start.grid;
  patient.ct.label = start.label;
  patient.ct.tooth = start.teeth;
  patient.site = start.setup.site;
  patient.mandibular_canal_P_mm = start.setup.canal_P_mm;
  if (!start.setup.canal_P_mm.empty()) patient.mandibular_canal_radius_mm = start.setup.canal_radius_mm;
  const bool is_old = start.teeth.empty() && !start.setup.site;
  if (is_old && start.setup.built_in) {
    const assets::Patient again = assets::syntheticJaw(*start.setup.built_in);
    // Of another revision of the built-in patient: not the same jaw.
    if (again.ct.grid == start.grid && again.ct.label == start.label) return cachedRiskStructures(again);
  }
  return cachedRiskStructures(patient);
}

}  // namespace app
