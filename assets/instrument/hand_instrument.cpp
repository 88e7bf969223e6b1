#include "assets/instrument/hand_instrument.h"

#include <algorithm>
#include <cmath>
#include <span>
#include <vector>

#include "assets/mesh/catmull_rom.h"
#include "assets/mesh/closed_sweep.h"
#include "calibration/geometry/units.h"

namespace assets {
namespace {

using calibration::kPi;
using glm::dvec2;
using glm::dvec3;

/// A section square to z.
struct Knot {
  double z_mm;
  dvec2 centre_mm, half_mm;
  double squareness = 0.0;  ///< 0: an ellipse, 1: nearly a rectangle
  double sharp = 0.0;       ///< the side towards -y is a cutting edge
  double hollow_mm = 0.0;   ///< of the face towards -y
  int steps = 3;            ///< to the next knot
};
constexpr std::size_t kAround = 24;

const Material kSteel{{0.60f, 0.61f, 0.63f, 1.0f}, 0.34f, 1.0f};
const Material kBladeSteel{{0.72f, 0.73f, 0.75f, 1.0f}, 0.22f, 1.0f};

// No. 15: a short belly that curves up to the tip, 0.38 mm thick.
constexpr Knot kScalpelBlade[] = {
    {-0.30, {0.0, 0.00}, {0.03, 0.03}, 0.2, 0.5, 0, 1}, {-0.20, {0.0, 0.02}, {0.06, 0.16}, 0.3, 0.8, 0, 2},
    {0.20, {0.0, 0.05}, {0.12, 0.50}, 0.4, 0.9, 0, 3},  {1.20, {0.0, 0.10}, {0.17, 1.05}, 0.5, 0.9, 0, 3},
    {3.00, {0.0, 0.20}, {0.19, 1.55}, 0.5, 0.9, 0, 3},  {6.00, {0.0, 0.35}, {0.19, 1.85}, 0.5, 0.9, 0, 3},
    {10.00, {0.0, 0.55}, {0.19, 1.95}, 0.5, 0.9, 0, 2}, {11.50, {0.0, 0.75}, {0.19, 1.75}, 0.6, 0.1, 0, 2},
    {16.00, {0.0, 0.75}, {0.19, 2.60}, 0.8, 0.0, 0, 3}, {22.00, {0.0, 0.75}, {0.19, 2.80}, 0.8, 0.0, 0, 1},
    {22.50, {0.0, 0.75}, {0.19, 2.40}, 0.8, 0.0, 0, 1}};
constexpr Knot kScalpelNeck[] = {{13.50, {0.0, 0.75}, {0.50, 1.00}, 0.5, 0, 0, 1},
                                 {14.20, {0.0, 0.75}, {0.75, 1.40}, 0.5, 0, 0, 2},
                                 {21.00, {0.0, 0.75}, {0.85, 1.60}, 0.5, 0, 0, 3},
                                 {28.00, {0.0, 0.80}, {1.00, 2.20}, 0.5, 0, 0, 1},
                                 {30.00, {0.0, 0.85}, {1.05, 2.40}, 0.5, 0, 0, 1}};
constexpr Knot kScalpelHandle[] = {
    {28.0, {0.0, 0.85}, {0.90, 2.20}, 0.5, 0, 0, 1}, {29.5, {0.0, 0.9}, {1.30, 3.20}, 0.7, 0, 0, 2},
    {45.0, {0.0, 1.0}, {1.40, 3.60}, 0.7, 0, 0, 6},  {80.0, {0.0, 1.0}, {1.40, 3.60}, 0.7, 0, 0, 6},
    {118.0, {0.0, 1.0}, {1.30, 3.20}, 0.7, 0, 0, 2}, {122.0, {0.0, 1.0}, {1.00, 2.40}, 0.6, 0, 0, 1},
    {123.0, {0.0, 1.0}, {0.30, 0.80}, 0.5, 0, 0, 1}};

// Molt no. 9: broad, its end round and thin.
constexpr Knot kPeriostealBlade[] = {
    {-0.60, {0.0, 0.0}, {0.60, 0.05}, 0.2, 0, 0, 1},   {-0.50, {0.0, 0.0}, {1.40, 0.18}, 0.2, 0, 0, 2},
    {0.00, {0.0, 0.0}, {2.20, 0.34}, 0.3, 0, 0, 2},    {1.00, {0.0, 0.0}, {2.80, 0.50}, 0.4, 0, 0.1, 2},
    {3.00, {0.0, 0.0}, {3.20, 0.60}, 0.4, 0, 0.2, 3},  {8.00, {0.0, 0.0}, {3.00, 0.65}, 0.4, 0, 0.2, 3},
    {12.0, {0.0, 0.0}, {2.20, 0.85}, 0.4, 0, 0.05, 3}, {16.0, {0.0, 0.0}, {1.30, 1.10}, 0.1, 0, 0, 2},
    {18.0, {0.0, 0.0}, {0.90, 0.90}, 0.0, 0, 0, 1}};
// Lucas no. 85.
constexpr Knot kCuretteSpoon[] = {
    {-1.20, {0.0, 0.20}, {0.25, 0.10}, 0.0, 0, 0.0, 1},  {-1.05, {0.0, 0.20}, {0.65, 0.30}, 0.0, 0, 0.10, 2},
    {-0.50, {0.0, 0.15}, {1.05, 0.60}, 0.1, 0, 0.40, 2}, {0.60, {0.0, 0.10}, {1.30, 0.85}, 0.1, 0, 0.70, 2},
    {2.20, {0.0, 0.10}, {1.25, 0.85}, 0.1, 0, 0.65, 2},  {3.60, {0.0, 0.05}, {0.95, 0.80}, 0.1, 0, 0.25, 2},
    {5.00, {0.0, 0.00}, {0.80, 0.80}, 0.0, 0, 0.0, 3},   {12.0, {0.0, 0.00}, {0.90, 0.90}, 0.0, 0, 0.0, 3},
    {18.0, {0.0, 0.00}, {0.90, 0.90}, 0.0, 0, 0.0, 1}};
// Miller: 4 mm wide, 12 mm long; its teeth are added to the face.
constexpr Knot kFileHead[] = {
    {-1.00, {0.0, 0.0}, {0.90, 0.25}, 0.5, 0, 0, 1}, {-0.85, {0.0, 0.0}, {1.50, 0.60}, 0.6, 0, 0, 1},
    {-0.40, {0.0, 0.0}, {1.85, 0.90}, 0.7, 0, 0, 2}, {0.50, {0.0, 0.0}, {2.00, 1.00}, 0.7, 0, 0, 24},
    {10.5, {0.0, 0.0}, {2.00, 1.00}, 0.7, 0, 0, 2},  {12.5, {0.0, 0.0}, {1.30, 1.00}, 0.4, 0, 0, 2},
    {15.0, {0.0, 0.0}, {1.10, 1.10}, 0.0, 0, 0, 1},  {18.0, {0.0, 0.0}, {1.00, 1.00}, 0.0, 0, 0, 1}};
constexpr double kTooth_mm = 0.18;

// The tube is open: its wall goes in before it goes up.
constexpr Knot kSuctionTube[] = {
    {6.00, {0.0, 0.0}, {1.10, 1.10}, 0, 0, 0, 1},  {-1.35, {0.0, 0.0}, {1.10, 1.10}, 0, 0, 0, 1},
    {-1.46, {0.0, 0.0}, {1.16, 1.16}, 0, 0, 0, 1}, {-1.50, {0.0, 0.0}, {1.30, 1.30}, 0, 0, 0, 1},
    {-1.46, {0.0, 0.0}, {1.44, 1.44}, 0, 0, 0, 1}, {-1.35, {0.0, 0.0}, {1.50, 1.50}, 0, 0, 0, 1},
    {20.0, {0.0, 0.0}, {1.50, 1.50}, 0, 0, 0, 2},  {42.0, {0.0, 0.3}, {1.60, 1.60}, 0, 0, 0, 4},
    {60.0, {0.0, 4.0}, {2.00, 2.00}, 0, 0, 0, 4},  {75.0, {0.0, 10.0}, {2.40, 2.40}, 0, 0, 0, 1}};
constexpr Knot kSuctionHandle[] = {
    {72.0, {0.0, 8.9}, {2.60, 2.60}, 0, 0, 0, 1},   {74.0, {0.0, 9.7}, {4.00, 4.00}, 0, 0, 0, 2},
    {95.0, {0.0, 17.0}, {4.60, 4.60}, 0, 0, 0, 5},  {130.0, {0.0, 29.0}, {4.40, 4.40}, 0, 0, 0, 2},
    {134.0, {0.0, 30.3}, {3.20, 3.20}, 0, 0, 0, 1}, {135.0, {0.0, 30.6}, {1.60, 1.60}, 0, 0, 0, 1}};

// An applicator's tip: a small ball on a thin neck; a plugger's: a round end of 1.4 mm.
constexpr Knot kApplicatorTip[] = {
    {-0.50, {0.0, 0.0}, {0.05, 0.05}, 0, 0, 0, 1}, {-0.45, {0.0, 0.0}, {0.22, 0.22}, 0, 0, 0, 1},
    {-0.25, {0.0, 0.0}, {0.43, 0.43}, 0, 0, 0, 1}, {0.00, {0.0, 0.0}, {0.50, 0.50}, 0, 0, 0, 1},
    {0.25, {0.0, 0.0}, {0.43, 0.43}, 0, 0, 0, 1},  {0.60, {0.0, 0.0}, {0.34, 0.34}, 0, 0, 0, 2},
    {9.00, {0.0, 0.0}, {0.40, 0.40}, 0, 0, 0, 3},  {16.0, {0.0, 0.0}, {0.75, 0.75}, 0, 0, 0, 2},
    {18.0, {0.0, 0.0}, {0.90, 0.90}, 0, 0, 0, 1}};
// Of gutta-percha: a slender cone.
constexpr Knot kConeTip[] = {
    {-0.40, {0.0, 0.0}, {0.05, 0.05}, 0, 0, 0, 1}, {-0.36, {0.0, 0.0}, {0.20, 0.20}, 0, 0, 0, 1},
    {-0.20, {0.0, 0.0}, {0.33, 0.33}, 0, 0, 0, 1}, {0.00, {0.0, 0.0}, {0.38, 0.38}, 0, 0, 0, 2},
    {3.00, {0.0, 0.0}, {0.45, 0.45}, 0, 0, 0, 2},  {6.00, {0.0, 0.0}, {0.52, 0.52}, 0, 0, 0, 2},
    {9.00, {0.0, 0.0}, {0.56, 0.56}, 0, 0, 0, 3},  {16.0, {0.0, 0.0}, {0.75, 0.75}, 0, 0, 0, 2},
    {18.0, {0.0, 0.0}, {0.90, 0.90}, 0, 0, 0, 1}};
constexpr Knot kCarrierTip[] = {{-0.80, {0.0, 0.0}, {0.10, 0.10}, 0, 0, 0, 1},
                                {-0.75, {0.0, 0.0}, {0.55, 0.55}, 0, 0, 0, 1},
                                {-0.50, {0.0, 0.0}, {0.78, 0.78}, 0, 0, 0, 2},
                                {9.00, {0.0, 0.0}, {0.80, 0.80}, 0, 0, 0, 3},
                                {18.0, {0.0, 0.0}, {0.95, 0.95}, 0, 0, 0, 1}};
constexpr Knot kPluggerTip[] = {
    {-0.70, {0.0, 0.0}, {0.10, 0.10}, 0, 0, 0, 1}, {-0.66, {0.0, 0.0}, {0.45, 0.45}, 0, 0, 0, 1},
    {-0.40, {0.0, 0.0}, {0.66, 0.66}, 0, 0, 0, 1}, {0.00, {0.0, 0.0}, {0.70, 0.70}, 0, 0, 0, 2},
    {2.00, {0.0, 0.0}, {0.60, 0.60}, 0, 0, 0, 2},  {9.00, {0.0, 0.0}, {0.55, 0.55}, 0, 0, 0, 3},
    {18.0, {0.0, 0.0}, {0.90, 0.90}, 0, 0, 0, 1}};
// Slim enough for the upper part of a canal.
constexpr Knot kRootPluggerTip[] = {
    {-0.25, {0.0, 0.0}, {0.12, 0.12}, 0, 0, 0, 1}, {-0.20, {0.0, 0.0}, {0.22, 0.22}, 0, 0, 0, 1},
    {0.00, {0.0, 0.0}, {0.25, 0.25}, 0, 0, 0, 2},  {6.00, {0.0, 0.0}, {0.24, 0.24}, 0, 0, 0, 3},
    {14.0, {0.0, 0.0}, {0.45, 0.45}, 0, 0, 0, 3},  {18.0, {0.0, 0.0}, {0.90, 0.90}, 0, 0, 0, 1}};
// A small blade with one edge.
constexpr Knot kCarverTip[] = {
    {-0.40, {0.0, 0.0}, {0.05, 0.10}, 0.2, 0.8, 0, 1}, {-0.20, {0.0, 0.0}, {0.14, 0.32}, 0.2, 0.8, 0, 2},
    {0.60, {0.0, 0.0}, {0.26, 0.52}, 0.3, 0.9, 0, 2},  {3.00, {0.0, 0.0}, {0.32, 0.60}, 0.3, 0.8, 0, 2},
    {5.50, {0.0, 0.0}, {0.34, 0.42}, 0.1, 0.2, 0, 2},  {10.0, {0.0, 0.0}, {0.45, 0.45}, 0, 0, 0, 3},
    {18.0, {0.0, 0.0}, {0.90, 0.90}, 0, 0, 0, 1}};
// A glass rod, bent at its end, on a gun-like handle.
constexpr Knot kLampGuide[] = {
    {-3.00, {0.0, 0.0}, {3.60, 3.60}, 0, 0, 0, 1}, {-2.90, {0.0, 0.0}, {4.00, 4.00}, 0, 0, 0, 1},
    {6.00, {0.0, 0.0}, {4.00, 4.00}, 0, 0, 0, 3},  {16.0, {0.0, 1.5}, {4.20, 4.20}, 0, 0, 0, 4},
    {30.0, {0.0, 9.0}, {5.00, 5.00}, 0, 0, 0, 4},  {44.0, {0.0, 21.0}, {6.00, 6.00}, 0, 0, 0, 1}};
constexpr Knot kLampBody[] = {
    {41.0, {0.0, 18.5}, {6.00, 6.00}, 0, 0, 0, 1},    {44.0, {0.0, 21.0}, {10.0, 10.0}, 0.2, 0, 0, 2},
    {60.0, {0.0, 35.0}, {13.0, 13.0}, 0.2, 0, 0, 4},  {110.0, {0.0, 78.0}, {14.0, 14.0}, 0.2, 0, 0, 4},
    {130.0, {0.0, 95.0}, {12.0, 12.0}, 0.2, 0, 0, 2}, {134.0, {0.0, 98.0}, {6.00, 6.00}, 0.2, 0, 0, 1}};

// Shared by all but scalpel, suction tip and lamp.
constexpr Knot kShank[] = {{16.0, {0.0, 0.0}, {0.80, 0.80}, 0, 0, 0, 1},
                           {18.0, {0.0, 0.0}, {1.10, 1.10}, 0, 0, 0, 3},
                           {34.0, {0.0, 0.0}, {1.50, 1.50}, 0, 0, 0, 3},
                           {42.0, {0.0, 0.0}, {2.20, 2.20}, 0, 0, 0, 1},
                           {43.0, {0.0, 0.0}, {1.80, 1.80}, 0, 0, 0, 1}};
constexpr Knot kHandle[] = {
    {41.0, {0.0, 0.0}, {1.60, 1.60}, 0, 0, 0, 1},  {44.0, {0.0, 0.0}, {3.20, 3.20}, 0, 0, 0, 2},
    {50.0, {0.0, 0.0}, {3.80, 3.80}, 0, 0, 0, 12}, {80.0, {0.0, 0.0}, {3.80, 3.80}, 0, 0, 0, 12},
    {112.0, {0.0, 0.0}, {3.70, 3.70}, 0, 0, 0, 2}, {118.0, {0.0, 0.0}, {3.20, 3.20}, 0, 0, 0, 2},
    {121.0, {0.0, 0.0}, {1.40, 1.40}, 0, 0, 0, 1}};
constexpr double kGroove_mm = 0.22;

Ring section(const Knot& at) {
  const double power = glm::mix(1.0, 0.25, at.squareness);
  const auto rounded = [power](double value) { return std::copysign(std::pow(std::abs(value), power), value); };
  Ring ring;
  for (std::size_t n = 0; n < kAround; ++n) {
    const double turn = 2.0 * kPi * (static_cast<double>(n) + 0.5) / static_cast<double>(kAround);
    double across = rounded(std::cos(turn)), over = rounded(std::sin(turn));
    // A blade tapers from its back to its edge.
    across *= 1.0 - at.sharp * std::clamp(0.5 - 0.5 * over, 0.0, 1.0);
    double y_mm = at.half_mm.y * over;
    if (over < 0.0) y_mm += at.hollow_mm * std::max(0.0, 1.0 - across * across);
    ring.emplace_back(at.centre_mm.x + at.half_mm.x * across, at.centre_mm.y + y_mm, at.z_mm);
  }
  return ring;
}

/// `groove_mm`: every other ring between knots with more than ten steps is narrower by it; `teeth_mm`: the face towards
/// -y alone.
MeshPart part(std::span<const Knot> course, const char* name, const Material& material, double groove_mm = 0.0,
              double teeth_mm = 0.0) {
  std::vector<Ring> rings;
  for (std::size_t span = 0; span + 1 < course.size(); ++span)
    for (int n = span == 0 ? 0 : 1; n <= course[span].steps; ++n) {
      const double t = static_cast<double>(n) / course[span].steps;
      const auto value = [&](auto member) { return catmullRomAt(course, span, t, member); };
      Knot at{value(&Knot::z_mm),       value(&Knot::centre_mm), glm::max(value(&Knot::half_mm), dvec2(0.02)),
              value(&Knot::squareness), value(&Knot::sharp),     std::max(0.0, value(&Knot::hollow_mm))};
      const bool low = course[span].steps > 10 && n % 2 == 1;
      if (low) at.half_mm -= groove_mm;
      Ring ring = section(at);
      if (low)
        for (dvec3& p : ring) p.y = std::max(p.y, at.centre_mm.y - at.half_mm.y + teeth_mm);
      rings.push_back(std::move(ring));
    }
  MeshPart swept = closedSweep(rings);
  swept.name = name;
  swept.material = material;
  return swept;
}

MeshModel withHandle(MeshPart tip) {
  return {{std::move(tip), part(kShank, "Shank", kSteel), part(kHandle, "Handle", kSteel, kGroove_mm)}};
}

Material tinted(const glm::vec3& albedo, float roughness) { return {{albedo, 1.0f}, roughness, 0.0f}; }

/// With its material at the tip, as drawn in the tooth (render/volume/tissue_appearance).
MeshModel applicator(std::span<const Knot> tip, const glm::vec3& albedo) {
  const std::size_t kept = tip.size() - 3;
  MeshPart laden = part(tip.first(kept), "Blade", tinted(albedo, 0.4f));
  MeshModel model = withHandle(std::move(laden));
  model.parts.push_back(part(tip.subspan(kept - 1), "Neck", kSteel));
  return model;
}

}  // namespace

MeshModel handInstrument(HandInstrumentForm form) {
  switch (form) {
    case HandInstrumentForm::scalpel_15:
      break;
    case HandInstrumentForm::periosteal:
      return withHandle(part(kPeriostealBlade, "Blade", kSteel));
    case HandInstrumentForm::curette:
      return withHandle(part(kCuretteSpoon, "Blade", kSteel));
    case HandInstrumentForm::bone_file:
      return withHandle(part(kFileHead, "Blade", kSteel, 0.0, kTooth_mm));
    case HandInstrumentForm::suction:
      return {{part(kSuctionTube, "Blade", kSteel), part(kSuctionHandle, "Handle", kSteel)}};
    case HandInstrumentForm::composite:
      return applicator(kApplicatorTip, {0.93f, 0.76f, 0.44f});
    case HandInstrumentForm::glass_ionomer:
      return applicator(kApplicatorTip, {0.62f, 0.74f, 0.86f});
    case HandInstrumentForm::amalgam:
      return applicator(kCarrierTip, {0.40f, 0.42f, 0.45f});
    case HandInstrumentForm::wax:
      return applicator(kApplicatorTip, {0.20f, 0.45f, 0.30f});
    case HandInstrumentForm::gutta_percha:
      return applicator(kConeTip, {0.85f, 0.36f, 0.30f});
    case HandInstrumentForm::plugger:
      return withHandle(part(kPluggerTip, "Blade", kSteel));
    case HandInstrumentForm::root_plugger:
      return withHandle(part(kRootPluggerTip, "Blade", kSteel));
    case HandInstrumentForm::carver:
      return withHandle(part(kCarverTip, "Blade", kBladeSteel));
    case HandInstrumentForm::curing_lamp:
      return {{part(kLampGuide, "Blade", tinted({0.12f, 0.13f, 0.15f}, 0.2f)),
               part(kLampBody, "Handle", tinted({0.75f, 0.76f, 0.78f}, 0.5f))}};
  }
  return {{part(kScalpelBlade, "Blade", kBladeSteel), part(kScalpelNeck, "Shank", kSteel),
           part(kScalpelHandle, "Handle", kSteel)}};
}

}  // namespace assets
