#include "app/session/measures/hand_work.h"

#include <algorithm>
#include <cmath>
#include <numbers>

#include "app/session/measures/smoothness.h"

namespace app {
namespace {

constexpr double kIdle_s = 0.3;    ///< a turning bur off the bone for longer rests
constexpr double kWindow_s = 1.0;  ///< of tremor
constexpr double kSteep_rad = std::numbers::pi / 3.0;
constexpr double kCurved = 0.9;  ///< chord over length below which a stroke is curved (our default)

std::optional<double> ratio(double a, double b) { return b > 0.0 ? std::optional(a / b) : std::nullopt; }

constexpr std::string_view kNoStroke = "no stroke in bone was found";
constexpr std::string_view kNoBone = "the bur was not drilling in bone";
constexpr std::string_view kNoTurn = "the drill was not on";

}  // namespace

HandWork::HandWork() : strokes_([this](const Stroke& stroke) { add(stroke); }) {}

void HandWork::addTimes(const WorkSample& sample) {
  total_s_ += sample.dt_s;
  if (sample.turns) on_s_ += sample.dt_s;
  if (sample.touches) contact_s_ += sample.dt_s;
  if (sample.drills()) drilling_s_ += sample.dt_s;
  if (sample.drills() && !sample.irrigated) dry_s_ += sample.dt_s;
  // The whole of a rest, once it is one.
  const double before_s = off_bone_s_;
  off_bone_s_ = sample.turns && !sample.touches ? off_bone_s_ + sample.dt_s : 0.0;
  if (off_bone_s_ > kIdle_s) idle_s_ += before_s > kIdle_s ? sample.dt_s : off_bone_s_;
}

void HandWork::addWay(const WorkSample& sample) {
  if (was_valid_ && sample.valid)
    (sample.touches ? contact_mm_ : free_mm_) += glm::distance(sample.bur_P_mm, last_P_mm_);
  was_valid_ = sample.valid;
  last_P_mm_ = sample.bur_P_mm;
}

void HandWork::add(const WorkSample& sample) {
  addTimes(sample);
  addWay(sample);
  removed_mm3_ += sample.removed_mm3;

  if (sample.drills() && sample.normal_P != glm::dvec3(0.0)) {
    const double angle_rad = std::asin(std::min(1.0, std::abs(glm::dot(sample.axis_P, sample.normal_P))));
    angle_sum_ += sample.dt_s * angle_rad;
    angled_s_ += sample.dt_s;
    if (angle_rad > kSteep_rad) steep_s_ += sample.dt_s;
  }

  if (sample.drills() && sample.valid)
    run_speed_mm_per_s_.push_back(glm::length(sample.velocity_P_mm_per_s));
  else
    run_speed_mm_per_s_.clear();
  if (static_cast<double>(run_speed_mm_per_s_.size()) * sample.dt_s >= kWindow_s) {
    if (const auto share = tremorShare(run_speed_mm_per_s_, sample.dt_s)) tremor_.push_back(*share);
    run_speed_mm_per_s_.clear();
  }

  painting_.add(sample);
  strokes_.add(sample);
}

void HandWork::add(const Stroke& stroke) {
  painting_.add(stroke);
  duration_s_.push_back(stroke.duration_s);
  length_mm_.push_back(stroke.length_mm);
  straightness_.push_back(stroke.straightness);
  stroke_speed_mm_per_s_.push_back(stroke.mean_speed_mm_per_s);
  if (stroke.normal_P != glm::dvec3(0.0)) stroke_force_N_.push_back(stroke.mean_normal_force_N);
  if (const auto value = spectralArcLength(stroke.speed_mm_per_s, stroke.dt_s)) smoothness_.push_back(*value);
  if (const auto value = logDimensionlessJerk(stroke.speed_mm_per_s, stroke.dt_s)) jerk_.push_back(*value);
}

std::vector<MeasureValue> HandWork::values() const {
  const PaintingParts painting = painting_.parts();
  const auto strokes = static_cast<double>(duration_s_.size());
  const auto stroke_rate = strokes > 0.0 ? ratio(strokes, drilling_s_) : std::nullopt;
  std::optional<double> curved;
  if (!straightness_.empty())
    curved = static_cast<double>(std::ranges::count_if(straightness_, [](double s) { return s < kCurved; })) /
             static_cast<double>(straightness_.size());
  const auto angle_deg = [](std::optional<double> rad) {
    return rad ? std::optional(*rad * 180.0 / std::numbers::pi) : std::nullopt;
  };
  return {
      {"M1.total", "length of the work", "s", total_s_, {}, {}},
      {"M1.on", "time with the drill on", "s", on_s_, {}, {}},
      {"M1.contact", "time with the head in bone or tooth", "s", contact_s_, {}, {}},
      {"M1.drilling", "time drilling in bone or tooth", "s", drilling_s_, {}, {}},
      {"M1.idle", "time with the drill on off the bone, each longer than 0.3 s", "s", idle_s_, {}, {}},
      {"M1.on_ratio", "share of the time with the drill on", "", ratio(on_s_, total_s_), "no time has passed", {}},
      {"M2.path", "way of the bur's centre", "mm", free_mm_ + contact_mm_, {}, {}},
      {"M2.contact", "way of the bur's centre in bone or tooth", "mm", contact_mm_, {}, {}},
      {"M2.free", "way of the bur's centre outside", "mm", free_mm_, {}, {}},
      {"M3.rate", "volume removed for each second with the drill on", "mm3/s", ratio(removed_mm3_, on_s_), kNoTurn, {}},
      {"M3.per_way",
       "volume removed for each millimetre in bone",
       "mm3/mm",
       ratio(removed_mm3_, contact_mm_),
       kNoBone,
       {}},
      {"M4.LDLJ", "smoothness of strokes, minus log of dimensionless jerk, median", "", medianOf(jerk_), kNoStroke, {}},
      {"M5.SPARC", "smoothness of strokes, spectral arc length, median", "", medianOf(smoothness_), kNoStroke, {}},
      {"M6.tremor",
       "power of speed from 8 to 12 Hz over that below 20 Hz, median of seconds",
       "",
       medianOf(tremor_),
       "no whole second of drilling in bone",
       {}},
      {"M7.rate", "strokes for each second of drilling", "1/s", stroke_rate, kNoStroke, {}},
      {"M7.duration", "duration of a stroke, median", "s", medianOf(duration_s_), kNoStroke, {}},
      {"M7.length", "length of a stroke, median", "mm", medianOf(length_mm_), kNoStroke, {}},
      {"M7.speed", "mean speed of a stroke, median", "mm/s", medianOf(stroke_speed_mm_per_s_), kNoStroke, {}},
      {"M7.force",
       "mean force of a stroke along the surface's normal, median",
       "N",
       medianOf(stroke_force_N_),
       kNoStroke,
       {}},
      {"M7.straightness", "chord over length of a stroke, median", "", medianOf(straightness_), kNoStroke, {}},
      {"M7.curved", "share of strokes with chord over length below 0.9", "", curved, kNoStroke, {}},
      {"M8.angle",
       "angle of the bur's axis to the surface, mean",
       "deg",
       angle_deg(ratio(angle_sum_, angled_s_)),
       kNoBone,
       {}},
      {"M8.steep", "share of drilling with that angle above 60°", "", ratio(steep_s_, angled_s_), kNoBone, {}},
      {"PI", "painting index", "", painting.index(), "too few strokes in bone", {}},
      {"PI.sweep", "share of drilling along the surface with 3 mm/s or more", "", painting.sweep, kNoBone, {}},
      {"PI.shallow", "share of strokes no deeper than a quarter of the radius", "", painting.shallow, kNoStroke, {}},
      {"PI.straight", "chord over length of strokes longer than 1 mm, median", "", painting.straight, kNoStroke, {}},
      {"PI.overlap",
       "share of strokes beside the one before by a quarter to one radius",
       "",
       painting.overlap,
       "fewer than two strokes",
       {}},
      {"PI.light", "evenness of the force into the bone", "", painting.light, kNoBone, {}},
      {"PI.plunge", "way into the bone over way along it", "", painting.plunge_ratio, kNoBone, {}},
      {"S10.dry", "time drilling in bone without irrigation", "s", dry_s_, {}, {}},
  };
}

}  // namespace app
