#include "app/session/second_hand_event.h"

#include <algorithm>
#include <array>
#include <bit>
#include <cmath>
#include <cstdint>

#include <nlohmann/json.hpp>

#include "assets/json_depth.h"

namespace app {
namespace {

using PoseJson = nlohmann::json;

/// w, x, y, z of the rotation, then the translation.
std::array<double, 7> numbersOf(const SecondHandPlace& place) {
  const glm::dquat& q = place.X_PO.rotation;
  const glm::dvec3& p = place.X_PO.translation_mm;
  return {q.w, q.x, q.y, q.z, p.x, p.y, p.z};
}

template <std::size_t count>
std::optional<std::array<double, count>> numbersFrom(const PoseJson& object, const char* key) {
  constexpr double kFarthest_mm = 1e5;
  const auto found = object.find(key);
  if (found == object.end() || !found->is_array() || found->size() != count) return {};
  std::array<double, count> numbers{};
  for (std::size_t n = 0; n < count; ++n) {
    const PoseJson& number = (*found)[n];
    if (!number.is_number() || !(std::abs(number.get<double>()) < kFarthest_mm)) return {};
    numbers[n] = number.get<double>();
  }
  return numbers;
}

}  // namespace

bool isSamePlace(const SecondHandPlace& a, const SecondHandPlace& b) {
  if (a.instrument != b.instrument || a.is_tracked != b.is_tracked) return false;
  return !a.is_tracked || std::ranges::equal(numbersOf(a), numbersOf(b), {}, std::bit_cast<std::uint64_t, double>,
                                             std::bit_cast<std::uint64_t, double>);
}

std::string secondHandText(const SecondHandPlace& place) {
  PoseJson object = {{"instrument", assets::entryOf(place.instrument).name}};
  if (place.is_tracked) {
    const auto n = numbersOf(place);
    object["rotation_PO"] = {n[0], n[1], n[2], n[3]};
    object["translation_PO_mm"] = {n[4], n[5], n[6]};
  }
  return object.dump();
}

std::optional<SecondHandPlace> secondHandFrom(const std::string& text) {
  const PoseJson object = assets::isNestedTooDeep(text) ? PoseJson() : PoseJson::parse(text, nullptr, false);
  if (!object.is_object()) return {};
  const auto name = object.find("instrument");
  if (name == object.end() || !name->is_string()) return {};
  const auto entry = std::ranges::find(assets::kSecondInstruments, name->get_ref<const std::string&>(),
                                       &assets::SecondInstrumentEntry::name);
  if (entry == assets::kSecondInstruments.end()) return {};
  SecondHandPlace place{entry->instrument, false, {}};
  if (!object.contains("rotation_PO")) return place;
  const auto turn = numbersFrom<4>(object, "rotation_PO");
  const auto at = numbersFrom<3>(object, "translation_PO_mm");
  if (!turn || !at) return {};
  place.is_tracked = true;
  place.X_PO = {{(*turn)[0], (*turn)[1], (*turn)[2], (*turn)[3]}, {(*at)[0], (*at)[1], (*at)[2]}};
  constexpr double kUnit = 1e-6;
  if (!(std::abs(glm::dot(place.X_PO.rotation, place.X_PO.rotation) - 1.0) < kUnit)) return {};
  return place;
}

std::optional<SecondHandPlace> SecondHandTrack::at(double t_s) const {
  const auto later = std::ranges::upper_bound(places_, t_s, {}, &From::t_s);
  if (later == places_.begin() || !(later - 1)->place.is_tracked) return {};
  return (later - 1)->place;
}

}  // namespace app
