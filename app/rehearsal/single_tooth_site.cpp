#include "app/rehearsal/single_tooth_site.h"

#include <cstdint>
#include <random>
#include <utility>
#include <vector>

#include <fmt/core.h>

#include "app/case/treated_tooth.h"
#include "app/rehearsal/file_sight.h"

namespace app {
namespace {

constexpr const char* kFillingEvent = "filling";

/// Another locator, or another day, every time; a stepped rehearsal repeats itself.
std::uint64_t locatorSeed(const assets::ToothCanals& tooth, bool is_real_time) {
  return is_real_time ? std::random_device{}() : static_cast<std::uint64_t>(tooth.fdi);
}

}  // namespace

SingleToothSite::SingleToothSite(const Links& links) : links_(links) {
  const RehearsalPlan& plan = links_.plan;
  const assets::Patient& patient = plan.patient;
  const std::span<const std::uint8_t> before = plan.scanned_solid.empty() ? patient.ct.solid : plan.scanned_solid;
  // An assessment tells nothing on the way.
  const bool measures = links_.is_real_time && !plan.is_assessed;
  if (patient.prepared) {
    painting_.emplace(patient.ct.grid, plan.outline);
    bite_.emplace(*patient.prepared, patient.ct, before, links_.bodies, plan.paper_mm);
    if (!plan.is_assessed) preparation_.emplace(*patient.prepared, patient.ct, before, links_.bodies);
  }
  if (!patient.canals) return;
  const assets::ToothCanals& tooth = *patient.canals;
  canal_log_.emplace(tooth, plan.command.wear.law, patient.fragments);
  access_.emplace(tooth, isRoofOpen(tooth, patient.ct));
  if (measures) treatment_.emplace(tooth, patient.ct, before, links_.bodies);
  if (plan.locator) locator_.emplace(tooth, patient.ct, *plan.locator, locatorSeed(tooth, links_.is_real_time));
}

void SingleToothSite::start() {
  if (locator_) links_.event_log.note(kLocatorEvent, locator_->settings());
}

void SingleToothSite::tell(const std::string& line, double t_s, const char* kind) {
  if (!links_.plan.is_assessed || kind == kFileEvent) links_.head_up.say(line);
  links_.event_log.note(kind, line);
  if (links_.plan.headless) printMessage(fmt::format("at {:.1f} s {}", t_s, line));
}

void SingleToothSite::follow(std::span<const haptics::Tick> ticks, const haptics::Tool& tool) {
  if (ticks.empty()) return;
  const double t_s = ticks.back().t_s;
  if (access_)
    for (const haptics::Tick& tick : ticks)
      if (const auto drop = access_->follow(tick, tool)) tell(roofDropText(*drop), t_s, kAccessEvent);
  if (canal_log_)
    for (const std::string& told : canal_log_->follow(ticks, tool)) tell(told, t_s, kFileEvent);
  if (links_.bodies.jaw().cutsWholeBlocks() && !std::exchange(tells_blocks_, true))
    tell("the tooth's memory is full: where it is still whole it is now cut in steps of four voxels", t_s, kFileEvent);
  if (ticks.back().filling.is_full && !std::exchange(tells_full_, true))
    tell("no more filling fits into memory: what is laid elsewhere is lost", t_s, kFillingEvent);
}

void SingleToothSite::followHand(const haptics::Tick& newest, const haptics::Command& command, render::Frame& picture) {
  if (locator_ && locator_->follow(newest, !command.irrigating, !command.tool.file.isCone()))
    links_.event_log.note(kLocatorEvent, locatorText(locator_->told()));
  const RehearsalPlan& plan = links_.plan;
  if (plan.patient.canals) showFileSight(*plan.patient.canals, newest, command.tool, plan.first_frame.mode, picture);
}

std::optional<std::span<const assets::MetalFragment>> SingleToothSite::takeFragments() {
  return canal_log_ ? canal_log_->takeFragments() : std::nullopt;
}

void SingleToothSite::followBone(std::span<const glm::ivec3> bricks, const haptics::Tick& newest,
                                 render::Frame& picture) {
  if (treatment_) treatment_->follow(bricks, newest, canal_log_->use());
  if (painting_) {
    if (preparation_ && links_.is_real_time && preparation_->follow(bricks, newest)) {
      painting_->take(preparation_->paint());
      tellIncrements(newest.t_s);
    }
    if (bite_->follow()) tellBite();
    painting_->show(picture);
  }
}

void SingleToothSite::bite(const haptics::Tick& newest) {
  if (!bite_) return;
  if (const std::string why_not = bite_->close(newest, !links_.is_real_time); !why_not.empty())
    links_.head_up.say(why_not);
}

void SingleToothSite::tellBite() {
  const BiteRecord& record = bite_->record();
  links_.event_log.note(kBiteEvent, biteText(record));
  const std::string line = biteLine(bite_->marked()->bite);
  links_.head_up.say(line);
  if (links_.plan.headless) printMessage(fmt::format("at {:.1f} s {}", record.t_s, line));
  painting_->take(*bite_->marked());
}

void SingleToothSite::paintNow(render::Frame& picture) {
  if (!preparation_ || !(picture.layers.deviation || picture.layers.insertion)) return;
  if (!preparation_->measureNow()) printMessage(preparation_->line());
  painting_->take(preparation_->paint());
  painting_->show(picture);
}

/// Once each.
void SingleToothSite::tellIncrements(double t_s) {
  const auto& outcomes = preparation_->newest();
  if (!outcomes || !outcomes->filling) return;
  for (const Increment& one : outcomes->filling->increments)
    if (one.isTooDeep() && deep_increments_.insert(one.number).second)
      tell(fmt::format("increment {} is {:.1f} mm deep: light sets {:g} mm", one.number, one.depth_mm,
                       kDeepestIncrement_mm),
           t_s, kFillingEvent);
}

void SingleToothSite::finish() {
  if (treatment_ && treatment_->times() > 0)
    links_.event_log.note(kAccessEvent, fmt::format("measured {} times, {:.2f} s of the processor at most",
                                                    treatment_->times(), treatment_->longest_s()));
}

std::string SingleToothSite::outcomeLine() const {
  if (treatment_ && treatment_->newest()) return treatmentLine(*treatment_->newest());
  return preparation_ ? preparation_->line() : std::string();
}

std::string SingleToothSite::fileLine(const haptics::Tick& newest) const {
  return canal_log_ && newest.file.stay != haptics::FileStay::none ? canal_log_->line(newest) : std::string();
}

std::optional<double> SingleToothSite::belowCusp_mm() const {
  if (!access_ || !hasDepthBands(links_.plan.patient.canals->fdi)) return {};
  return access_->belowCusp_mm();
}

const std::optional<LocatorTold>& SingleToothSite::located() const {
  static const std::optional<LocatorTold> kNothing;
  return locator_ ? locator_->told() : kNothing;
}

}  // namespace app
