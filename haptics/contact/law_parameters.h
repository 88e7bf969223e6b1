// Every parameter of every force law, in one table: what it is called, its unit and range, what it means, where it
// comes from, and where it lives in LawSettings. --set, the live parameter file, `molar laws` and the servo's own clamp
// all go by it. Defaults are those of the structs. Any thread; static data.
#pragma once

#include <optional>
#include <span>
#include <string_view>

#include "haptics/contact/law_settings.h"

namespace haptics {

struct LawParameter {
  std::optional<LawKind> law;  ///< none: every law obeys it
  std::string_view key;        ///< unique within a law and those of every law
  std::string_view unit;       ///< "" for a ratio
  double lowest, highest;      ///< what the servo obeys
  std::string_view meaning;
  std::string_view source;
  double& (*in)(LawSettings&);

  double& of(LawSettings& settings) const { return in(settings); }
  double of(const LawSettings& settings) const {
    LawSettings copy = settings;
    return in(copy);
  }
  double defaultValue() const { return of(LawSettings{}); }
};

std::span<const LawParameter> lawParameters();

/// The parameter of this law, or of every law, with this key; none if there is none.
const LawParameter* findLawParameter(LawKind law, std::string_view key);

std::optional<LawKind> lawOfKey(std::string_view key);

/// The settings as the servo obeys them: every parameter within its range, its default where it is no number, and the
/// default law for one that does not exist.
LawSettings sanitised(const LawSettings& settings);

}  // namespace haptics
