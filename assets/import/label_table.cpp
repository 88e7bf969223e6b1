#include "assets/import/label_table.h"

#include <algorithm>
#include <charconv>
#include <functional>

#include "assets/scan/header_text.h"
#include "assets/tooth.h"

namespace assets {
namespace {

bool holds(std::string_view text, std::string_view part) { return text.find(part) != std::string_view::npos; }

LabelMeaning toothOf(int fdi, bool is_pulp) {
  if (!isToothNumber(fdi)) return {};
  return {is_pulp ? LabelKind::pulp : LabelKind::tooth, fdi, Tissue::unlabelled};
}

/// The number after "fdi" at the end of a name.
std::optional<int> statedNumber(std::string_view name) {
  const std::size_t at = name.rfind("fdi");
  if (at == std::string_view::npos) return std::nullopt;
  std::string_view digits = name.substr(at + 3);
  while (!digits.empty() && digits.front() == ' ') digits.remove_prefix(1);
  int number = 0;
  const auto [end, error] = std::from_chars(digits.data(), digits.data() + digits.size(), number);
  if (error != std::errc{} || end != digits.data() + digits.size()) return std::nullopt;
  return number;
}

/// "lower left second molar".
std::optional<int> describedNumber(std::string_view name) {
  const bool is_lower = holds(name, "lower") || holds(name, "mandib"),
             is_upper = holds(name, "upper") || holds(name, "maxill");
  const bool is_left = holds(name, "left"), is_right = holds(name, "right");
  if (is_lower == is_upper || is_left == is_right) return std::nullopt;
  constexpr std::array<std::string_view, 8> kPlaces = {"central incisor", "lateral incisor", "canine",
                                                       "first premolar",  "second premolar", "first molar",
                                                       "second molar",    "third molar"};
  for (std::size_t place = 0; place < kPlaces.size(); ++place)
    if (holds(name, kPlaces[place]) || (place == 7 && holds(name, "wisdom")))
      return 10 * (is_upper ? (is_right ? 1 : 2) : (is_left ? 3 : 4)) + static_cast<int>(place) + 1;
  return std::nullopt;
}

void putTeeth(LabelTable& table, int first_value, int first_fdi) {
  for (int n = 0; n < 8; ++n) table[static_cast<std::size_t>(first_value + n)] = toothOf(first_fdi + n, false);
}

LabelTable toothFairy(bool is_contiguous) {
  LabelTable table{};
  table[1].kind = LabelKind::mandible;
  table[3].kind = table[4].kind = LabelKind::canal;
  for (int quadrant = 1; quadrant <= 4; ++quadrant)
    putTeeth(table, is_contiguous ? 11 + 8 * (quadrant - 1) : 10 * quadrant + 1, 10 * quadrant + 1);
  return table;
}

/// Pulps 46 to 77; the tooth round each gives its number.
LabelTable totalSegmentator() {
  LabelTable table = toothFairy(true);
  for (std::size_t value = 46; value <= 77; ++value) table[value].kind = LabelKind::pulp;
  return table;
}

}  // namespace

LabelMeaning meaningOf(std::string_view text) {
  std::string name = lowerCase(std::string(text));
  std::ranges::replace(name, '_', ' ');
  std::ranges::replace(name, '-', ' ');
  const bool is_pulp = holds(name, "pulp");
  if (const auto stated = statedNumber(name)) return toothOf(*stated > 100 ? *stated - 100 : *stated, is_pulp);
  if (const auto described = describedNumber(name)) return toothOf(*described, is_pulp);
  if (is_pulp) return {LabelKind::pulp, 0, Tissue::unlabelled};
  if (holds(name, "canal")) {
    const bool is_other = holds(name, "incisive") || holds(name, "lingual") || holds(name, "root");
    return {is_other ? LabelKind::nothing : LabelKind::canal, 0, Tissue::unlabelled};
  }
  if (holds(name, "teeth") || holds(name, "tooth"))
    return {holds(name, "lower") || holds(name, "mandib") ? LabelKind::teeth : LabelKind::nothing, 0,
            Tissue::unlabelled};
  if (holds(name, "mandible") || holds(name, "lower jaw") || name == "mand")
    return {LabelKind::mandible, 0, Tissue::unlabelled};
  return {};
}

LabelTable labelTable(const std::map<int, std::string>& names) {
  LabelTable table{};
  for (const auto& [value, name] : names)
    if (value > 0 && value < static_cast<int>(table.size())) table[static_cast<std::size_t>(value)] = meaningOf(name);
  return table;
}

std::optional<LabelTable> labelTable(LabelSet set, const std::array<bool, 256>& is_present) {
  LabelTable table{};
  switch (set) {
    case LabelSet::molar:
      for (std::size_t value = 1; value < kScanTissueCount; ++value)
        table[value] = {LabelKind::tissue, 0, static_cast<Tissue>(value)};
      return table;
    case LabelSet::dental_segmentator:
      table[2].kind = LabelKind::mandible;
      table[4].kind = LabelKind::teeth;
      table[5].kind = LabelKind::canal;
      return table;
    case LabelSet::toothfairy: {
      // These are no FDI numbers; and a contiguous numbering ends at 42.
      const bool is_contiguous = std::ranges::any_of(std::array{19U, 20U, 29U, 30U, 39U, 40U},
                                                     [&](unsigned value) { return is_present[value]; });
      const bool is_fdi = std::any_of(is_present.begin() + 43, is_present.begin() + 49, std::identity{});
      if (is_contiguous == is_fdi) return std::nullopt;
      return toothFairy(is_contiguous);
    }
    case LabelSet::toothfairy_fdi:
      return toothFairy(false);
    case LabelSet::toothfairy_contiguous:
      return toothFairy(true);
    case LabelSet::total_segmentator:
      return totalSegmentator();
    case LabelSet::craniofacial:
      table[1].kind = LabelKind::mandible;
      table[2].kind = LabelKind::teeth;
      return table;
    case LabelSet::amasss:
      table[1].kind = LabelKind::mandible;
      return table;
  }
  return std::nullopt;
}

}  // namespace assets
