// `molar import --tooth VOLUME.nrrd --out PATIENT`: one tooth as a volume of densities becomes a patient folder, set
// into a row as a dentoform has it. Nothing of the file but voxels and geometry reaches the folder. Throws UsageError
// and LoadError of one line.
#pragma once

#include <string>

#include "app/commands/import_course.h"
#include "app/text/command_line.h"

namespace app {

struct ToothImport {
  std::string volume;  ///< file
  int fdi = 46;
  std::string levels;  ///< "AIR,PULP,DENTINE,ENAMEL"; empty: those of published volumes
  bool upright = false;
};

/// `tooth`: the option that names the file.
void addToothOptions(CommandLine& command, const Option& tooth, ToothImport& options);

/// Before the work. Throws UsageError.
void refuseUnknownTooth(const ToothImport& options);

/// Writes `folder`; words on the patient.
std::string importTooth(const ToothImport& options, const std::string& folder, bool force, ImportCourse& course);

}  // namespace app
