#include "app/session/way_event.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <string_view>

#include <fmt/core.h>
#include <nlohmann/json.hpp>

#include "assets/json_depth.h"

namespace app {
namespace {

using Json = nlohmann::ordered_json;

constexpr std::array<std::string_view, 4> kAnswers = {"free", "grazes", "blocked", "not-found"};
constexpr double kLeastTold_mm3 = 0.05, kToldShare = 0.2, kNearlyAll = 0.8;  // of what keeps a piece in
constexpr std::size_t kMostTold = 2;

double inHundredths(double value) { return std::round(100.0 * value) / 100.0; }

Json jsonOf(const WayOfPiece& piece) {
  Json kept_by = Json::array();
  for (std::size_t n = 0; n < std::min(piece.kept_by.size(), kMostKeepers); ++n) {
    const Keeper& one = piece.kept_by[n];
    const glm::dvec3& p = one.centre_P_mm;
    kept_by.push_back(
        {one.what, inHundredths(one.volume_mm3), inHundredths(p.x), inHundredths(p.y), inHundredths(p.z)});
  }
  return {{"piece", piece.piece}, {"answer", kAnswers[static_cast<std::size_t>(piece.answer)]},
          {"waits", piece.waits}, {"lift", piece.lift},
          {"kept_by", kept_by},   {"mm3", inHundredths(piece.kept_by_mm3)},
          {"poses", piece.poses}};
}

bool isAmount(const Json& number) {
  return number.is_number() && std::isfinite(number.get<double>()) && number.get<double>() >= 0.0;
}

/// None: not what jsonOf makes.
std::optional<Keeper> keeperFrom(const Json& list) {
  if (!list.is_array() || list.size() != 5 || !list[0].is_string() || !isAmount(list[1])) return {};
  Keeper one{list[0].get<std::string>(), list[1].get<double>(), {}};
  for (int axis = 0; axis < 3; ++axis) {
    const Json& number = list[static_cast<std::size_t>(axis) + 2];
    if (!number.is_number() || !std::isfinite(number.get<double>())) return {};
    one.centre_P_mm[axis] = number.get<double>();
  }
  return one;
}

std::optional<WayOfPiece> pieceFrom(const Json& all) {
  if (!all.is_object()) return {};
  for (const char* key : {"piece", "answer", "waits", "lift", "kept_by", "mm3", "poses"})
    if (!all.contains(key)) return {};
  if (!all["piece"].is_string() || !all["answer"].is_string() || !all["waits"].is_boolean() ||
      !all["lift"].is_string() || !isAmount(all["mm3"]) || !all["poses"].is_number_unsigned())
    return {};
  const auto answer = std::ranges::find(kAnswers, all["answer"].get<std::string>());
  const Json& kept_by = all["kept_by"];
  if (answer == kAnswers.end() || !kept_by.is_array() || kept_by.size() > kMostKeepers) return {};
  WayOfPiece piece;
  piece.piece = all["piece"].get<std::string>();
  piece.answer = static_cast<KeptIn>(answer - kAnswers.begin());
  piece.waits = all["waits"].get<bool>();
  piece.lift = all["lift"].get<std::string>();
  piece.kept_by_mm3 = all["mm3"].get<double>();
  piece.poses = all["poses"].get<std::size_t>();
  for (const Json& list : kept_by) {
    const auto one = keeperFrom(list);
    if (!one) return {};
    piece.kept_by.push_back(*one);
  }
  return piece;
}

bool comesOut(const WayOfPiece& piece) { return piece.answer == KeptIn::free || piece.answer == KeptIn::tightly; }

/// "distobuccal bone holds the crown: 3.1 mm³, overlying bone 1.2 mm³".
std::string keptWords(const WayOfPiece& piece) {
  if (piece.kept_by.empty()) return fmt::format("the {} is held: {:.1f} mm³", piece.piece, piece.kept_by_mm3);
  const Keeper& most = piece.kept_by.front();
  std::string words = fmt::format("{} holds the {}: {:.1f} mm³", most.what, piece.piece, most.volume_mm3);
  double told_mm3 = most.volume_mm3;
  for (std::size_t n = 1; n < std::min(kMostTold, piece.kept_by.size()); ++n) {
    const Keeper& one = piece.kept_by[n];
    if (one.volume_mm3 < std::max(kLeastTold_mm3, kToldShare * piece.kept_by_mm3)) break;
    words += fmt::format(", {} {:.1f} mm³", one.what, one.volume_mm3);
    told_mm3 += one.volume_mm3;
  }
  return told_mm3 >= kNearlyAll * piece.kept_by_mm3 ? words : words + fmt::format(", {:.1f} in all", piece.kept_by_mm3);
}

std::string wordsOf(const WayOfPiece& piece) {
  switch (piece.answer) {
    case KeptIn::free:
    case KeptIn::tightly:
      return fmt::format("the {} {}{}", piece.piece, piece.answer == KeptIn::free ? "is free" : "comes out tightly",
                         piece.lift.empty() ? "" : ": lift it " + piece.lift);
    case KeptIn::held:
      return keptWords(piece);
    case KeptIn::not_found:
      break;
  }
  return fmt::format("no way found for the {} in {} poses", piece.piece, piece.poses);
}

}  // namespace

const WayOfPiece* nextKept(const WayRecord& way) {
  const auto kept = std::ranges::find_if_not(way.pieces, comesOut);
  return kept == way.pieces.end() ? nullptr : &*kept;
}

std::string wayText(const WayRecord& way) {
  Json pieces = Json::array();
  for (std::size_t n = 0; n < std::min(way.pieces.size(), kMostWays); ++n) pieces.push_back(jsonOf(way.pieces[n]));
  return Json{{"asked", way.was_asked}, {"pieces", pieces}}.dump();
}

std::optional<WayRecord> wayFrom(const std::string& text) {
  if (assets::isNestedTooDeep(text)) return {};
  const Json all = Json::parse(text, nullptr, false);
  if (!all.is_object() || !all.contains("asked") || !all.contains("pieces") || !all["asked"].is_boolean() ||
      !all["pieces"].is_array() || all["pieces"].size() > kMostWays)
    return {};
  WayRecord way;
  way.was_asked = all["asked"].get<bool>();
  for (const Json& piece : all["pieces"]) {
    auto one = pieceFrom(piece);
    if (!one) return {};
    way.pieces.push_back(std::move(*one));
  }
  return way;
}

/// What to do now, and what comes next.
std::string wayInWords(const WayRecord& way) {
  if (way.pieces.empty()) return "";
  const WayOfPiece& first = way.pieces.front();
  std::string words = wordsOf(first);
  if (way.pieces.size() == 1) return words;
  const WayOfPiece& second = way.pieces[1];
  if (comesOut(first) && !comesOut(second)) return words + "; then " + wordsOf(second);
  return words + fmt::format("; the {} after it", second.piece);
}

}  // namespace app
