#include "app/session/bite_event.h"

#include <cmath>
#include <string_view>

#include <nlohmann/json.hpp>

#include "assets/json_depth.h"

namespace app {
namespace {

using BiteJson = nlohmann::ordered_json;

constexpr double kMostBite_um = 1e5, kMostMark_mm2 = 1e3, kMostBite_s = 1e6;
constexpr std::size_t kMostContacts = 1000, kLongestPlace = 40;
constexpr std::string_view kMade = "made", kScanned = "scanned", kHinge = "hinge", kBalance = "balance";

std::optional<double> biteNumber(const BiteJson& value, const char* key, double most) {
  if (!value.is_object() || !value.contains(key) || !value[key].is_number()) return {};
  const double number = value[key].get<double>();
  return number >= 0.0 && number <= most ? std::optional(number) : std::nullopt;
}

std::optional<std::string> biteWord(const BiteJson& value, const char* key) {
  if (!value.is_object() || !value.contains(key) || !value[key].is_string()) return {};
  std::string word = value[key].get<std::string>();
  return word.size() <= kLongestPlace ? std::optional(std::move(word)) : std::nullopt;
}

double rounded(double value, double digits) { return std::round(digits * value) / digits; }

}  // namespace

std::string biteText(const BiteRecord& bite) {
  BiteJson contacts = BiteJson::array();
  for (const BiteRecord::Contact& contact : bite.contacts)
    contacts.push_back({{"where", contact.where},
                        {"area_mm2", rounded(contact.area_mm2, 1000.0)},
                        {"gap_um", rounded(contact.gap_um, 1.0)}});
  BiteJson json = {{"t_s", bite.t_s},
                   {"paper_um", bite.paper_um},
                   {"antagonist", bite.is_made ? kMade : kScanned},
                   {"high_um", rounded(bite.high_um, 1.0)},
                   {"clearance_um", bite.clearance_um ? BiteJson(rounded(*bite.clearance_um, 1.0)) : BiteJson()},
                   {"first", bite.first},
                   {"contacts", contacts}};
  if (!bite.closing.empty()) json["closing"] = bite.closing, json["balanced"] = bite.is_balanced;
  return json.dump();
}

std::optional<BiteRecord> biteFrom(const std::string& text) {
  if (assets::isNestedTooDeep(text)) return {};
  const BiteJson json = BiteJson::parse(text, nullptr, false);
  const auto t_s = biteNumber(json, "t_s", kMostBite_s), paper_um = biteNumber(json, "paper_um", kMostBite_um),
             high_um = biteNumber(json, "high_um", kMostBite_um);
  const auto antagonist = biteWord(json, "antagonist"), first = biteWord(json, "first");
  if (!t_s || !paper_um || !high_um || !first || (antagonist != kMade && antagonist != kScanned)) return {};
  BiteRecord bite{*t_s, *paper_um, antagonist == kMade, *high_um, {}, *first, {}, {}, false};
  if (!json.contains("clearance_um")) return {};
  if (!json["clearance_um"].is_null()) {
    bite.clearance_um = biteNumber(json, "clearance_um", kMostBite_um);
    if (!bite.clearance_um) return {};
  }
  if (!json.contains("contacts") || !json["contacts"].is_array() || json["contacts"].size() > kMostContacts) return {};
  if (json.contains("closing")) {
    const auto closing = biteWord(json, "closing");
    if ((closing != kHinge && closing != kBalance) || !json.contains("balanced") || !json["balanced"].is_boolean())
      return {};
    bite.closing = *closing, bite.is_balanced = json["balanced"].get<bool>();
  }
  for (const BiteJson& one : json["contacts"]) {
    const auto where = biteWord(one, "where");
    const auto area_mm2 = biteNumber(one, "area_mm2", kMostMark_mm2), gap_um = biteNumber(one, "gap_um", kMostBite_um);
    if (!where || !area_mm2 || !gap_um) return {};
    bite.contacts.push_back({*where, *area_mm2, *gap_um});
  }
  return bite;
}

}  // namespace app
