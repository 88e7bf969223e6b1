#include "assets/synthetic/built_in_teeth.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>
#include <sstream>

#include "assets/load_error.h"
#include "assets/synthetic/root_canal.h"
#include "calibration/geometry/units.h"

namespace assets {
namespace {

constexpr double kStep_mm = 0.2;  ///< between places: an arc of 4 mm is met within 1.3 µm
constexpr double kConstrictionRadius_mm = 0.14;

/// One canal of a kind of tooth, in its frame.
struct CanalPlan {
  const char* name;
  std::size_t root;
  glm::dvec2 orifice_mm;  ///< on the chamber's floor, towards mesial and cheek
  double arc_radius_mm, arc_deg, apical_mm;
  double narrow_mm, wide_mm;   ///< radii at the orifice
  glm::dvec2 foramen_towards;  ///< from the root's middle
  double foramen_up_mm;        ///< above the apex
  double constriction_mm;      ///< short of the foramen
  double joins_mm;             ///< runs into the canal before it, so far short of its foramen; 0: it does not
  std::size_t cusp;            ///< where its files are read
};

struct PulpPlan {
  double roof_mm, floor_mm, round_mm;
  std::vector<glm::dvec2> outline_mm;
  double horn_mm;  ///< radius where they begin
  std::vector<CanalPlan> canals;
};

const PulpPlan& planOf(int position) {
  static const std::array<PulpPlan, 5> kPlans{{
      // First premolar: one canal, oval.
      {0.9,
       -0.67,
       0.45,
       {{0.0, -0.7}, {0.0, 0.8}},
       0.35,
       {{"single", 0, {0.0, 0.05}, 10.0, 12.0, 2.0, 0.38, 0.75, {-1.0, 0.2}, 0.5, 0.9, 0.0, 0}}},
      // Second premolar.
      {0.9,
       -0.67,
       0.5,
       {{0.0, -0.8}, {0.0, 0.8}},
       0.35,
       {{"single", 0, {0.0, 0.0}, 10.0, 14.0, 2.0, 0.40, 0.80, {-1.0, 0.1}, 0.5, 0.9, 0.0, 0}}},
      // First molar.
      {0.64,
       -0.93,
       0.55,
       {{2.05, 1.85}, {2.05, -1.85}, {-2.2, -0.7}, {-2.2, 0.7}},
       0.4,
       {{"mesiobuccal", 0, {2.05, 1.85}, 7.0, 48.0, 1.0, 0.30, 0.34, {-0.6, 1.0}, 0.7, 1.0, 0.0, 0},
        {"mesiolingual", 0, {2.05, -1.85}, 8.0, 46.0, 1.0, 0.30, 0.34, {-0.6, -1.0}, 0.7, 1.0, 0.0, 3},
        {"distal", 1, {-2.2, 0.0}, 12.0, 16.0, 2.0, 0.38, 0.80, {-1.0, 0.2}, 0.5, 0.9, 0.0, 2}}},
      // Second molar: the mesial canals join.
      {0.64,
       -0.93,
       0.5,
       {{1.9, 1.5}, {1.9, -1.5}, {-2.0, -0.6}, {-2.0, 0.6}},
       0.4,
       {{"mesiobuccal", 0, {1.9, 1.5}, 8.0, 42.0, 1.0, 0.28, 0.32, {-1.0, 0.2}, 0.6, 1.0, 0.0, 0},
        {"mesiolingual", 0, {1.9, -1.5}, 9.0, 22.0, 1.0, 0.28, 0.32, {-1.0, 0.2}, 0.6, 1.0, 3.0, 2},
        {"distal", 1, {-2.0, 0.0}, 12.0, 14.0, 2.0, 0.36, 0.72, {-1.0, 0.2}, 0.5, 0.9, 0.0, 1}}},
      // Third molar, young.
      {0.7,
       -0.87,
       0.6,
       {{1.8, 1.5}, {1.8, -1.5}, {-1.9, -0.7}, {-1.9, 0.7}},
       0.45,
       {{"mesiobuccal", 0, {1.8, 1.5}, 6.5, 56.0, 0.8, 0.34, 0.38, {-1.0, 0.2}, 0.6, 1.0, 0.0, 0},
        {"mesiolingual", 0, {1.8, -1.5}, 6.5, 42.0, 0.8, 0.34, 0.38, {-1.0, 0.2}, 0.6, 1.0, 2.5, 3},
        {"distal", 1, {-1.9, 0.05}, 10.0, 14.0, 1.5, 0.42, 0.85, {-1.0, 0.2}, 0.5, 0.9, 0.0, 2}}},
  }};
  return kPlans.at(static_cast<std::size_t>(position - 4));
}

/// The lowest point of a root.
glm::dvec3 apexOf(const std::vector<glm::dvec3>& surface, const RootParameters& root) {
  constexpr double kAround_mm = 1.5;
  glm::dvec3 apex(root.apex_mm, 0.0);
  for (const glm::dvec3& p : surface)
    if (p.z < apex.z && glm::distance(glm::dvec2(p), root.apex_mm) < kAround_mm) apex = p;
  return apex;
}

/// On the root's surface, from its middle at that height outwards.
glm::dvec3 foramenOf(const ToothShape& shape, const glm::dvec3& apex, const CanalPlan& plan) {
  const glm::dvec3 middle = apex + glm::dvec3(0.0, 0.0, plan.foramen_up_mm);
  const glm::dvec3 out(glm::normalize(plan.foramen_towards), 0.0);
  double within_mm = 0.0, beyond_mm = 3.0;
  for (int halving = 0; halving < 24; ++halving) {
    const double mm = 0.5 * (within_mm + beyond_mm);
    (shape.outer_mm(middle + mm * out) < 0.0 ? within_mm : beyond_mm) = mm;
  }
  return middle + within_mm * out;
}

/// A centre line from one point to another, and where it lies in the tooth.
struct Course {
  RootCanal line;
  glm::dvec3 from_mm, down, bend;

