#include "app/commands/patient_or_case.h"

#include "app/case/case.h"
#include "app/case/patient_source.h"
#include "app/station/patient_list.h"
#include "app/text/command_line.h"
#include "app/text/message.h"
#include "app/text/usage_error.h"
#include "assets/patient/patient_folder.h"

namespace app {

void PatientOrCase::addTo(CommandLine& command) {
  command.option("PATIENT", patient_, kPatientHelp);
  command.option("--case", case_name_, "A case of the built-in patient, see molar rehearse --cases").oneOf(caseNames());
}

void PatientOrCase::refuseUnlessOne(const std::string& command) const {
  if (patient_.empty() == case_name_.empty())
    throw UsageError(command + ": give exactly one of PATIENT and --case NAME");
}

std::string PatientOrCase::name() const { return case_name_.empty() ? patient_ : "--case " + case_name_; }

std::optional<assets::JawParameters> PatientOrCase::builtInJaw() const {
  if (case_name_.empty()) return std::nullopt;
  return caseNamed(case_name_)->jaw;
}

assets::Patient PatientOrCase::load() const {
  if (!case_name_.empty()) return builtInPatient(caseNamed(case_name_)->jaw);
  assets::Patient patient = assets::loadPatient(patientNamed(patient_));
  if (const assets::Proposed proposed = patient.proposed(); proposed.any())
    printMessage("not confirmed: what rests on the " + proposed.words() +
                 " of this patient, found by the program in the scan; molar check shows, corrects and confirms");
  return patient;
}

}  // namespace app
