#include "app/session/eyes_event.h"

#include <cmath>

#include <nlohmann/json.hpp>

#include "assets/json_depth.h"

namespace app {
namespace {

using EyesJson = nlohmann::json;

std::optional<glm::dvec3> placeFrom(const EyesJson& object, const char* key) {
  constexpr double kFarthest_mm = 1e5;
  const auto found = object.find(key);
  if (found == object.end() || !found->is_array() || found->size() != 3) return {};
  glm::dvec3 place;
  for (int axis = 0; axis < 3; ++axis) {
    const EyesJson& number = (*found)[static_cast<std::size_t>(axis)];
    if (!number.is_number() || !(std::abs(number.get<double>()) < kFarthest_mm)) return {};
    place[axis] = number.get<double>();
  }
  return place;
}

}  // namespace

std::string eyesText(const EyesPlace& eyes) {
  const auto three = [](const glm::dvec3& p) { return EyesJson{p.x, p.y, p.z}; };
  return EyesJson{
      {"left_P_mm", three(eyes.left_P_mm)}, {"right_P_mm", three(eyes.right_P_mm)}, {"stereo", eyes.in_stereo}}
      .dump();
}

std::optional<EyesPlace> eyesFrom(const std::string& text) {
  const EyesJson object = assets::isNestedTooDeep(text) ? EyesJson() : EyesJson::parse(text, nullptr, false);
  if (!object.is_object()) return {};
  const auto left = placeFrom(object, "left_P_mm"), right = placeFrom(object, "right_P_mm");
  if (!left || !right) return {};
  const auto stereo = object.find("stereo");
  return EyesPlace{*left, *right, stereo != object.end() && stereo->is_boolean() && stereo->get<bool>()};
}

}  // namespace app
