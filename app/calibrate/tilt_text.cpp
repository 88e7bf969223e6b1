#include "app/calibrate/tilt_text.h"

#include <algorithm>
#include <cmath>

#include "app/calibrate/number_text.h"
#include "calibration/geometry/units.h"

namespace app {
namespace {

constexpr double kWorthSaying_deg = 5.0;

}  // namespace

double angleBetween_deg(const glm::dvec3& a, const glm::dvec3& b) {
  return calibration::degreesFromRad(std::atan2(glm::length(glm::cross(a, b)), glm::dot(a, b)));
}

std::string tiltText(const calibration::Vector<calibration::World>& present_W,
                     const calibration::Vector<calibration::World>& wanted_W) {
  const auto side_deg = [](const glm::dvec3& v) { return calibration::degreesFromRad(std::atan2(v.x, v.z)); };
  const auto up_deg = [](const glm::dvec3& v) {
    return calibration::degreesFromRad(std::asin(std::clamp(v.y, -1.0, 1.0)));
  };
  const double right = side_deg(wanted_W.xyz) - side_deg(present_W.xyz);
  const double up = up_deg(wanted_W.xyz) - up_deg(present_W.xyz);

  std::string words;
  if (std::abs(right) >= kWorthSaying_deg)
    words = fixedText(std::abs(right), 0) + "° to the " + (right > 0.0 ? "right" : "left");
  if (std::abs(up) >= kWorthSaying_deg)
    words += (words.empty() ? "" : " and ") + fixedText(std::abs(up), 0) + (up > 0.0 ? "° up" : "° down");
  return words.empty() ? words : "lean the handle " + words;
}

}  // namespace app
