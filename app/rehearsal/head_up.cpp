#include "app/rehearsal/head_up.h"

#include <algorithm>
#include <cmath>

#include <fmt/core.h>

#include "app/options/bur_name.h"
#include "app/rehearsal/luxation_log.h"
#include "assets/soft_tissue.h"
#include "assets/tissue.h"
#include "haptics/ligament/hand_coupling.h"
#include "haptics/tool/spindle.h"

namespace app {
namespace {

constexpr double kSaid_s = 2.0, kReading_s_per_letter = 0.06;
constexpr double kTurning_rpm = 200.0;

/// "40,000 rpm" in steps of 500, "drill off", "drill locked".
std::string driveText(double rpm, bool enabled) {
  if (rpm < kTurning_rpm) return enabled ? "drill off" : "drill locked";
  const long rounded = 500 * std::lround(rpm / 500.0);
  return rounded < 1000 ? fmt::format("{} rpm", rounded) : fmt::format("{},{:03} rpm", rounded / 1000, rounded % 1000);
}

/// What a hand instrument meets: "on bone", "on gingiva", "free".
std::string meetsText(const haptics::Tick& tick) {
  if (tick.depth_mm > 0.0 && tick.contact_tissue >= assets::kScanTissueCount) return "on filling";
  if (tick.depth_mm > 0.0) return assets::isTooth(tick.contact_tissue) ? "on tooth" : "on bone";
  if (!tick.soft.touches()) return "free";
  return fmt::format("on {}", assets::properties(tick.soft.tissue).name);
}

/// Of a file's line what has room in the cell; all of it then stands above.
std::string fileText(const std::string& line) {
  constexpr std::size_t kFits = 14;
  return line.size() <= kFits ? line : "in the tooth";
}

}  // namespace

bool HeadUp::execute(const ControlRequest& request) {
  bool* const shown = request.control == Control::keys   ? &keys_shown_
                      : request.control == Control::line ? &line_shown_
                                                         : nullptr;
  if (shown == nullptr) return false;
  *shown = request.value == kNoValue ? !*shown : request.value != 0;
  return true;
}

HeadUpContent HeadUp::content(const Values& values, Time now) {
  const haptics::Tick& tick = values.situation.tick;
  const haptics::Command& command = values.situation.command;
  HeadUpContent content;
  content.line_shown = line_shown_;
  content.bur = toolName(command.tool);
  const double rpm = std::abs(haptics::rpmOf(tick.spindle_rad_per_s));
  content.drive = command.tool.luxates()            ? luxationText(tick, command.tool, values.pieces_ready)
                  : command.tool.isHandInstrument() ? meetsText(tick)
                  : command.tool.isFile()           ? fileText(values.file)
                                                    : driveText(rpm, command.drill_enabled && !command.hands_off);
  content.turning = rpm >= kTurning_rpm;
  content.irrigating = command.irrigating;
  content.force_N = glm::length(tick.commanded_force_P_N.xyz);
  content.force_share = content.force_N / std::max(0.1, command.safety.peak_force_N);
  if (command.tool.isElevator()) {
    content.torque_Nmm = std::abs(tick.lever.twist_Nmm);
    content.torque_share = *content.torque_Nmm / haptics::ElevatorHand{}.most_twist_Nmm;
  }
  content.gap_mm = values.gap_mm;
  if (tick.depth_mm > 0.0) content.gap_mm = 0.0;
  // Of a file what counts is in the canal.
  if (command.tool.isFile()) content.gap_mm.reset();
  content.time_s = tick.t_s + tick.dt_s;
  content.task = values.task;
  content.ruler = values.ruler;
  content.site = values.socket;
  content.clearances = values.clearances;
  content.way = command.tool.isFile() && fileText(values.file) != values.file ? values.file : values.way;
  content.locator = values.locator;
  content.ring = values.ring;
  if (tick.dt_s > 0.0) content.warnings = warnings_.update(values.situation);

  if (!said_.line.empty() && !said_.until) {
    const double shown_s = std::max(kSaid_s, kReading_s_per_letter * static_cast<double>(said_.line.size()));
    said_.until = now + std::chrono::duration_cast<Time::duration>(std::chrono::duration<double>(shown_s));
  }
  if (said_.until && now >= *said_.until) said_ = {};
  content.said = said_.line;
  // Until it has turned once: who works with a mouse looks for the drill when the bur lies on the bone.
  has_drilled_ = has_drilled_ || content.turning;
  const bool is_bur = command.tool.turns();
  if (values.hints && content.said.empty() && !has_drilled_ && is_bur && tick.depth_mm > 0.0 && command.drill_enabled &&
      !values.situation.has_motors)
    content.said = "hold Space to drill";
  if (keys_shown_)
    for (const KeyMeaning& key : keyMeanings(with_laws_, values.situation.has_motors))
      content.keys.emplace_back(key.key, key.does);
  return content;
}

}  // namespace app
