// The table of every parameter of every force law (tool/parameter_table). Defaults are those of the structs. Any
// thread; static data.
#pragma once

#include <optional>
#include <span>
#include <string_view>

#include "haptics/contact/law_settings.h"
#include "haptics/tool/parameter_table.h"

namespace haptics {

using LawParameter = Parameter<LawSettings, LawKind>;
std::span<const LawParameter> lawParameters();

/// The parameter of this law, or of every law, with this key; null if there is none.
const LawParameter* findLawParameter(LawKind law, std::string_view key);

std::optional<LawKind> lawOfKey(std::string_view key);

/// Every parameter clamped to its range, defaults for NaN and infinity; the default law for an unknown one.
LawSettings sanitised(const LawSettings& settings);

}  // namespace haptics
