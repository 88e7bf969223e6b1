// Procedures as TOML: the shipped ones, which are part of the program, and a teacher's own file. Strict: every wrong or
// unknown key is refused in one line with file, line and key. Keys, units and ranges: app/procedure/README.md. Start-up
// only.
#pragma once

#include <string>
#include <vector>

#include "app/procedure/steps/step_plan.h"

namespace app {

/// "third-molar", "coronectomy", "whole-tooth".
std::vector<std::string> shippedProcedures();
/// Its file as it is shipped, to be copied and edited. `name` must be one of the above.
std::string shippedProcedureText(const std::string& name);

/// `where` names the file. Throws assets::LoadError.
StepPlan stepPlanFromToml(const std::string& text, const std::string& where);

/// A shipped one by name, or the file of a name that ends in .toml. Throws UsageError for another name, LoadError for
/// a file that is missing or wrong.
StepPlan stepPlanNamed(const std::string& name_or_file);

}  // namespace app