  glm::dvec3 at(double along_mm) const {
    const glm::dvec3 p = line.at(along_mm).p_mm;
    return from_mm - p.z * down + p.x * bend;
  }
};

/// The chord of straight, arc and straight is turned onto that of the two points; the arc bends to distal.
Course courseBetween(const glm::dvec3& from_mm, const glm::dvec3& to_mm, const CanalPlan& plan) {
  Course course;
  course.from_mm = from_mm;
  course.line.arc_radius_mm = plan.arc_radius_mm;
  course.line.arc_rad = calibration::radFromDegrees(plan.arc_deg);
  course.line.apical_mm = plan.apical_mm;
  const double R = plan.arc_radius_mm, A = course.line.arc_rad;
  const double across_mm = R * (1.0 - std::cos(A)) + plan.apical_mm * std::sin(A);
  const double bent_mm = R * std::sin(A) + plan.apical_mm * std::cos(A);
  const double chord_mm = glm::distance(from_mm, to_mm);
  course.line.straight_mm = std::sqrt(chord_mm * chord_mm - across_mm * across_mm) - bent_mm;

  const glm::dvec3 chord = (to_mm - from_mm) / chord_mm, distal(-1.0, 0.0, 0.0);
  const glm::dvec3 aside = glm::normalize(distal - glm::dot(distal, chord) * chord);
  const double turned = std::asin(across_mm / chord_mm);
  course.down = std::cos(turned) * chord - std::sin(turned) * aside;
  course.bend = std::sin(turned) * chord + std::cos(turned) * aside;
  return course;
}

/// Linear from the orifice to the constriction, then opening to the foramen.
CanalPlace placeAt(const glm::dvec3& p_P_mm, double along_mm, const ToothCanal& canal, double length_mm,
                   const CanalPlan& plan) {
  constexpr double kForamenWider_mm = 0.06;
  if (along_mm <= canal.constriction_mm) {
    const double t = along_mm / canal.constriction_mm;
    return {p_P_mm, along_mm, glm::mix(plan.narrow_mm, kConstrictionRadius_mm, t),
            glm::mix(plan.wide_mm, kConstrictionRadius_mm, t)};
  }
  const double t = (along_mm - canal.constriction_mm) / (length_mm - canal.constriction_mm);
  const double radius_mm = kConstrictionRadius_mm + t * kForamenWider_mm;
  return {p_P_mm, along_mm, radius_mm, radius_mm};
}

ToothCanal canalOf(const BuiltInTooth& tooth, const CanalPlan& plan, const std::vector<glm::dvec3>& surface,
                   double floor_mm) {
  const ToothParameters& form = lowerToothParameters(tooth.placed.position);
  const glm::dvec3 apex = apexOf(surface, form.roots[plan.root]);
  const Course course = courseBetween({plan.orifice_mm, floor_mm}, foramenOf(tooth.placed.shape, apex, plan), plan);
  const double length_mm = course.line.length_mm();
  ToothCanal canal;
  canal.name = plan.name;
  canal.constriction_mm = length_mm - plan.constriction_mm;
  canal.schneider_rad = course.line.schneider_rad();
  canal.apex_P_mm = tooth.frame.inP(apex);
  const CuspParameters& cusp = form.cusps[plan.cusp];
  canal.reference_P_mm = tooth.frame.inP({cusp.tip_mm, cusp.height_mm});
  // The constriction is one of the places.
  const auto steps = static_cast<int>(std::ceil(canal.constriction_mm / kStep_mm));
  const auto beyond = static_cast<int>(std::ceil(plan.constriction_mm / kStep_mm));
  for (int n = 0; n <= steps + beyond; ++n) {
    const double along_mm = n <= steps
                                ? canal.constriction_mm * n / steps
                                : canal.constriction_mm + (length_mm - canal.constriction_mm) * (n - steps) / beyond;
    canal.places.push_back(placeAt(tooth.frame.inP(course.at(along_mm)), along_mm, canal, length_mm, plan));
  }
  return canal;
}

/// A canal that runs into the one before it and shares its foramen.
ToothCanal joiningCanal(const BuiltInTooth& tooth, const CanalPlan& plan, const ToothCanal& other, std::size_t number,
                        double floor_mm) {
  const double meets_mm = other.length_mm() - plan.joins_mm;
  const Course course = courseBetween({plan.orifice_mm, floor_mm}, tooth.frame.local(other.at(meets_mm).p_P_mm), plan);
  const double own_mm = course.line.length_mm();
  ToothCanal canal = other;
  canal.name = plan.name;
  canal.joins = number;
  canal.places.clear();
  canal.constriction_mm = own_mm + other.constriction_mm - meets_mm;
  const CuspParameters& cusp = lowerToothParameters(tooth.placed.position).cusps[plan.cusp];
  canal.reference_P_mm = tooth.frame.inP({cusp.tip_mm, cusp.height_mm});
  const double narrow_mm = other.at(meets_mm).narrow_mm, wide_mm = other.at(meets_mm).wide_mm;
  const auto steps = static_cast<int>(std::ceil(own_mm / kStep_mm));
  for (int n = 0; n <= steps; ++n) {
    const double t = static_cast<double>(n) / steps;
    canal.places.push_back({tooth.frame.inP(course.at(t * own_mm)), t * own_mm, glm::mix(plan.narrow_mm, narrow_mm, t),
                            glm::mix(plan.wide_mm, wide_mm, t)});
  }
  for (CanalPlace place : other.places) {
    if (place.along_mm < meets_mm + 0.5 * kStep_mm) continue;
    place.along_mm += own_mm - meets_mm;
    canal.places.push_back(place);
  }
  canal.schneider_rad = schneider_rad(canal.places);
  return canal;
}

class BuiltInShell final : public ToothShell {
 public:
  explicit BuiltInShell(const BuiltInTooth& tooth) : tooth_(tooth) {}

