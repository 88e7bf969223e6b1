#include "app/case/dentoform_row.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>

#include <fmt/core.h>

#include "app/case/treated_tooth.h"
#include "app/text/usage_error.h"
#include "assets/import/root_course.h"
#include "assets/import/tooth_site.h"
#include "assets/scenery/gingiva_surface.h"
#include "assets/synthetic/built_in_teeth.h"
#include "assets/synthetic/front_row.h"
#include "assets/tooth.h"
#include "assets/trilinear.h"

namespace app {
namespace {

constexpr double kFinestRow_mm = 0.08;                       ///< of the row's voxels: those of a preparation
constexpr double kRowAlong_mm = 7.5, kRowAcross_mm = 3.0;    ///< of the row beside the tooth
constexpr double kUnderRoots_mm = 2.5, kOverCrown_mm = 1.5;  ///< of roots and crown
constexpr double kTouch_mm = 0.05, kFarthestMove_mm = 4.0;   ///< between neighbours
constexpr double kFilledBelow_mm = -1.6;                     ///< over the neck: bone fills a socket from there down
constexpr auto kOtherTeeth = static_cast<std::uint8_t>(assets::Tissue::other_teeth);
constexpr auto kFilledWith = static_cast<std::uint8_t>(assets::Tissue::trabecular);

/// The tooth of the lower row whose place it takes.
int placeOf(int fdi) { return (assets::isRight(fdi) ? 40 : 30) + assets::positionOf(fdi); }

/// 1 and 2, 3 and 4.
int otherSideOf(int quadrant) { return quadrant % 2 == 1 ? quadrant + 1 : quadrant - 1; }

/// The farthest that teeth reach along the row, by heights and places across it.
class RowReaches {
 public:
  static constexpr double kNone = -1e9;
  RowReaches() : mm_(kHigh * kWide, kNone) {}

  void add(double across_mm, double height_mm, double reach_mm) {
    const int i = static_cast<int>(std::floor(across_mm / kCell_mm)) + kWide / 2;
    const int k = static_cast<int>(std::floor(height_mm / kCell_mm)) + kHigh / 2;
    if (i < 0 || k < 0 || i >= kWide || k >= kHigh) return;
    double& cell = mm_[static_cast<std::size_t>(k * kWide + i)];
    cell = std::max(cell, reach_mm);
  }
  /// How far the other has to move away, whose reach is towards this one.
  double overlap_mm(const RowReaches& other) const {
    double most_mm = kNone;
    for (std::size_t n = 0; n < mm_.size(); ++n)
      if (mm_[n] > kNone && other.mm_[n] > kNone) most_mm = std::max(most_mm, mm_[n] + other.mm_[n]);
    return most_mm;
  }

 private:
  static constexpr double kCell_mm = 0.25;
  static constexpr int kWide = 80, kHigh = 160;
  std::vector<double> mm_;
};

/// The built-in jaw around the place of one of its teeth, that tooth left out.
class BuiltInRow {
 public:
  BuiltInRow(const assets::CtVolume& ct, const assets::ToothFrame& frame, int place)
      : ct_(ct), frame_(frame), place_(place) {}

  /// Of the teeth beside, towards the place; `side`: 1 mesial, -1 distal.
  RowReaches reaches(int side) const {
    constexpr double kNear_mm = 12.0;
    RowReaches reaches;
    assets::forVoxels(ct_.grid, [&](glm::ivec3 ijk, std::size_t v) {
      if (ct_.tooth[v] == 0 || ct_.tooth[v] == place_ || ct_.solid[v] < assets::kHalfSolid) return;
      const glm::dvec3 p = frame_.local(ct_.grid.centre_P_mm(ijk));
      if (side * p.x <= 0.0 || side * p.x > kNear_mm) return;
      reaches.add(p.y, p.z, 0.5 * ct_.grid.spacing_mm - side * p.x);
    });
    return reaches;
  }
  double solid(const glm::dvec3& p_P) const {
    return assets::trilinearAt(ct_.grid, p_P, [&](glm::ivec3 ijk) {
      if (!ct_.grid.contains(ijk)) return 0.0;
      const std::size_t v = ct_.grid.index(ijk);
      return isFilled(v, ijk) ? 1.0 : ct_.tooth[v] == place_ ? 0.0 : ct_.solid[v] / 255.0;
    });
  }
  struct Matter {
    std::uint8_t label = 0;
    int tooth = 0;
  };
  Matter matter(const glm::dvec3& p_P) const {
    const glm::ivec3 ijk(glm::floor(ct_.grid.indexFromPoint(p_P) + 0.5));
    if (!ct_.grid.contains(ijk)) return {};
    const std::size_t v = ct_.grid.index(ijk);
    if (isFilled(v, ijk)) return {kFilledWith, 0};
    if (ct_.tooth[v] == place_) return {};
    if (ct_.tooth[v] != 0) return {kOtherTeeth, ct_.tooth[v]};
    return {ct_.label[v], 0};
  }

