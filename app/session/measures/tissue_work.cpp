#include "app/session/measures/tissue_work.h"

#include <algorithm>
#include <cmath>

#include "app/session/touch_event.h"
#include "assets/tissue.h"

namespace app {
namespace {

constexpr double kSameSize_mm = 0.25;  ///< of the radius

constexpr auto kTissueWork = std::to_array<MeasureName>({
    {"S8.bone", "time with more than 12.5 N on bone", "s"},
    {"S8.tooth", "time with more than 5.9 N on tooth", "s"},
    {"S9.time", "time with the bur turning on soft tissue", "s"},
    {"S9.events", "times the turning bur came onto soft tissue", ""},
    {"S11.heat", "largest rise of temperature in the bone, indicative", "K"},
    {"M9.changes", "changes of bur", ""},
    {"M9.planned_size", "share of bone cut with the size of bur that the plan is made for", ""},
});

/// The cell of a place, 1 mm wide.
std::uint64_t cellAt(const glm::dvec3& p_P_mm) {
  std::uint64_t key = 0;
  for (int axis = 0; axis < 3; ++axis) {
    constexpr std::int64_t kMiddle = 1 << 20;
    const auto at = static_cast<std::int64_t>(std::floor(std::clamp(p_P_mm[axis], -1e5, 1e5)));
    key = key << 21U | static_cast<std::uint64_t>(at + kMiddle);
  }
  return key;
}

}  // namespace

void HeatedCell::step(double now_s, double dt_s, double power_W, double cooling_W_per_K) {
  const double rate_per_s = cooling_W_per_K / TissueWork::kCell_J_per_K;
  over_K *= std::exp(-rate_per_s * std::max(0.0, now_s - t_s));
  const double steady_K = power_W / cooling_W_per_K;
  over_K = steady_K + (over_K - steady_K) * std::exp(-rate_per_s * dt_s);
  t_s = now_s + dt_s;
}

/// Where the bur presses on the bone.
void TissueWork::heat(const haptics::Tick& tick, const haptics::Command& in_force) {
  const glm::dvec3 force_N = tick.law_force_P_N.xyz;
  const double size_N = glm::length(force_N);
  if (!(size_N > 0.0)) return;
  const double radius_mm = in_force.tool.head.radius_mm;
  constexpr double kMetres = 1e-3;
  const double speed_m_per_s = std::abs(tick.spindle_rad_per_s) * radius_mm * kMetres;
  HeatedCell& cell = cells_[cellAt(tick.proxy_P.mm - radius_mm / size_N * force_N)];
  cell.step(tick.t_s, tick.dt_s, kHeatShare * size_N * speed_m_per_s,
            in_force.irrigating ? kWet_W_per_K : kDry_W_per_K);
  if (cell.over_K > hottest_K_) hottest_K_ = cell.over_K, hottest_s_ = tick.t_s;
}

void TissueWork::add(const haptics::Tick& tick, const haptics::Command& in_force) {
  const haptics::Tool& tool = in_force.tool;
  if (tool.turns()) {
    if (bur_ && !(bur_->head == tool.head)) ++changes_;
    bur_ = tool;
  }
  if (tick.soft.bur_cuts != assets::SoftTissue::none) {
    if (tick.t_s - last_soft_s_ > kTouchPause_s) ++soft_times_;
    soft_s_ += tick.dt_s;
    last_soft_s_ = tick.t_s;
  }
  if (!tick.drilling || has(tick.faults, haptics::Fault::bad_pose)) return;
  drilled_ = true;
  if (!(tick.overlap_mm3 > 0.0)) return;
  const double force_N = glm::length(tick.law_force_P_N.xyz);
  const bool on_tooth = assets::isTooth(tick.contact_tissue),
             on_bone = assets::isHard(tick.contact_tissue) && !on_tooth;
  if (on_bone && force_N > kBoneMost_N) bone_s_ += tick.dt_s;
  if (on_tooth && force_N > kToothMost_N) tooth_s_ += tick.dt_s;
  if (on_bone) heat(tick, in_force);
  if (!on_bone || !(tick.removed_mm3 > 0.0)) return;
  auto size = std::ranges::find(sizes_, tool.head.radius_mm, &BySize::radius_mm);
  if (size == sizes_.end()) size = sizes_.insert(size, {tool.head.radius_mm, 0.0});
  size->bone_mm3 += tick.removed_mm3;
}

std::vector<MeasureValue> TissueWork::values(std::optional<double> planned_radius_mm) const {
  std::vector<MeasureValue> values = untold(kTissueWork, {});
  const auto tell = [&](std::string_view id, std::optional<double> value, std::string_view why = {},
                        std::string conditions = {}, std::optional<double> t_s = {}) {
    MeasureValue& one = *std::ranges::find(values, id, &MeasureValue::id);
    one.value = value, one.why = value ? std::string_view() : why, one.t_s = t_s,
    one.conditions = std::move(conditions);
  };
  constexpr std::string_view kNotOn = "the drill was not on";
  const auto if_drilled = [this](double value) { return drilled_ ? std::optional(value) : std::nullopt; };
  tell("S8.bone", if_drilled(bone_s_), kNotOn, "force of the model, before limits and scale");
  tell("S8.tooth", if_drilled(tooth_s_), kNotOn, "force of the model, before limits and scale");
  tell("S9.time", soft_s_);
  tell("S9.events", static_cast<double>(soft_times_));
  tell("S11.heat", if_drilled(hottest_K_), kNotOn, "indicative: a lumped model of cells of 1 mm, our defaults",
       hottest_s_);
  tell("M9.changes", static_cast<double>(changes_));
  double all_mm3 = 0.0, of_size_mm3 = 0.0;
  for (const BySize& size : sizes_) {
    all_mm3 += size.bone_mm3;
    if (planned_radius_mm && std::abs(size.radius_mm - *planned_radius_mm) <= kSameSize_mm)
      of_size_mm3 += size.bone_mm3;
  }
  if (!planned_radius_mm)
    tell("M9.planned_size", {}, "no plan is known for this case");
  else
    tell("M9.planned_size", all_mm3 > 0.0 ? std::optional(of_size_mm3 / all_mm3) : std::nullopt, "no bone was cut");
  return values;
}

}  // namespace app
