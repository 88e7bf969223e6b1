#include "assets/synthetic/face_colours.h"

#include <array>
#include <cmath>

#include "assets/synthetic/face_frames.h"
#include "assets/tooth.h"

namespace assets {
namespace {

using glm::dvec3;

constexpr dvec3 kSkin{0.66, 0.375, 0.265};
constexpr dvec3 kFlush{0.62, 0.235, 0.175};
constexpr dvec3 kShade{0.42, 0.225, 0.17};
constexpr dvec3 kVermilion{0.48, 0.16, 0.13};
constexpr dvec3 kMucosa{0.50, 0.125, 0.11};
constexpr dvec3 kTongue{0.52, 0.17, 0.15};
constexpr dvec3 kNeck{0.66, 0.56, 0.40};

}  // namespace

FaceColours::FaceColours(const HeadShape& head, std::uint32_t seed)
    : head_(head), phase_(seed % 97, seed % 89, seed % 83) {}

double FaceColours::mottling(const dvec3& p, double wavelength_mm) const {
  // A few waves in different directions.
  const dvec3 q = 6.2832 / wavelength_mm * p + phase_;
  return 0.25 * (std::sin(q.x + 1.3 * std::sin(0.7 * q.y)) + std::sin(1.1 * q.y + 1.7 * std::sin(0.8 * q.z + 2.0)) +
                 std::sin(0.9 * q.z + 1.5 * std::sin(0.6 * q.x + 4.0)) + std::sin(0.7 * (q.x + q.y - q.z)));
}

double FaceColours::openness(const dvec3& p, const dvec3& n) const {
  constexpr std::array<double, 4> kSteps_mm = {1.5, 4.0, 9.0, 18.0};
  double blocked = 0.0;
  double weight = 0.34;
  for (const double step_mm : kSteps_mm) {
    blocked += weight * std::clamp((step_mm - head_.distance_mm(p + step_mm * n)) / step_mm, 0.0, 1.0);
    weight *= 0.85;
  }
  return std::clamp(1.0 - blocked, 0.0, 1.0);
}

bool FaceColours::isWet(const dvec3& p) const {
  const dvec3 k = head_.opening().skullFromMandible(p);
  return k.z < 50.0 && k.z < 19.0 + 0.5 * (k.y + 16.0) && head_.closed_mm(p) < -3.2 &&
         head_.rim().lip(p).distance_mm > -2.5;
}

glm::vec3 FaceColours::head(const dvec3& p, const dvec3& n) const {
  const dvec3 k = head_.opening().skullFromMandible(p);
  const dvec3 m(std::abs(k.x), k.y, k.z);
  // Flushed cheeks, nose and chin, darker around the eyes, mottled.
  double flush = 0.55 * bump(m, {40, 4, 40}, {20, 22, 18}) + 0.7 * bump(m, {3, -26, 31}, {9, 9, 9}) +
                 0.3 * bump(p, {0, -9, -28}, {16, 12, 12}) + 0.35 * bump(m, {14, -13, 27}, {5, 7, 6});
  flush += 0.12 * mottling(p, 9.0) + 0.10 * mottling(p, 23.0);
  const double shade =
      0.55 * bump(m, {30, -2, 72}, {15, 9, 8}) + 0.25 * bump(m, {25, -2, 60}, {10, 8, 4}) + 0.05 * mottling(p, 4.0);
  dvec3 colour = glm::mix(kSkin, kFlush, std::clamp(flush, 0.0, 0.8));
  colour = glm::mix(colour, kShade, std::clamp(shade, 0.0, 0.8));
  colour *= 1.0 + 0.035 * mottling(p, 3.1);

  const dvec3 from_mouth = p - dvec3(8, 10, 14);
  if (glm::dot(from_mouth, from_mouth) < 90.0 * 90.0) {
    // Vermilion, broader in the middle than at the corners.
    const MouthRim::LipPoint lip = head_.rim().lip(p);
    const double round = 6.2832 * lip.fraction;
    const bool lower = lip.fraction > 0.28 && lip.fraction < 0.78;
    const double middle = std::max(0.0, lower ? -std::cos(round - 0.12) : std::cos(round));
    const double bow = lower ? 0.0 : 1.2 * std::exp(-std::pow(std::sin(round) / 0.14, 2.0));
    const double width = 3.4 + (lower ? 4.4 : 3.4) * std::pow(middle, 1.4) - bow;
    const double outside = head_.rim().opening_mm(p.x, p.z);
    const double red = 0.92 * smoothStep(width + 1.0, width - 0.8, outside) * smoothStep(5.5, 2.5, lip.distance_mm);
    const double crease = 1.0 - 0.10 * std::pow(std::abs(std::sin(lip.fraction * 260.0 + 2.0 * mottling(p, 7.0))), 3.0);
    colour = glm::mix(colour, kVermilion * crease, red);
    const double depth = head_.closed_mm(p);
    const double lining = smoothStep(-2.0, -5.0, depth) * smoothStep(-1.0, 2.0, lip.distance_mm + 1.5) *
                          smoothStep(-8.0, -2.0, 19.0 + 0.5 * (k.y + 16.0) - k.z);
    const double inside = std::max(lining, smoothStep(0.5, -1.5, outside) * smoothStep(-0.8, -2.2, depth));
    const dvec3 wet = kMucosa * (1.0 + 0.10 * mottling(p, 6.0));
    colour = glm::mix(colour, wet, inside);
    // Dark throat.
    colour *= 1.0 - 0.85 * inside * smoothStep(40.0, 84.0, p.y);
  }
  return glm::vec3(colour * glm::mix(dvec3(0.30, 0.22, 0.20), dvec3(1.0), openness(p, n)));
}

glm::vec3 FaceColours::tongue(const dvec3& p, const dvec3& n) const {
  const double coat = 0.25 * smoothStep(4.0, 40.0, p.y) * smoothStep(0.3, 0.9, n.z);
  const dvec3 colour = glm::mix(kTongue, dvec3(0.60, 0.36, 0.31), coat + 0.08 * mottling(p, 2.3)) *
                       (1.0 - 0.8 * smoothStep(44.0, 84.0, p.y));
  return glm::vec3(colour * glm::mix(0.3, 1.0, openness(p + 1.0 * n, n)));
}

glm::vec3 FaceColours::tooth(const dvec3& p, const dvec3& n) const {
  // Yellower and darker toward the gingiva, and backward in the mouth.
  const double gingiva = 1.0 - smoothStep(0.5, 4.5, head_.distance_mm(p));
  const dvec3 colour = glm::mix(dvec3(kEnamelAlbedo), kNeck, 0.65 * gingiva);
  return glm::vec3(colour * glm::mix(0.5, 1.0, openness(p + 0.5 * n, n)));
}

}  // namespace assets