 private:
  /// The socket of the tooth that is left out, ligaments and the canal: a dentoform is solid there.
  bool isFilled(std::size_t v, glm::ivec3 ijk) const {
    const assets::Tissue tissue{ct_.label[v]};
    if (tissue == assets::Tissue::mandibular_canal) return true;
    if (ct_.tooth[v] != place_ && tissue != assets::Tissue::ligament) return false;
    return frame_.local(ct_.grid.centre_P_mm(ijk)).z < kFilledBelow_mm;
  }

  const assets::CtVolume& ct_;
  const assets::ToothFrame& frame_;
  int place_;
};

/// Along the row from the tooth's frame to that of the place: the teeth beside are moved, what lies between is drawn
/// out.
struct RowShift {
  double mesial_mm = 0.0, distal_mm = 0.0;  ///< away from the tooth

  double at(double x_mm) const {
    const double shift_mm = x_mm > 0.0 ? mesial_mm : distal_mm;
    const double all_mm = std::max(1.5, shift_mm + 0.5), away_mm = std::abs(x_mm);
    const double place_mm = away_mm > all_mm ? away_mm - shift_mm : away_mm * (all_mm - shift_mm) / all_mm;
    return x_mm > 0.0 ? place_mm : -place_mm;
  }
};

/// A box around the tooth, drawn out along the row.
assets::VolumeGrid dentoformGrid(const assets::CtVolume& tooth, const assets::ToothFrame& frame, bool is_upper) {
  glm::dvec3 low(std::numeric_limits<double>::max()), high(-std::numeric_limits<double>::max());
  assets::forVoxels(tooth.grid, [&](glm::ivec3 ijk, std::size_t v) {
    if (tooth.tooth[v] == 0) return;
    const glm::dvec3 p = tooth.grid.centre_P_mm(ijk);
    low = glm::min(low, p), high = glm::max(high, p);
  });
  const glm::dvec3 mesial = glm::abs(frame.axes_P[0]);
  glm::dvec3 beside(kRowAcross_mm, kRowAcross_mm, 0.0);
  beside[mesial.x > mesial.y ? 0 : 1] = kRowAlong_mm;
  low -= beside + glm::dvec3(0.0, 0.0, is_upper ? kOverCrown_mm : kUnderRoots_mm);
  high += beside + glm::dvec3(0.0, 0.0, is_upper ? kUnderRoots_mm : kOverCrown_mm);
  // On the tooth's own voxels where they are no finer than needed.
  const double spacing_mm = std::max(tooth.grid.spacing_mm, kFinestRow_mm);
  if (spacing_mm == tooth.grid.spacing_mm)
    low = tooth.grid.centre_P_mm(glm::ivec3(glm::floor(tooth.grid.indexFromPoint(low))));
  return {glm::ivec3(glm::ceil((high - low) / spacing_mm)) + 1, spacing_mm, low};
}

/// Of the tooth's own voxels at a place between them.
double shareAt(const assets::CtVolume& tooth, const glm::dvec3& p_P) {
  return assets::trilinearAt(tooth.grid, p_P, [&](glm::ivec3 ijk) {
    return tooth.grid.contains(ijk) ? tooth.solid[tooth.grid.index(ijk)] / 255.0 : 0.0;
  });
}

RowShift rowShift(const assets::CtVolume& tooth, const assets::ToothFrame& frame, const BuiltInRow& row,
                  const std::string& name) {
  std::array<RowReaches, 2> own;
  assets::forVoxels(tooth.grid, [&](glm::ivec3 ijk, std::size_t v) {
    if (tooth.tooth[v] == 0 || tooth.solid[v] < assets::kHalfSolid) return;
    const glm::dvec3 p = frame.local(tooth.grid.centre_P_mm(ijk));
    own[p.x > 0.0 ? 0 : 1].add(p.y, p.z, std::abs(p.x) + 0.5 * tooth.grid.spacing_mm);
  });
  const auto away_mm = [&](std::size_t n, int side) {
    const double overlap_mm = own[n].overlap_mm(row.reaches(side));
    if (overlap_mm <= RowReaches::kNone) return 0.0;  // nothing stands there
    const double mm = overlap_mm + kTouch_mm;
    if (std::abs(mm) > kFarthestMove_mm)
      throw UsageError(
          fmt::format("{}: it is {:.1f} mm {} than the tooth of the row whose place it takes; check the "
                      "spacing in its header, or give its number by --tooth-number",
                      name, std::abs(mm), mm > 0.0 ? "wider on one side" : "narrower on one side"));
    return mm;
  };
  return {away_mm(0, 1), away_mm(1, -1)};
}

}  // namespace

assets::JawParameters dentoformJaw(int fdi) {
  assets::JawParameters jaw;
  jaw.right_side = assets::isRight(fdi);
  // A third molar that stands upright in the row.
  jaw.winter_angle_deg = 0.0;
  jaw.depth_mm = 0.0;
  return jaw;
}

bool isInDentoform(int fdi) { return assets::isToothNumber(fdi) && !assets::isPrimaryTooth(fdi); }

bool isInFront(int fdi) { return assets::positionOf(fdi) <= 3; }

DentoformTooth dentoformTooth(const assets::ToothVolume& tooth, const assets::CtVolume& jaw, int fdi,
                              const std::string& name) {
  DentoformTooth made;
  const assets::ToothFrame frame = assets::toothFrame(tooth.ct, fdi);
  const assets::ToothFrame place = isInFront(fdi) ? assets::frontToothFrame(placeOf(fdi))
                                                  : assets::builtInTooth(dentoformJaw(fdi), placeOf(fdi)).frame;
  const BuiltInRow row(jaw, place, placeOf(fdi));
  const RowShift shift = rowShift(tooth.ct, frame, row, name);
  made.remarks.push_back(
      fmt::format("set into the built-in row as {} ({}); its neighbours were moved by {:+.1f} mm mesially and {:+.1f} "
                  "distally; its sides are taken from the file's axes (x to the left, y to the back)",
                  assets::toothName(fdi), fdi, shift.mesial_mm, shift.distal_mm));

  assets::Patient& patient = made.patient;
  patient.title = fmt::format("single {} in a dentoform row", assets::toothName(fdi));
  assets::CtVolume& ct = patient.ct;
  ct.grid = dentoformGrid(tooth.ct, frame, assets::isUpper(fdi));
  const std::size_t count = ct.grid.voxelCount();
  ct.hounsfield.resize(count), ct.solid.resize(count), ct.label.resize(count), ct.tooth.resize(count);
  const int quadrant = 10 * assets::quadrantOf(fdi);
  const auto byte = [](double share) { return static_cast<std::uint8_t>(255.0 * std::clamp(share, 0.0, 1.0) + 0.5); };
  assets::forVoxels(ct.grid, [&](glm::ivec3 ijk, std::size_t v) {
    const glm::dvec3 p_P = ct.grid.centre_P_mm(ijk);
    glm::dvec3 p = frame.local(p_P);
    p.x = shift.at(p.x);
    const glm::dvec3 there_P = place.inP(p);
    const BuiltInRow::Matter around = row.matter(there_P);
    ct.solid[v] = byte(row.solid(there_P));
    ct.label[v] = around.label;
    if (around.tooth != 0) {
      // Over the midline stands the other side's.
      const bool is_same_side = assets::isRight(around.tooth) == assets::isRight(fdi);
      const int beside = is_same_side ? quadrant : 10 * otherSideOf(assets::quadrantOf(fdi));
      ct.tooth[v] = static_cast<std::uint8_t>(beside + assets::positionOf(around.tooth));
    }
    // The tooth itself, which bone surrounds without a gap.
    const glm::ivec3 at(glm::floor(tooth.ct.grid.indexFromPoint(p_P) + 0.5));
    if (tooth.ct.grid.contains(at)) {
      const std::size_t t = tooth.ct.grid.index(at);
      const std::uint8_t own = byte(shareAt(tooth.ct, p_P));
      if (tooth.ct.label[t] != 0 && (own >= ct.solid[v] || own >= assets::kHalfSolid ||
                                     assets::Tissue{tooth.ct.label[t]} == assets::Tissue::pulp)) {
        ct.solid[v] = own, ct.label[v] = tooth.ct.label[t];
        ct.tooth[v] = static_cast<std::uint8_t>(fdi);
      } else {
        ct.solid[v] = std::max(ct.solid[v], own);
      }
    }
    ct.hounsfield[v] = greyOf(ct.solid[v], ct.label[v]);
  });
  patient.site = assets::siteAtTooth(ct, fdi);
  patient.jaw_P_mm = ct.grid.centre_P_mm(ct.grid.size / 2);
  patient.gingiva = assets::gingivaSurface(ct, std::nullopt);
  return made;
}

}  // namespace app
