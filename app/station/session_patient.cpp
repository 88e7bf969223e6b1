#include "app/station/session_patient.h"

#include "app/case/patient_source.h"
#include "app/case/prepared_tooth.h"
#include "app/case/treated_tooth.h"
#include "app/text/usage_error.h"
#include "assets/patient/patient_folder.h"
#include "assets/synthetic/practice_block.h"
#include "assets/synthetic/preparation_block.h"

namespace app {

std::optional<assets::Patient> patientOfSession(const StoredStart& start, const std::string& folder) {
  if (const auto task = assets::practiceTaskOf(start.setup.practice))
    return assets::practiceBlock(*task, start.grid.spacing_mm);
  if (const auto* const block = assets::preparationBlockOf(start.setup.practice)) {
    assets::Patient patient = assets::preparationBlock(*block, start.grid.spacing_mm);
    if (start.setup.prepared) patient.prepared = start.setup.prepared;
    patient.ct.solid = start.solid;
    return patient;
  }
  if (folder.empty() && !start.setup.built_in) return {};
  assets::Patient patient = folder.empty() ? builtInPatient(*start.setup.built_in) : assets::loadPatient(folder);
  if (start.setup.canals) {
    // Labels are the same, whatever was cut of the crown before.
    const auto built_in = folder.empty() ? start.setup.built_in : std::nullopt;
    patient = treatedTooth(patient, built_in, start.setup.canals->fdi, false, "--tooth", start.grid.spacing_mm);
    patient.ct.solid = start.solid;
    patient.fragments = start.setup.fragments;
  }
  if (const auto& prepared = start.setup.prepared) {
    const auto built_in = folder.empty() ? start.setup.built_in : std::nullopt;
    patient = preparedTooth(patient, built_in, prepared->fdi, {prepared->ideal, prepared->caries}, "--tooth");
    patient.prepared->given = prepared->given;
    patient.prepared->bite = prepared->bite;
    patient.prepared->opposing = prepared->opposing;
    patient.ct.solid = start.solid;
  }
  if (patient.ct.grid == start.grid && patient.ct.label == start.label) return patient;
  if (!folder.empty()) throw UsageError(folder + ": is not the patient of this session, name another folder");
  return {};
}

assets::Patient patientWithinSession(const StoredStart& start) {
  assets::Patient patient;
  patient.title = start.patient_title;
  patient.ct.grid = start.grid;
  patient.ct.solid = start.solid;
  patient.ct.label = start.label;
  patient.ct.tooth = start.teeth;
  patient.site = start.setup.site;
  patient.canals = start.setup.canals;
  patient.fragments = start.setup.fragments;
  patient.prepared = start.setup.prepared;
  if (const assets::Proposed& proposed = start.setup.proposed; proposed.any()) {
    patient.found = assets::Confirmation{!proposed.tooth, !proposed.canal};
    if (patient.title.ends_with(assets::kNotConfirmedTitle))
      patient.title.resize(patient.title.size() - assets::kNotConfirmedTitle.size());
  }
  patient.jaw_P_mm = start.grid.centre_P_mm(start.grid.size / 2);
  patient.mandibular_canal_P_mm = start.setup.canal_P_mm;
  if (!start.setup.canal_P_mm.empty()) patient.mandibular_canal_radius_mm = start.setup.canal_radius_mm;
  return patient;
}

}  // namespace app
