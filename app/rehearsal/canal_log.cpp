#include "app/rehearsal/canal_log.h"

#include <algorithm>
#include <cmath>

#include <fmt/core.h>

#include "app/procedure/root_canal/canal_tip.h"

namespace app {
namespace {

constexpr double kAtLength_mm = 1.0;

}  // namespace

CanalLog::CanalLog(const assets::ToothCanals& tooth) : tooth_(tooth) {}

double CanalLog::depth_mm(const haptics::Tick& tick, const assets::ToothCanal& canal) const {
  const glm::dvec3& up = tooth_.frame.axes_P[2];
  const glm::dvec3 handle_P(tick.file.node_P_mm.front());
  return tick.file.left_mm - glm::dot(handle_P - canal.reference_P_mm, up);
}

std::vector<std::string> CanalLog::follow(std::span<const haptics::Tick> ticks, const haptics::Tool& tool) {
  std::vector<std::string> told;
  for (const haptics::Tick& tick : ticks) {
    const haptics::FileWork& file = tick.file;
    if (file.stay == haptics::FileStay::none) continue;
    filed_mm3_ = file.removed_total_mm3;
    strongest_share_ = std::max(strongest_share_, file.torque_share);
    if (file.broken_from_tip_mm > 0.0) {
      ++broken_;
      told.push_back(fmt::format("the file has broken: {:.1f} mm of it stay in the canal, at {:.1f} N mm",
                                 file.broken_from_tip_mm, std::abs(file.torque_Nmm)));
    }
    if (file.keeps_bend && !was_bent_)
      told.push_back(
          fmt::format("the file keeps a bend {:.0f} mm from its tip: take a new one", file.strain_from_tip_mm));
    was_bent_ = was_bent_ || file.keeps_bend;
    const auto place = canalTip(tooth_, file.tip_P_mm);
    if (!place || file.stay == haptics::FileStay::through) continue;
    const assets::ToothCanal& canal = tooth_.canals[place->canal];
    Work& work = works_[place->canal];
    work.deepest_mm = std::max(work.deepest_mm, place->along_mm);
    if (place->along_mm > canal.length_mm() - 0.5 - kAtLength_mm && tool.file.made())
      work.size = std::max(work.size, tool.file.made()->size);
    if (place->along_mm > canal.length_mm() && !work.is_beyond) {
      work.is_beyond = true;
      told.push_back(fmt::format("the file has passed the foramen of the {} canal", canal.name));
    }
  }
  return told;
}

std::string CanalLog::line(const haptics::Tick& tick) const {
  using haptics::FileStay;
  if (tick.file.stay == FileStay::through) return "in the tooth without force: draw it out";
  const auto place = canalTip(tooth_, tick.file.tip_P_mm);
  if (!place) return tick.file.stay == FileStay::wall ? "on the tooth" : "free";
  const assets::ToothCanal& canal = tooth_.canals[place->canal];
  std::string text =
      fmt::format("{:.1f} of {:.1f} mm in the {} canal", depth_mm(tick, canal), canal.workingLength_mm(), canal.name);
  if (tick.file.torque_share >= 0.05) text += fmt::format(", torque {:.0f} %", 100.0 * tick.file.torque_share);
  return text;
}

std::string CanalLog::summary() const {
  std::string text;
  for (const auto& [n, work] : works_) {
    if (work.size == 0) continue;
    const assets::ToothCanal& canal = tooth_.canals[n];
    text += fmt::format("{}{} canal: to size {}, {:.1f} of {:.1f} mm from the orifice{}", text.empty() ? "" : "; ",
                        canal.name, work.size, work.deepest_mm, canal.length_mm() - 0.5,
                        work.is_beyond ? ", beyond the foramen" : "");
  }
  if (filed_mm3_ > 0.0) text += fmt::format("{}{:.3f} mm³ filed", text.empty() ? "" : "; ", filed_mm3_);
  if (broken_ > 0) text += fmt::format("; {} file{} broken", broken_, broken_ == 1 ? "" : "s");
  if (!text.empty()) text += fmt::format("; largest torque {:.0f} % of what breaks a file", 100.0 * strongest_share_);
  return text;
}

}  // namespace app
