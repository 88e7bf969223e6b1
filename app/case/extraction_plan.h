// What a surgeon reads from the scan before an impacted lower third molar is removed: classes, distances, roots and
// difficulty, each with how it was found, or why it could not be. Computed; the surgeon corrects. For `molar plan`.
// Any thread; about a second. Definitions: reference/product 3.3.
#pragma once

#include <string>
#include <string_view>
#include <variant>
#include <vector>

#include "assets/patient.h"

namespace app {

struct PlanItem {
  std::string_view key;   ///< for programs
  std::string_view name;  ///< for people
  std::variant<std::monostate, double, std::string> value;
  std::string_view unit;     ///< of a number; may be empty
  std::string how;           ///< of a value; why there is none
  bool is_confirmed = true;  ///< false: it rests on a tooth or canal that nobody has confirmed

  bool isKnown() const { return value.index() != 0; }
};

using ExtractionPlan = std::vector<PlanItem>;

/// Throws UsageError, beginning with `name`: no labelled lower third molar.
ExtractionPlan extractionPlan(const assets::Patient& patient, const std::string& name);

/// The item of that key, which must exist.
const PlanItem& itemOf(const ExtractionPlan& plan, std::string_view key);

/// For people: "45.2 °", "not known".
std::string valueText(const PlanItem& item);
/// For people, one line an item.
std::string planTable(const ExtractionPlan& plan);

}  // namespace app
