#include "assets/synthetic/practice_block.h"

#include <algorithm>
#include <cmath>

#include "assets/tissue.h"

namespace assets {
namespace {

constexpr double kShell_mm = 0.4;  ///< soft, around the ball
constexpr double kGrooveLength_mm = 6.0, kGrooveDepth_mm = 2.0, kGrooveRadius_mm = 1.0;
constexpr glm::dvec2 kPlate_mm{5.0, 4.0};  ///< half edges of what is thinned
constexpr double kBallGutter_mm = 4.5;     ///< radius of what is to go around the ball
constexpr double kMargin_mm = 2.0;         ///< of air around a block

/// Axes of the block in P, in columns: towards the eye that looks at a lower right third molar, leaning 24 degrees off
/// the line of sight, so that depth is seen.
glm::dmat3 axes() {
  const glm::dvec3 eye = glm::normalize(glm::dvec3(-0.11, -0.87, 0.46)), up(0.0, 0.0, 1.0);
  constexpr double kLeans = 0.45;
  const glm::dvec3 aside = glm::normalize(up - glm::dot(up, eye) * eye);
  const glm::dvec3 out = glm::normalize(eye + kLeans * aside);
  const glm::dvec3 along = glm::normalize(glm::cross(up, out));
  return {along, glm::cross(out, along), out};
}

double boxDistance(const glm::dvec3& p, const glm::dvec3& low, const glm::dvec3& high) {
  const glm::dvec3 q = glm::max(low - p, p - high);
  const double inside = std::min(0.0, std::max({q.x, q.y, q.z}));
  return inside + glm::length(glm::max(q, glm::dvec3(0.0)));
}

struct Edges {
  glm::dvec3 low, high;
};
Edges edgesOf(PracticeTask task) {
  if (task == PracticeTask::plate) return {{-9.0, -7.0, -8.0}, {9.0, 7.0, 0.0}};
  if (task == PracticeTask::groove) return {{-9.0, -6.0, -7.0}, {9.0, 6.0, 0.0}};
  return {{-9.0, -8.0, -10.0}, {9.0, 8.0, 0.0}};
}

double toBall(const glm::dvec3& q) { return glm::distance(q, glm::dvec3(0.0, 0.0, kBallMiddle_mm)) - kBallRadius_mm; }

/// Bone without ball, negative inside.
double toBone(PracticeTask task, const glm::dvec3& q) {
  const Edges edges = edgesOf(task);
  double mm = boxDistance(q, edges.low, edges.high);
  if (task == PracticeTask::plate) mm = std::max(mm, -boxDistance(q, {-6.0, -5.0, -6.0}, {6.0, 5.0, kPlateBack_mm}));
  if (task == PracticeTask::ball) mm = std::max(mm, kShell_mm - toBall(q));
  return mm;
}

double targetInBlock(PracticeTask task, const glm::dvec3& q) {
  if (task == PracticeTask::plate)
    return boxDistance(q, {-kPlate_mm.x, -kPlate_mm.y, kPlateBack_mm + kPlateLeft_mm}, {kPlate_mm.x, kPlate_mm.y, 1e3});
  if (task == PracticeTask::groove) {
    const double beyond = std::max(0.0, std::abs(q.x) - (0.5 * kGrooveLength_mm - kGrooveRadius_mm));
    const double below = std::max(0.0, kGrooveRadius_mm - kGrooveDepth_mm - q.z);
    return std::sqrt(beyond * beyond + q.y * q.y + below * below) - kGrooveRadius_mm;
  }
  return std::max(std::hypot(q.x, q.y) - kBallGutter_mm, kBallMiddle_mm - q.z);
}

/// Rows of a bur over a region, level by level; `lowest(x, y)`: of its centre, none below 1e3: not there.
template <class Half, class Lowest>
void rows(PlannedCut& cut, double top_mm, double bottom_mm, double half_y_mm, const Half& half_x_mm,
          const Lowest& lowest) {
  const double R = cut.bur_radius_mm, step_mm = 0.6 * R, level_mm = 0.5;
  const int levels = std::max(1, static_cast<int>(std::ceil((top_mm - bottom_mm) / level_mm)));
  const int row_count = std::max(1, static_cast<int>(std::ceil(2.0 * half_y_mm / step_mm)));
  constexpr int kFinishing = 6;  // along the bottom, while the bone gives way
  bool forth = true;
  for (int level = 1; level <= levels + kFinishing; ++level) {
    const double z = std::max(bottom_mm, top_mm - level * (top_mm - bottom_mm) / levels);
    for (int row = 0; row <= row_count; ++row) {
      const double y = -half_y_mm + 2.0 * half_y_mm * row / row_count, half = half_x_mm(y);
      if (!(half > 0.0)) continue;
      std::vector<glm::dvec3> stroke;
      const int places = std::max(1, static_cast<int>(std::ceil(2.0 * half / 0.4)));
      for (int n = 0; n <= places; ++n) {
        const double x = (forth ? 1.0 : -1.0) * (-half + 2.0 * half * n / places);
        stroke.push_back(fromBlock({x, y, std::max(z, lowest(x, y))}));
      }
      forth = !forth;
      cut.strokes_P_mm.push_back(std::move(stroke));
    }
  }
}

}  // namespace

std::optional<PracticeTask> practiceTaskOf(std::string_view key) {
  const auto found = std::ranges::find(kPracticeTasks, key, &PracticeText::key);
  if (found == kPracticeTasks.end()) return {};
  return static_cast<PracticeTask>(found - kPracticeTasks.begin());
}

glm::dvec3 inBlock(const glm::dvec3& p_P_mm) {
  static const glm::dmat3 kInto = glm::transpose(axes());
  return kInto * p_P_mm;
}
glm::dvec3 fromBlock(const glm::dvec3& q_mm) {
  static const glm::dmat3 kOutOf = axes();
  return kOutOf * q_mm;
}

double fromTarget_mm(PracticeTask task, const glm::dvec3& p_P_mm) { return targetInBlock(task, inBlock(p_P_mm)); }

Patient practiceBlock(PracticeTask task, double spacing_mm) {
  const Edges edges = edgesOf(task);
  glm::dvec3 low(1e9), high(-1e9);
  for (int corner = 0; corner < 8; ++corner) {
    const glm::dvec3 p = fromBlock(glm::mix(edges.low, edges.high, glm::dvec3(cornerOffset(corner))));
    low = glm::min(low, p), high = glm::max(high, p);
  }
  Patient patient;
  patient.title = textOf(task).title;
  CtVolume& ct = patient.ct;
  ct.grid.spacing_mm = spacing_mm;
  ct.grid.origin_P_mm = low - kMargin_mm;
  ct.grid.size = glm::ivec3(glm::ceil((high - low + 2.0 * kMargin_mm) / spacing_mm)) + 1;
  const std::size_t count = ct.grid.voxelCount();
  ct.hounsfield.resize(count), ct.solid.resize(count), ct.label.resize(count), ct.tooth.assign(count, 0);
  forVoxels(ct.grid, [&](glm::ivec3 ijk, std::size_t v) {
    const glm::dvec3 q = inBlock(ct.grid.centre_P_mm(ijk));
    const double bone = toBone(task, q), ball = task == PracticeTask::ball ? toBall(q) : 1e3;
    const bool is_shell = task == PracticeTask::ball && ball > 0.0 && ball < kShell_mm;
    const Tissue tissue = ball <= 0.5 * spacing_mm   ? Tissue::enamel
                          : is_shell                 ? Tissue::ligament
                          : bone <= 0.5 * spacing_mm ? Tissue::cortical
                                                     : Tissue::unlabelled;
    const double share = std::clamp(0.5 - std::min(bone, ball) / spacing_mm, 0.0, 1.0);
    const TissueProperties& about = kTissues[static_cast<std::size_t>(tissue)];
    constexpr double kAir_HU = -1000.0;
    ct.label[v] = static_cast<std::uint8_t>(tissue);
    ct.solid[v] = static_cast<std::uint8_t>(std::lround(255.0 * share));
    ct.hounsfield[v] =
        static_cast<std::int16_t>(is_shell ? about.hounsfield : glm::mix(kAir_HU, about.hounsfield, share));
  });
  return patient;
}

PlannedCut practiceCut(PracticeTask task, double bur_radius_mm) {
  const double R = bur_radius_mm;
  PlannedCut cut;
  cut.bur_radius_mm = R;
  cut.outward_P = fromBlock({0.0, 0.0, 1.0});
  cut.lateral_P = fromBlock({0.0, 1.0, 0.0});
  const auto nowhere = [](double, double) { return -1e3; };
  if (task == PracticeTask::plate) {
    const double bottom = kPlateBack_mm + kPlateLeft_mm + R;
    rows(
        cut, R, bottom, std::max(0.0, kPlate_mm.y - R), [&](double) { return std::max(0.1, kPlate_mm.x - R); },
        nowhere);
  } else if (task == PracticeTask::groove) {
    rows(
        cut, R, R - kGrooveDepth_mm, 0.0, [&](double) { return std::max(0.1, 0.5 * kGrooveLength_mm - R); }, nowhere);
  } else {
    constexpr double kOffBall_mm = 0.2;
    const double reach = std::max(0.1, kBallGutter_mm - R), clear = kBallRadius_mm + kOffBall_mm + R;
    rows(
        cut, R, kBallMiddle_mm + R, reach, [&](double y) { return std::sqrt(std::max(0.0, reach * reach - y * y)); },
        [&](double x, double y) {
          const double left = clear * clear - x * x - y * y;
          return left > 0.0 ? kBallMiddle_mm + std::sqrt(left) : -1e3;
        });
  }
  return cut;
}

}  // namespace assets
