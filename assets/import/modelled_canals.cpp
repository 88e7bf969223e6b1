#include "assets/import/modelled_canals.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>
#include <string>

#include "assets/import/root_course.h"
#include "assets/load_error.h"
#include "assets/scan/label_distance.h"
#include "assets/tooth.h"

namespace assets {
namespace {

constexpr double kChamber_mm = 1.57, kStep_mm = 0.2;
constexpr double kConstrictionRadius_mm = 0.14, kForamenRadius_mm = 0.2, kConstriction_mm = 0.9;
constexpr double kForamenUp_mm = 0.6, kApical_mm = 2.0, kLateral_mm = 1.5;
constexpr double kDentine_mm = 0.5, kThinnest_mm = 0.1;
constexpr double kOverFurcation_mm = 0.8;
constexpr double kAllPulp_mm = -100.0;  ///< floor of a chamber that is as labelled
constexpr double kApart = 0.42;         ///< of a root's half width: two canals of one root
constexpr double kToMiddle = 0.85;      ///< an orifice lies nearer to the chamber's middle than its root

/// Which canals a root has.
struct RootCanals {
  std::vector<std::string> names;  ///< from the cheek
  double narrow_mm, wide_mm;
};

/// `roots` from mesial to distal.
std::vector<RootCanals> canalsOfRoots(int fdi, const std::vector<RootCourse>& roots) {
  const int position = positionOf(fdi);
  const bool is_molar = position >= (isPrimaryTooth(fdi) ? 4 : 6);
  std::vector<RootCanals> all;
  for (std::size_t n = 0; n < roots.size(); ++n) all.push_back({{"root " + std::to_string(n + 1)}, 0.32, 0.5});
  if (roots.size() == 1) {
    all[0] = {{"single"}, position <= 3 ? 0.30 : 0.38, position <= 3 ? 0.45 : 0.70};
    if (isUpper(fdi) && position == 4) all[0] = {{"buccal", "palatal"}, 0.30, 0.34};
    if (is_molar && !isUpper(fdi)) all[0] = {{"buccal", "lingual"}, 0.34, 0.40};
    return all;
  }
  const auto across = [&](std::size_t n) {
    return roots[n].slices[(roots[n].own + roots[n].slices.size()) / 2].middle_mm.y;
  };
  if (is_molar && !isUpper(fdi) && roots.size() == 2)
    return {{{"mesiobuccal", "mesiolingual"}, 0.30, 0.34}, {{"distal"}, 0.38, 0.70}};
  if (is_molar && !isUpper(fdi) && roots.size() == 3) {
    const bool first_is_buccal = across(0) > across(1);
    return {{{first_is_buccal ? "mesiobuccal" : "mesiolingual"}, 0.30, 0.34},
            {{first_is_buccal ? "mesiolingual" : "mesiobuccal"}, 0.30, 0.34},
            {{"distal"}, 0.38, 0.60}};
  }
  if (isUpper(fdi) && is_molar && roots.size() == 3) {
    // The palatal root lies towards the tongue; of the others the mesial one has two canals in most first molars.
    std::size_t palatal = 0;
    for (std::size_t n = 1; n < 3; ++n)
      if (across(n) < across(palatal)) palatal = n;
    bool mesial = true;
    for (std::size_t n = 0; n < 3; ++n) {
      if (n == palatal) {
        all[n] = {{"palatal"}, 0.38, 0.42};
        continue;
      }
      all[n] = {{mesial ? "mesiobuccal" : "distobuccal"}, 0.30, 0.34};
      if (mesial && position == 6) all[n].names.push_back("second mesiobuccal");
      mesial = false;
    }
    return all;
  }
  if (roots.size() == 2) {
    const bool first_is_buccal = across(0) > across(1);
    all[0].names = {first_is_buccal ? "buccal" : "palatal"};
    all[1].names = {first_is_buccal ? "palatal" : "buccal"};
  }
  return all;
}

/// The signed distances to a tooth's labels. Below the chamber's floor the canals are the modelled ones: what is
/// labelled there has the steps of the scan's voxels.
class ScannedShell final : public ToothShell {
 public:
  ScannedShell(const CtVolume& ct, int fdi, const ToothFrame& frame, double floor_mm)
      : frame_(frame), floor_mm_(floor_mm) {
    constexpr double kFar = std::numeric_limits<double>::max();
    box_ = {glm::dvec3(kFar), glm::dvec3(-kFar)};
    std::vector<std::uint8_t> own(ct.label.size()), enamel(ct.label.size()), pulp(ct.label.size());
    forVoxels(ct.grid, [&](glm::ivec3 ijk, std::size_t v) {
      if (ct.tooth[v] != fdi) return;
      own[v] = 1;
      enamel[v] = Tissue{ct.label[v]} == Tissue::enamel ? 1 : 0;
      pulp[v] = Tissue{ct.label[v]} == Tissue::pulp ? 1 : 0;
      const glm::dvec3 p_P = ct.grid.centre_P_mm(ijk);
      box_.low_P_mm = glm::min(box_.low_P_mm, p_P);
      box_.high_P_mm = glm::max(box_.high_P_mm, p_P);
    });
    const glm::dvec3 middle = 0.5 * (box_.low_P_mm + box_.high_P_mm);
    own_ = structureDistance(ct.grid, own, middle);
    enamel_ = structureDistance(ct.grid, enamel, middle);
    pulp_ = structureDistance(ct.grid, pulp, middle);
  }

