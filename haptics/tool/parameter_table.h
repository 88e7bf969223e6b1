// Tables of settings: spindle, erosion, force laws. A row has the key, unit, range, meaning and source of one value and
// its location in the settings; `--set`, parameter files, help, panel and the servo's clamp all read these tables.
// clampToTable() is unrolled at compile time: the servo thread makes no indirect call.
#pragma once

#include <algorithm>
#include <array>
#include <cmath>
#include <cstddef>
#include <optional>
#include <string_view>
#include <utility>
#include <variant>

#include "assets/tissue.h"

namespace haptics {

template <class Settings, class Kind = std::monostate>
struct Parameter {
  std::optional<Kind> law;  ///< none: applies to every law
  std::string_view key;     ///< unique within a law and those of every law
  std::string_view unit;    ///< "" for a ratio
  double lowest, highest;
  std::string_view meaning;
  double& (*in)(Settings&);
  std::string_view source = "";

  double& of(Settings& settings) const { return in(settings); }
  double of(Settings&& settings) const { return in(settings); }
  double of(const Settings& settings) const { return of(Settings(settings)); }
  double defaultValue() const { return of(Settings{}); }
};

/// For Parameter::in: a member of the settings, or a member of a member.
template <auto... kMembers, class Settings>
constexpr auto& valueIn(Settings& settings) {
  return (settings.*....*kMembers);
}

/// Prefix and the tissue's own key.
template <const std::string_view& kPrefix, std::size_t kTissue>
inline constexpr auto kFactorKey = [] {
  constexpr std::string_view kOwn = assets::kTissues[kTissue].key;
  std::array<char, kPrefix.size() + kOwn.size()> key{};
  std::copy(kOwn.begin(), kOwn.end(), std::copy(kPrefix.begin(), kPrefix.end(), key.begin()));
  return key;
}();

/// `rows` and a row for each tissue's factor, an array member of the settings; keys are kPrefix + the tissue's key.
template <const std::string_view& kPrefix, auto... kFactors, class Settings, class Kind, std::size_t kRows>
constexpr auto withTissueFactors(const std::array<Parameter<Settings, Kind>, kRows>& rows, double highest,
                                 std::string_view meaning, std::string_view source = "") {
  std::array<Parameter<Settings, Kind>, kRows + assets::kTissueCount> all{};
  auto* next = std::copy(rows.begin(), rows.end(), all.begin());
  [&]<std::size_t... kTissue>(std::index_sequence<kTissue...>) {
    ((*next++ = {std::nullopt,
                 {kFactorKey<kPrefix, kTissue>.data(), kFactorKey<kPrefix, kTissue>.size()},
                 "",
                 0.0,
                 highest,
                 meaning,
                 [](Settings& settings) -> double& { return valueIn<kFactors...>(settings)[kTissue]; },
                 source}),
     ...);
  }
  (std::make_index_sequence<assets::kTissueCount>{});
  return all;
}

/// A law by its key, for files, command line and help.
template <class Kind>
struct LawEntry {
  Kind kind;
  std::string_view key;
  std::string_view formula;  ///< on flat bone, or the law itself
  std::string_view good_for;
};
template <class Kind, std::size_t kLawCount>
std::optional<Kind> kindOfKey(const std::array<LawEntry<Kind>, kLawCount>& laws, std::string_view key) {
  for (const LawEntry<Kind>& law : laws)
    if (law.key == key) return law.kind;
  return std::nullopt;
}

/// Clamps every value of kTable to its range; the default for a value that is not finite.
template <const auto& kTable, class Settings>
void clampToTable(Settings& safe) {
  Settings defaults;
  const auto clamp_row = [&]<std::size_t kRow>() {
    constexpr auto kIn = kTable[kRow].in;
    double& value = kIn(safe);
    value = std::isfinite(value) ? std::clamp(value, kTable[kRow].lowest, kTable[kRow].highest) : kIn(defaults);
  };
  [&]<std::size_t... kRow>(std::index_sequence<kRow...>) { (clamp_row.template operator()<kRow>(), ...); }
  (std::make_index_sequence<kTable.size()>{});
}

/// The same; the default law for one of `kinds` or more.
template <const auto& kTable, class Settings>
Settings sanitisedBy(const Settings& settings, std::size_t kinds) {
  Settings safe = settings;
  if (static_cast<std::size_t>(safe.kind) >= kinds) safe.kind = Settings{}.kind;
  clampToTable<kTable>(safe);
  return safe;
}

}  // namespace haptics
