#include "app/session/flap_event.h"

#include <cmath>

#include <fmt/core.h>
#include <nlohmann/json.hpp>

#include "assets/json_depth.h"

namespace app {
namespace {

using FlapJson = nlohmann::ordered_json;

double toHundredth(double value) { return std::round(100.0 * value) / 100.0; }

std::optional<double> numberIn(const FlapJson& all, const char* key, double low, double high) {
  const auto found = all.find(key);
  if (found == all.end() || !found->is_number()) return {};
  const double value = found->get<double>();
  return value >= low && value <= high ? std::optional(value) : std::nullopt;
}

}  // namespace

std::string flapText(const FlapRecord& flap) {
  const FlapJson all = {{"incision_mm", toHundredth(flap.incision_mm)},
                        {"full_share", toHundredth(flap.full_share)},
                        {"lingual_mm", flap.lingual_mm ? FlapJson(toHundredth(*flap.lingual_mm)) : FlapJson()},
                        {"beyond_lingual_mm", toHundredth(flap.beyond_lingual_mm)},
                        {"limb_mm", toHundredth(flap.limb_mm)},
                        {"papilla_spared", flap.papilla_spared ? FlapJson(*flap.papilla_spared) : FlapJson()},
                        {"raised_share", toHundredth(flap.raised_share)},
                        {"raised_mm2", toHundredth(flap.raised_mm2)},
                        {"tears", flap.tears},
                        {"slips", flap.slips},
                        {"bur_touches", flap.bur_touches},
                        {"held", flap.is_held},
                        {"digest", fmt::format("{:016x}", flap.digest)}};
  return all.dump();
}

std::optional<FlapRecord> flapFrom(const std::string& text) {
  constexpr double kFar_mm = 1000.0, kMost = 1e6;
  if (assets::isNestedTooDeep(text)) return {};
  const FlapJson all = FlapJson::parse(text, nullptr, false);
  if (!all.is_object()) return {};
  FlapRecord flap;
  const auto incision = numberIn(all, "incision_mm", 0.0, kFar_mm), full = numberIn(all, "full_share", 0.0, 1.0);
  const auto beyond = numberIn(all, "beyond_lingual_mm", 0.0, kFar_mm), limb = numberIn(all, "limb_mm", 0.0, kFar_mm);
  const auto share = numberIn(all, "raised_share", 0.0, 1.0), mm2 = numberIn(all, "raised_mm2", 0.0, kMost);
  const auto tears = numberIn(all, "tears", 0.0, kMost), slips = numberIn(all, "slips", 0.0, kMost);
  const auto touches = numberIn(all, "bur_touches", 0.0, kMost);
  if (!incision || !full || !beyond || !limb || !share || !mm2 || !tears || !slips || !touches) return {};
  if (!all.contains("held") || !all["held"].is_boolean() || !all.contains("digest") || !all["digest"].is_string())
    return {};
  flap.incision_mm = *incision, flap.full_share = *full, flap.beyond_lingual_mm = *beyond, flap.limb_mm = *limb;
  flap.raised_share = *share, flap.raised_mm2 = *mm2;
  flap.tears = static_cast<int>(*tears), flap.slips = static_cast<int>(*slips);
  flap.bur_touches = static_cast<int>(*touches);
  flap.lingual_mm = numberIn(all, "lingual_mm", -kFar_mm, kFar_mm);
  if (const auto papilla = all.find("papilla_spared"); papilla != all.end() && papilla->is_boolean())
    flap.papilla_spared = papilla->get<bool>();
  flap.is_held = all["held"].get<bool>();
  const std::string digest = all["digest"].get<std::string>();
  if (digest.size() != 16 || digest.find_first_not_of("0123456789abcdef") != std::string::npos) return {};
  flap.digest = std::stoull(digest, nullptr, 16);
  return flap;
}

std::string flapInWords(const FlapRecord& flap) {
  if (flap.incision_mm == 0.0) return "gum closed";
  std::string words =
      fmt::format("{}, incision {:.0f} mm, {:.0f} % of it to the bone",
                  flap.limb_mm >= kLeastLimb_mm ? "triangular" : "envelope", flap.incision_mm, 100.0 * flap.full_share);
  if (flap.beyond_lingual_mm > 0.0)
    words += fmt::format(", {:.1f} mm of it on the tongue's side", flap.beyond_lingual_mm);
  if (flap.papilla_spared && !*flap.papilla_spared) words += ", through the second molar's papilla";
  words += fmt::format("; raised {:.0f} % of what the plan bares", 100.0 * flap.raised_share);
  if (flap.is_held) words += ", held";
  const auto count = [&](int times, const char* what) {
    if (times > 0) words += fmt::format("; {} {}×", what, times);
  };
  count(flap.tears, "torn"), count(flap.slips, "retractor slipped"), count(flap.bur_touches, "bur on it");
  return words;
}

}  // namespace app