  Box box() const override { return box_; }
  double outer_mm(const glm::dvec3& p_P_mm) const override { return own_.near_mm(p_P_mm); }
  double core_mm(const glm::dvec3& p_P_mm, double outer_mm) const override {
    return enamel_.isEmpty() ? outer_mm : std::max(outer_mm, -enamel_.near_mm(p_P_mm));
  }
  double pulp_mm(const glm::dvec3& p_P_mm) const override {
    if (pulp_.isEmpty()) return StructureDistance::kReach_mm;
    return std::max(pulp_.near_mm(p_P_mm), floor_mm_ - frame_.local(p_P_mm).z);
  }

 private:
  ToothFrame frame_;
  double floor_mm_;
  Box box_;
  StructureDistance own_, enamel_, pulp_;
};

/// A centre line through points, evenly in height, without their steps.
std::vector<glm::dvec3> smoothLine(const std::vector<glm::dvec3>& points) {
  constexpr int kPasses = 12;
  std::vector<glm::dvec3> line;
  const double top = points.front().z, bottom = points.back().z;
  const auto count = static_cast<std::size_t>(std::max(4.0, std::ceil((top - bottom) / kStep_mm)));
  std::size_t next = 1;
  for (std::size_t n = 0; n <= count; ++n) {
    const double z = top + (bottom - top) * static_cast<double>(n) / static_cast<double>(count);
    while (next + 1 < points.size() && points[next].z > z) ++next;
    const glm::dvec3 &a = points[next - 1], &b = points[next];
    const double t = a.z == b.z ? 0.0 : std::clamp((z - a.z) / (b.z - a.z), 0.0, 1.0);
    line.emplace_back(glm::mix(glm::dvec2(a), glm::dvec2(b), t), z);
  }
  for (int pass = 0; pass < kPasses; ++pass) {
    std::vector<glm::dvec3> smooth = line;
    for (std::size_t n = 1; n + 1 < line.size(); ++n)
      smooth[n] = 0.25 * line[n - 1] + 0.5 * line[n] + 0.25 * line[n + 1];
    line = std::move(smooth);
  }
  return line;
}

/// From the root's middle a little above its end outwards to distal, to its surface.
glm::dvec3 foramenOf(const ToothShell& shell, const ToothFrame& frame, const glm::dvec3& middle) {
  double mm = 0.0;
  while (mm < kLateral_mm && shell.outer_mm(frame.inP(middle - glm::dvec3(mm, 0.0, 0.0))) < 0.0) mm += 0.02;
  return middle - glm::dvec3(mm, 0.0, 0.0);
}

struct Rule {
  std::string name;
  glm::dvec2 orifice_mm;
  double aside;  ///< of the root's half width towards the cheek
  double narrow_mm, wide_mm;
};

ToothCanal canalThrough(const RootCourse& root, const Rule& rule, const ToothShell& shell, const ToothFrame& frame,
                        double floor_mm) {
  const RootSlice& end = root.slices.back();
  glm::dvec3 last = end.middle_mm;
  const auto at_height = [&](double z) {
    const RootSlice* slice = &root.slices.front();
    for (const RootSlice& one : root.slices)
      if (one.middle_mm.z >= z) slice = &one;
    return *slice;
  };
  const RootSlice above_end = at_height(last.z + kForamenUp_mm);
  const glm::dvec3 foramen =
      foramenOf(shell, frame, above_end.middle_mm + glm::dvec3(0.0, rule.aside * above_end.half_mm.y, 0.0));
  std::vector<glm::dvec3> points{{rule.orifice_mm, floor_mm}};
  for (std::size_t n = root.own; n < root.slices.size(); ++n) {
    const RootSlice& slice = root.slices[n];
    if (slice.middle_mm.z > floor_mm - 1.0 || slice.middle_mm.z < foramen.z + kApical_mm) continue;
    points.push_back(slice.middle_mm + glm::dvec3(0.0, rule.aside * slice.half_mm.y, 0.0));
  }
  points.push_back(foramen);

  ToothCanal canal;
  canal.name = rule.name;
  double along_mm = 0.0;
  const std::vector<glm::dvec3> line = smoothLine(points);
  for (std::size_t n = 0; n < line.size(); ++n) {
    if (n > 0) along_mm += glm::distance(line[n - 1], line[n]);
    canal.places.push_back({frame.inP(line[n]), along_mm, 0.0, 0.0});
  }
  canal.constriction_mm = std::max(0.5 * along_mm, along_mm - kConstriction_mm);
  for (CanalPlace& place : canal.places) {
    const bool is_apical = place.along_mm > canal.constriction_mm;
    const double t = is_apical ? (place.along_mm - canal.constriction_mm) / (along_mm - canal.constriction_mm)
                               : place.along_mm / canal.constriction_mm;
    const double narrow = glm::mix(is_apical ? kConstrictionRadius_mm : rule.narrow_mm,
                                   is_apical ? kForamenRadius_mm : kConstrictionRadius_mm, t);
    const double wide = glm::mix(is_apical ? kConstrictionRadius_mm : rule.wide_mm,
                                 is_apical ? kForamenRadius_mm : kConstrictionRadius_mm, t);
    // Where the root is thin the canal is narrower; its end is as it is.
    const double room_mm = std::max(kThinnest_mm, -shell.outer_mm(place.p_P_mm) - kDentine_mm);
    const bool near_end = place.along_mm > along_mm - 2.0;
    place.narrow_mm = near_end ? narrow : std::min(narrow, room_mm);
    place.wide_mm = near_end ? wide : std::max(place.narrow_mm, std::min(wide, room_mm));
  }
  canal.schneider_rad = schneider_rad(canal.places);
  canal.apex_P_mm = frame.inP(last);
  return canal;
}

/// The middle of the labelled pulp in and under the crown.
std::optional<glm::dvec3> chamberMiddle(const CtVolume& ct, int fdi, const ToothFrame& frame, double lowest_mm) {
  glm::dvec3 sum(0.0);
  double count = 0.0;
  forVoxels(ct.grid, [&](glm::ivec3 ijk, std::size_t v) {
    if (ct.tooth[v] != fdi || Tissue{ct.label[v]} != Tissue::pulp) return;
    const glm::dvec3 p = frame.local(ct.grid.centre_P_mm(ijk));
    if (p.z < lowest_mm) return;
    sum += p;
    count += 1.0;
  });
  if (count == 0.0) return std::nullopt;
  return sum / count;
}

/// The highest point of the tooth near the line up from an orifice.
glm::dvec3 cuspOver(const CtVolume& ct, int fdi, const ToothFrame& frame, const glm::dvec3& orifice_P) {
  constexpr double kAround_mm = 3.0;
  const glm::dvec3 orifice = frame.local(orifice_P);
  glm::dvec3 cusp_P = orifice_P;
  double highest_mm = orifice.z;
  forVoxels(ct.grid, [&](glm::ivec3 ijk, std::size_t v) {
    if (ct.tooth[v] != fdi) return;
    const glm::dvec3 p_P = ct.grid.centre_P_mm(ijk), p = frame.local(p_P);
    if (p.z <= highest_mm || glm::distance(glm::dvec2(p), glm::dvec2(orifice)) > kAround_mm) return;
    highest_mm = p.z;
    cusp_P = p_P;
  });
  return cusp_P;
}

[[noreturn]] void refuse(int fdi, const std::string& why) {
  throw LoadError("tooth " + std::to_string(fdi) + ": " + why);
}

}  // namespace

ToothCanals modelledCanals(const CtVolume& ct, int fdi) {
  const auto own = static_cast<std::uint8_t>(fdi);
  if (std::ranges::find(ct.tooth, own) == ct.tooth.end()) refuse(fdi, "no voxel is labelled as it, see molar inspect");
  bool has_pulp = false;
  for (std::size_t v = 0; v < ct.tooth.size() && !has_pulp; ++v)
    has_pulp = ct.tooth[v] == own && Tissue{ct.label[v]} == Tissue::pulp;
  if (!has_pulp) refuse(fdi, "no pulp is labelled in it, and its canals would begin there");

  ToothCanals all;
  all.fdi = fdi;
  all.is_modelled = true;
  all.frame = toothFrame(ct, fdi);
  const std::vector<RootCourse> roots = rootCourses(ct, fdi, all.frame);
  if (roots.empty()) refuse(fdi, "no root is found below its neck");
  double furcation_mm = -1e3;
  if (roots.size() > 1)
    for (const RootCourse& root : roots) furcation_mm = std::max(furcation_mm, root.slices[root.own].middle_mm.z);
  const auto middle = chamberMiddle(ct, fdi, all.frame, std::max(furcation_mm, -2.5));
  if (!middle) refuse(fdi, "its pulp is not labelled above its roots, where its canals would begin");

  PulpChamber& chamber = all.chamber;
  chamber.floor_mm = std::max(middle->z - 0.5 * kChamber_mm, furcation_mm + kOverFurcation_mm);
  chamber.roof_mm = chamber.floor_mm + kChamber_mm;
  const ScannedShell shell(ct, fdi, all.frame, chamber.floor_mm);
  const std::vector<RootCanals> rules = canalsOfRoots(fdi, roots);
  std::vector<glm::dvec2> orifices;
  for (std::size_t r = 0; r < roots.size(); ++r) {
    const RootSlice& top = roots[r].slices[roots[r].own];
    const std::size_t count = rules[r].names.size();
    for (std::size_t c = 0; c < count; ++c) {
      const double aside = count == 1 ? 0.0 : c == 0 ? kApart : -kApart;
      const glm::dvec2 over = glm::dvec2(top.middle_mm) + glm::dvec2(0.0, aside * top.half_mm.y);
      const glm::dvec2 orifice = glm::mix(glm::dvec2(*middle), over, roots.size() > 1 || count > 1 ? kToMiddle : 0.3);
      orifices.push_back(orifice);
      all.canals.push_back(canalThrough(roots[r],
                                        {rules[r].names[c], orifice, aside, rules[r].narrow_mm, rules[r].wide_mm},
                                        shell, all.frame, chamber.floor_mm));
      all.canals.back().reference_P_mm = cuspOver(ct, fdi, all.frame, all.canals.back().orifice_P_mm());
    }
  }
  chamber.outline_mm = hullOf(std::move(orifices));
  return all;
}

// No canals, and a chamber below all pulp: what is labelled is all of it.
ToothCanals unmodelledTooth(const CtVolume& ct, int fdi) {
  if (std::ranges::find(ct.tooth, static_cast<std::uint8_t>(fdi)) == ct.tooth.end())
    refuse(fdi, "no voxel is labelled as it, see molar inspect");
  ToothCanals all;
  all.fdi = fdi;
  all.frame = toothFrame(ct, fdi);
  all.chamber.floor_mm = all.chamber.roof_mm = kAllPulp_mm;
  return all;
}

std::unique_ptr<ToothSampler> fineScannedTooth(const CtVolume& ct, const ToothCanals& canals, double spacing_mm) {
  return fineTooth(std::make_unique<ScannedShell>(ct, canals.fdi, canals.frame, canals.chamber.floor_mm), canals, ct,
                   spacing_mm);
}

}  // namespace assets
