#include "app/options/tool_text.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <optional>
#include <utility>
#include <vector>

#include <fmt/core.h>

#include "app/options/iso_bur.h"
#include "app/text/list.h"
#include "app/text/parse_number.h"
#include "app/text/usage_error.h"

namespace app {
namespace {

using haptics::BurShape;
using haptics::ShapeKind;

struct Measure {
  const char* name;
  double min_mm, max_mm;
  double factor = 1.0;  ///< to the radius: 0.5 of a diameter
};

struct Form {
  std::string_view key;
  ShapeKind kind;
  const char* pattern;
  std::vector<Measure> measures;
  assets::BurProfile profile = assets::BurProfile::wheel;

  /// By diameter, as dentists do; sessions and settings files name the shape and its radius.
  bool isOrdered() const { return measures.front().factor != 1.0; }
};

constexpr std::string_view kElevator = "elevator", kFile = "k-file", kCone = "gp-cone", kIso = "iso";
constexpr const char* kIsoPattern = "iso:SHAPE/TENTHS";
constexpr const char* kFilePattern = "k-file:SIZE,LENGTH with ,niti or ,bent:DEGREES behind it";

constexpr const char* kConePattern = "gp-cone:SIZE,TAPER with ,HELD in mm or ,dry behind it";
/// Sealer that a coated cone brings. Our default.
constexpr double kSealer_mm3 = 2.0, kHeld_mm = 21.0;

const Measure kRadius{"radius", 0.1, 20.0}, kDiameter{"diameter", 0.2, 40.0, 0.5};

/// "iso023" is a largest diameter of 2.3 mm: ISO 6360-1 gives it in tenths of a millimetre, three digits.
std::optional<double> isoDiameter_mm(std::string_view text) {
  if (!text.starts_with("iso") || text.size() != 6) return {};
  const auto tenths = parseNumber<int>(text.substr(3));
  return tenths && *tenths > 0 ? std::optional(*tenths / 10.0) : std::nullopt;
}

const std::vector<Form>& forms() {
  using assets::BurProfile;
  const auto revolved = [](BurProfile profile, const char* pattern) {
    return Form{assets::kBurProfileKeys[static_cast<std::size_t>(profile)],
                ShapeKind::revolved,
                pattern,
                {kRadius, {"length", 0.1, 40.0}},
                profile};
  };
  static const std::vector<Form> kKnown = {
      {"round", ShapeKind::sphere, "round:D", {kDiameter}},
      {"fissure", ShapeKind::cylinder, "fissure:D,L", {kDiameter, {"length", 0.1, 40.0}}},
      {"sphere", ShapeKind::sphere, "sphere:R", {kRadius}},
      {"capsule", ShapeKind::capsule, "capsule:R,L", {kRadius, {"length", 0.0, 40.0}}},
      {"cylinder", ShapeKind::cylinder, "cylinder:R,L", {kRadius, {"length", 0.1, 40.0}}},
      {"cone", ShapeKind::cone, "cone:R,L", {kRadius, {"length", 0.1, 40.0}}},
      revolved(BurProfile::wheel, "wheel:R,L"),
      revolved(BurProfile::inverted_cone, "inverted-cone:R,L"),
      revolved(BurProfile::taper, "taper:R,L"),
      revolved(BurProfile::round_taper, "round-taper:R,L"),
      revolved(BurProfile::torpedo, "torpedo:R,L"),
      revolved(BurProfile::flame, "flame:R,L"),
      revolved(BurProfile::pear, "pear:R,L"),
      revolved(BurProfile::egg, "egg:R,L"),
      revolved(BurProfile::round_cylinder, "round-cylinder:R,L")};
  return kKnown;
}

/// Reads `1.5,4`. Errors begin with `option` and name `pattern`.
std::vector<double> measuresIn(std::string_view text, const std::vector<Measure>& measures, const std::string& option,
                               const std::string& pattern) {
  const std::string give = ", give " + pattern + " in mm";
  std::vector<double> values;
  for (const std::string_view part : split(text)) {
    if (values.size() == measures.size()) throw UsageError(option + ": there are too many numbers" + give);
    const Measure& measure = measures[values.size()];
    const auto value =
        measure.factor != 1.0 && part.starts_with("iso") ? isoDiameter_mm(part) : parseNumber<double>(part);
    if (!value) throw UsageError(option + ": the " + measure.name + " is not a number" + give);
    if (*value < measure.min_mm || *value > measure.max_mm)
      throw UsageError(fmt::format("{}: the {} is out of range, give {} to {} mm", option, measure.name, measure.min_mm,
                                   measure.max_mm));
    values.push_back(measure.factor * *value);
  }
  if (values.size() < measures.size())
    throw UsageError(option + ": the " + measures[values.size()].name + " is missing" + give);
  return values;
}

/// "a, b or c"
std::string alternatives(std::vector<std::string> ways) {
  const std::string last = std::move(ways.back());
  ways.pop_back();
  return joined(ways) + " or " + last;
}

/// Refuses a revolved head that is too short for its outline.
BurShape notFolded(const BurShape& head, const std::string& text) {
  if (head.kind != ShapeKind::revolved) return head;
  const double least_mm = assets::leastBurLength_mm(head.profile, head.radius_mm);
  if (head.length_mm < least_mm)
    throw UsageError(fmt::format("--tool {}: the length is too short for this form, give at least {:.3g} mm", text,
                                 std::ceil(1000.0 * least_mm) / 1000.0));
  return head;
}

/// None: it is none of them.
std::optional<haptics::Tool> handInstrumentFrom(std::string_view text) {
  for (std::size_t n = 1; n < haptics::kHandInstrumentKeys.size(); ++n)
    if (haptics::kHandInstrumentKeys[n] == text)
      return haptics::handInstrumentTool(static_cast<haptics::HandInstrument>(n));
  return {};
}

haptics::Tool elevatorFrom(const std::string& text) {
  const std::string_view kind = std::string_view(text).substr(std::min(text.size(), kElevator.size() + 1));
  for (std::size_t n = 1; n < haptics::kElevatorKeys.size(); ++n)
    if (haptics::kElevatorKeys[n] == kind) return haptics::elevatorTool(static_cast<haptics::ElevatorKind>(n));
  throw UsageError("--tool " + text + ": no such elevator, give " + elevatorForms());
}

/// "k-file:25,25", "k-file:15,25,bent:30", "k-file:25,21,niti".
haptics::Tool canalFileFrom(const std::string& text) {
  haptics::CanalFile file;
  const std::string_view whole = text;
  const std::string_view numbers = whole.substr(std::min(whole.size(), kFile.size() + 1));
  const auto refuse = [&](const std::string& why) {
    throw UsageError("--tool " + text + ": " + why + ", give " + kFilePattern);
  };
  std::size_t place = 0;
  for (const std::string_view part : split(numbers)) {
    constexpr std::string_view kBent = "bent:";
    const auto number = parseNumber<double>(part);
    if (place == 0 && number && *number > 0.0) {
      file.size = static_cast<std::uint64_t>(*number);
    } else if (place == 1 && number) {
      file.length_mm = *number;
    } else if (part == "niti") {
      file.nickel_titanium = true;
    } else if (part == "steel") {
      file.nickel_titanium = false;
    } else if (part.starts_with(kBent)) {
      const auto bent_deg = parseNumber<double>(part.substr(kBent.size()));
      if (!bent_deg || std::abs(*bent_deg) > 90.0) refuse("a file is bent by 0 to 90 degrees");
      file.bent_deg = *bent_deg;
    } else {
      refuse("'" + std::string(part) + "' is not understood");
    }
    ++place;
  }
  if (!file.made())
    refuse(fmt::format("no such file is made: sizes {}; lengths {} mm",
                       joined(assets::kKFileSizes, [](int n) { return std::to_string(n); }),
                       joined(assets::kKFileLengths_mm, [](int n) { return std::to_string(n); })));
  return haptics::fileTool(file);
}

/// "gp-cone:25,2", "gp-cone:30,4,22", "gp-cone:15,2,dry": the taper in percent, held so far from its tip.
haptics::Tool coneFrom(const std::string& text) {
  const std::string_view whole = text;
  const auto refuse = [&](const std::string& why) {
    throw UsageError("--tool " + text + ": " + why + ", give " + kConePattern);
  };
  haptics::CanalFile cone{.length_mm = kHeld_mm, .sealer_mm3 = kSealer_mm3};
  std::size_t place = 0;
  for (const std::string_view part : split(whole.substr(std::min(whole.size(), kCone.size() + 1)))) {
    const auto number = parseNumber<double>(part);
    if (part == "dry")
      cone.sealer_mm3 = 0.0;
    else if (place == 0 && number && *number > 0.0)
      cone.size = static_cast<std::uint64_t>(*number);
    else if (place == 1 && number)
      cone.cone_taper = 0.01 * *number;
    else if (place == 2 && number)
      cone.length_mm = *number;
    else
      refuse("'" + std::string(part) + "' is not understood");
    ++place;
  }
  if (!cone.cone())
    refuse(fmt::format("no such cone is made: sizes {} to {} by {}, tapers {} %, held {:g} to {:g} mm from the tip",
                       assets::kThinnestCone, assets::kThickestCone, assets::kConeStep,
                       joined(assets::kConeTapers, [](double taper) { return fmt::format("{:.0f}", 100.0 * taper); }),
                       assets::kShortestCone_mm, assets::kLongestCone_mm));
  return haptics::fileTool(cone);
}

}  // namespace

std::string fileForm() { return std::string(kFilePattern) + ", or " + kConePattern; }

std::string headForms() {
  std::vector<std::string> patterns;
  for (const Form& form : forms()) patterns.emplace_back(form.pattern);
  patterns.emplace_back(kIsoPattern);
  return alternatives(std::move(patterns));
}

std::string elevatorForms() {
  std::vector<std::string> ways;
  for (std::size_t n = 1; n < haptics::kElevatorKeys.size(); ++n)
    ways.push_back(fmt::format("{}:{}", kElevator, haptics::kElevatorKeys[n]));
  return alternatives(std::move(ways));
}

std::string handInstrumentForms() {
  return alternatives({haptics::kHandInstrumentKeys.begin() + 1, haptics::kHandInstrumentKeys.end()});
}

std::multimap<ShapeKind, std::string_view> headKinds() {
  std::multimap<ShapeKind, std::string_view> kinds;
  for (const Form& form : forms())
    if (!form.isOrdered()) kinds.emplace(form.kind, form.key);
  return kinds;
}

BurShape headFrom(const std::string& text) {
  const std::string_view whole = text;
  const std::string_view key = whole.substr(0, whole.find(':'));
  if (key == kIso)
    return notFolded(isoBurFrom(whole.substr(std::min(whole.size(), kIso.size() + 1)), "--tool " + text), text);
  for (const Form& form : forms()) {
    if (key != form.key) continue;
    const std::string_view numbers = key.size() == whole.size() ? std::string_view{} : whole.substr(key.size() + 1);
    const auto values = measuresIn(numbers, form.measures, "--tool " + text, form.pattern);
    return notFolded({form.kind, values[0], values.size() > 1 ? values[1] : 0.0, form.profile}, text);
  }
  throw UsageError("--tool " + text + ": no such head, give " + headForms() + " in mm");
}

haptics::Tool toolFrom(const std::string& text, const std::string& shaft) {
  if (text == "forceps") return haptics::forcepsTool();
  if (const auto by_hand = handInstrumentFrom(text)) return *by_hand;
  const std::string_view key = std::string_view(text).substr(0, text.find(':'));
  if (key == "forceps") throw UsageError("--tool " + text + ": forceps have no size, write forceps alone");
  if (key == kElevator) return elevatorFrom(text);
  if (key == kFile) return canalFileFrom(text);
  if (key == kCone) return coneFrom(text);
  if (key != kIso && std::ranges::none_of(forms(), [&](const Form& form) { return form.key == key; }))
    throw UsageError("--tool " + text + ": no such tool, give " + headForms() + " in mm, or forceps, or " +
                     elevatorForms() + ", or " + handInstrumentForms() + ", or " + fileForm());
  const BurShape head = headFrom(text);
  return {head, shaft.empty() ? haptics::standardShaft(head) : shaftFrom(shaft)};
}

haptics::Shaft shaftFrom(const std::string& text) {
  if (text == "none") return {};
  const auto values =
      measuresIn(text, {{"radius", 0.1, 5.0}, {"length", 0.1, 100.0}}, "--shaft " + text, "none or R,L");
  return {values[0], values[1]};
}

std::string textOf(const BurShape& head) {
  for (const Form& form : forms())
    if (form.kind == head.kind && form.profile == head.profile && !form.isOrdered())
      return fmt::format("{}:{}", form.key, head.radius_mm) +
             (form.measures.size() > 1 ? fmt::format(",{}", head.length_mm) : "");
  return "unknown";
}

}  // namespace app
