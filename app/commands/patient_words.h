// What a patient folder holds, for people and for programs: volume, site, teeth, tissues, canal, gum and face, and what
// its statement of de-identification says. Any thread; a pass over the voxels.
#pragma once

#include <optional>
#include <string>

#include "assets/patient.h"
#include "assets/patient/statement_file.h"

namespace app {

std::string patientWords(const assets::Patient& patient, const std::optional<assets::StatementFacts>& statement = {});

/// JSON, with a line's end.
std::string patientJson(const assets::Patient& patient, const std::optional<assets::StatementFacts>& statement);

}  // namespace app