  Box box() const override {
    constexpr double kFar = std::numeric_limits<double>::max();
    Box box{glm::dvec3(kFar), glm::dvec3(-kFar)};
    for (const glm::dvec3& p : tooth_.placed.shape.surfacePoints_mm()) {
      const glm::dvec3 p_P = tooth_.frame.inP(p);
      box.low_P_mm = glm::min(box.low_P_mm, p_P);
      box.high_P_mm = glm::max(box.high_P_mm, p_P);
    }
    return box;
  }
  double outer_mm(const glm::dvec3& p_P_mm) const override {
    return tooth_.placed.shape.outer_mm(tooth_.frame.local(p_P_mm));
  }
  double core_mm(const glm::dvec3& p_P_mm, double outer_mm) const override {
    return tooth_.placed.shape.core_mm(tooth_.frame.local(p_P_mm), outer_mm);
  }

 private:
  BuiltInTooth tooth_;
};

}  // namespace

std::vector<int> builtInTeeth(const JawParameters& jaw) {
  std::vector<int> teeth;
  for (int position = 4; position <= 8; ++position) teeth.push_back((jaw.right_side ? 40 : 30) + position);
  return teeth;
}

BuiltInTooth builtInTooth(const JawParameters& jaw, int fdi) {
  const std::vector<int> teeth = builtInTeeth(jaw);
  if (!std::ranges::count(teeth, fdi)) {
    std::ostringstream line;
    line << "synthetic jaw: it has no tooth " << fdi << "; it has " << teeth.front() << " to " << teeth.back();
    throw LoadError(line.str());
  }
  const DentalArch arch;
  const int position = fdi % 10;
  const PlacedTooth placed = position == 8
                                 ? impactedThirdMolar(arch, eruptedTooth(arch, 7), jaw.winter_angle_deg, jaw.depth_mm)
                                 : eruptedTooth(arch, position);
  // A right jaw is the mirror image of a left one.
  BuiltInTooth tooth{fdi, placed, {placed.cervix_J_mm, placed.axes_J}};
  if (jaw.right_side) {
    const glm::dvec3 mirror(-1.0, 1.0, 1.0);
    tooth.frame.cervix_P_mm *= mirror;
    for (int axis = 0; axis < 3; ++axis) tooth.frame.axes_P[axis] *= mirror;
  }
  return tooth;
}

ToothCanals canalsOf(const BuiltInTooth& tooth) {
  const PulpPlan& plan = planOf(tooth.placed.position);
  ToothCanals all;
  all.fdi = tooth.fdi;
  all.frame = tooth.frame;
  all.chamber = {plan.outline_mm, plan.round_mm, plan.roof_mm, plan.floor_mm, {}};
  for (const CuspParameters& cusp : lowerToothParameters(tooth.placed.position).cusps) {
    const glm::dvec3 from(0.45 * cusp.tip_mm, plan.roof_mm - 0.3), to(0.6 * cusp.tip_mm, 0.4 * cusp.height_mm - 0.3);
    all.chamber.horns.push_back({from, to, plan.horn_mm, 0.4 * plan.horn_mm});
  }
  const std::vector<glm::dvec3> surface = tooth.placed.shape.surfacePoints_mm();
  for (const CanalPlan& one : plan.canals) {
    const std::size_t before = all.canals.size() - (one.joins_mm > 0.0 ? 1 : 0);
    all.canals.push_back(one.joins_mm > 0.0 ? joiningCanal(tooth, one, all.canals[before], before, plan.floor_mm)
                                            : canalOf(tooth, one, surface, plan.floor_mm));
  }
  return all;
}

std::vector<RoundCanal> roundCanals(const BuiltInTooth& tooth) {
  const PulpPlan& plan = planOf(tooth.placed.position);
  const ToothParameters& form = lowerToothParameters(tooth.placed.position);
  const std::vector<glm::dvec3> surface = tooth.placed.shape.surfacePoints_mm();
  std::vector<RoundCanal> canals;
  for (const CanalPlan& one : plan.canals) {
    if (one.joins_mm > 0.0) continue;
    const glm::dvec3 apex = apexOf(surface, form.roots[one.root]);
    RootCanal line = courseBetween({one.orifice_mm, plan.floor_mm}, foramenOf(tooth.placed.shape, apex, one), one).line;
    line.orifice_radius_mm = std::sqrt(one.narrow_mm * one.wide_mm);
    line.apex_radius_mm = kConstrictionRadius_mm;
    canals.push_back({one.name, line});
  }
  return canals;
}

std::unique_ptr<ToothSampler> fineBuiltInTooth(const BuiltInTooth& tooth, const CtVolume& ct, double spacing_mm) {
  return fineTooth(std::make_unique<BuiltInShell>(tooth), canalsOf(tooth), ct, spacing_mm);
}

}  // namespace assets
