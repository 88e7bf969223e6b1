#include "app/rehearsal/canal_log.h"

#include <algorithm>
#include <cmath>
#include <utility>

#include <fmt/core.h>

#include "app/procedure/root_canal/canal_tip.h"

namespace app {
namespace {

constexpr double kFilling = 0.5, kDull = 0.7;  ///< from here on told

}  // namespace

CanalLog::CanalLog(const assets::ToothCanals& tooth, haptics::WearLaw wear,
                   const std::vector<assets::MetalFragment>& before)
    : use_(tooth), wear_(wear), fragments_(before) {
  use_.setFragments(before);
}

std::optional<std::span<const assets::MetalFragment>> CanalLog::takeFragments() {
  if (!std::exchange(fragments_changed_, false)) return {};
  return fragments_.lying();
}

double CanalLog::depth_mm(const haptics::Tick& tick, const assets::ToothCanal& canal) const {
  const glm::dvec3& up = use_.tooth().frame.axes_P[2];
  const glm::dvec3 handle_P(tick.file.node_P_mm.front());
  return tick.file.left_mm - glm::dot(handle_P - canal.reference_P_mm, up);
}

std::vector<std::string> CanalLog::follow(std::span<const haptics::Tick> ticks, const haptics::Tool& tool) {
  std::vector<std::string> told;
  is_cone_ = tool.file.isCone();
  const auto beyond = [&](std::size_t canal) { return use_.tip(canal).error().most_over_mm > 0.0; };
  for (const haptics::Tick& tick : ticks) {
    const int broken = use_.broken(), bent = use_.bent();
    const bool was_full = use_.isFull();
    const auto place = canalTip(use_.tooth(), tick.file.tip_P_mm);
    const bool was_beyond = place && beyond(place->canal);
    use_.add(tick, tool.file.isCone() ? 0 : static_cast<int>(tool.file.size));
    if (fragments_.follow(tick, tool.file)) {
      use_.setFragments(fragments_.lying());
      fragments_changed_ = true;
    }
    if (use_.broken() > broken)
      told.push_back(fmt::format("the file has broken: {:.1f} mm of it stay in the canal, at {:.1f} N mm",
                                 brokenOff(tick, tool.file).value_or(assets::MetalFragment{}).length_mm(),
                                 std::abs(tick.file.torque_Nmm)));
    if (use_.isFull() && !was_full) told.push_back("the flutes of the file are full: it takes nothing there");
    if (use_.bent() > bent)
      told.push_back(
          fmt::format("the file keeps a bend {:.0f} mm from its tip: take a new one", tick.file.strain_from_tip_mm));
    if (tick.filling.works && (is_cone_ || cone_mm3_ > 0.0)) {
      cone_mm3_ += tick.filling.changed_mm3;
    } else if (const double laid_mm3 = std::exchange(cone_mm3_, 0.0); laid_mm3 > 0.0) {
      told.push_back(fmt::format("a cone stays, seared off at the orifice: {:.2f} mm³ with its sealer", laid_mm3));
    }
    const bool is_long = is_cone_ && tick.file.stay == haptics::FileStay::wall && place &&
                         place->along_mm > use_.tooth().canals[place->canal].length_mm();
    if (is_long && !is_cone_long_)
      told.push_back(
          fmt::format("the cone has passed the foramen of the {} canal", use_.tooth().canals[place->canal].name));
    is_cone_long_ = is_long;
    if (place && !was_beyond && beyond(place->canal))
      told.push_back(
          fmt::format("the file has passed the foramen of the {} canal", use_.tooth().canals[place->canal].name));
  }
  return told;
}

std::string CanalLog::line(const haptics::Tick& tick) const {
  using haptics::FileStay;
  if (tick.file.stay == FileStay::through)
    return is_cone_ ? "the cone stays: draw the pliers out" : "in the tooth without force: draw it out";
  const auto place = canalTip(use_.tooth(), tick.file.tip_P_mm);
  if (!place) return tick.file.stay == FileStay::wall ? "on the tooth" : "free";
  const assets::ToothCanal& canal = use_.tooth().canals[place->canal];
  std::string text =
      fmt::format("{:.1f} of {:.1f} mm in the {} canal", depth_mm(tick, canal), canal.workingLength_mm(), canal.name);
  if (wear_ != haptics::WearLaw::wear) text += fmt::format(", wear by {}", nameOf(wear_));
  if (tick.file.flutes_full >= kFlutesFull)
    text += ", flutes full: wash or wipe it";
  else if (tick.file.flutes_full >= kFilling)
    text += fmt::format(", flutes {:.0f} %", 100.0 * tick.file.flutes_full);
  if (tick.file.sharpness < kDull) text += ", dull";
  if (const auto motion = use_.motion().now()) text += fmt::format(", {}", nameOf(*motion));
  if (tick.file.torque_share >= 0.05) text += fmt::format(", torque {:.0f} %", 100.0 * tick.file.torque_share);
  if (tick.file.removed_total_mm3 >= 0.005) text += fmt::format(", {:.2f} mm³", tick.file.removed_total_mm3);
  return text;
}

std::string CanalLog::summary() const {
  std::string text;
  for (std::size_t n = 0; n < use_.tooth().canals.size(); ++n) {
    if (use_.size(n) == 0) continue;
    const assets::ToothCanal& canal = use_.tooth().canals[n];
    const LengthError& error = use_.tip(n).error();
    constexpr double kShort_mm = 0.5;
    const double length_mm = canal.length_mm() - kShort_mm;
    text += fmt::format("{}{} canal: to size {}, {:.1f} of {:.1f} mm from the orifice{}", text.empty() ? "" : "; ",
                        canal.name, use_.size(n), length_mm + error.deepest_mm, length_mm,
                        error.most_over_mm > 0.0 ? ", beyond the foramen" : "");
  }
  if (use_.filed_mm3() > 0.0) text += fmt::format("{}{:.3f} mm³ filed", text.empty() ? "" : "; ", use_.filed_mm3());
  if (use_.debris_mm3() >= 0.001) text += fmt::format("; {:.3f} mm³ of chips left in", use_.debris_mm3());
  for (const PlacedFragment& one : use_.lying()) text += (text.empty() ? "" : "; ") + inWords(one);
  if (use_.broken() > 0) text += fmt::format("; {} file{} broken", use_.broken(), use_.broken() == 1 ? "" : "s");
  if (!text.empty())
    text += fmt::format("; largest torque {:.0f} % of what breaks a file", 100.0 * use_.torque_share());
  return text;
}

}  // namespace app
