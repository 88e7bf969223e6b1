#include "app/rehearsal/wish_router.h"

#include <algorithm>

#include "app/rehearsal/frame_builder.h"
#include "app/rehearsal/rehearsal_outputs.h"
#include "app/text/said.h"

namespace app {
namespace {

double width_mm(const calibration::ScreenCorners& screen) {
  return glm::distance(screen.lower_left.mm, screen.lower_right.mm);
}

}  // namespace

WishRouter::WishRouter(const RehearsalPlan& plan, Equipment& equipment, CommandDesk& desk, RunMonitor& monitor,
                       LivePicture& picture, Journal& journal)
    : plan_(plan),
      equipment_(equipment),
      desk_(desk),
      monitor_(monitor),
      picture_(picture),
      journal_(journal),
      input_(restingTool()),
      script_(equipment.asks(), desk.tray(), equipment.rate_Hz()) {}

void WishRouter::takeInput(const haptics::Tick& newest, render::Frame& frame) {
  takeFromWindow();
  obeyScript(newest, frame);
  for (const ControlWish& wish : equipment_.takeWishes()) obey(wish, frame);
  for (const ControlWish& wish : input_.takeWishes()) obey(wish, frame);
}

void WishRouter::takeFromOperator(const OperatorSeat::Heard& heard, render::Frame& frame) {
  for (const render::WindowEvent& event : heard.keys)
    if (!isForProcedure(event)) input_.take(event, 0.0);
  for (const ControlWish& wish : heard.wishes) obey(wish, frame);
}

void WishRouter::takeFromWindow() {
  if (const render::Window* const window = picture_.window()) {
    const double mm_per_px = width_mm(plan_.rig.screen) / std::max(1, window->framebufferSize_px().x);
    for (const render::WindowEvent& event : picture_.display().takeEvents())
      if (!isForProcedure(event)) input_.take(event, mm_per_px);
  }
  if (haptics::MouseDevice* const mouse = equipment_.mouse())
    mouse->setTarget({{input_.X_WT().rotation, input_.X_WT().translation_mm}, input_.pedal()});
}

/// What is due at the tick that comes next; after the last one, what was due until then.
void WishRouter::obeyScript(const haptics::Tick& newest, render::Frame& frame) {
  const std::uint64_t made = newest.dt_s > 0.0 ? newest.index + 1 : 0;
  const std::uint64_t due = made > 0 && monitor_.isTimeOver(newest) ? made - 1 : made;
  for (const ScriptedWish& scripted : script_.takeDue(due)) obey(scripted.wish, frame, scripted.where);
}

/// `where`: it is written, if it is.
void WishRouter::obey(const ControlWish& wish, render::Frame& frame, const std::string& where) {
  if (wish.control == Control::stop) return stopForGood();
  if (wish.control == Control::end) return monitor_.endByUser();
  if ((plan_.procedure && plan_.procedure->take(wish)) || desk_.obey(wish, where)) return;
  frame.layers = layersAfter(frame.layers, wish);
  if (wish.control == Control::snapshot) takeSnapshot(picture_, frame, plan_.ticking == Ticking::by_itself, journal_);
  if (wish.control == Control::home) equipment_.workstation().setHome();
}

void WishRouter::stopForGood() {
  equipment_.workstation().emergencyStop();
  journal_.note("emergency stop", "motors off for good");
  say("emergency stop: the motors are off; end and start again to feel");
}

bool WishRouter::isForProcedure(const render::WindowEvent& event) const {
  const auto* key = std::get_if<render::KeyPressed>(&event);
  if (!plan_.procedure || !key || !key->down || key->repeated) return false;
  const int code = static_cast<int>(key->key);
  return code > ' ' && code <= 'Z' && plan_.procedure->takeKey(static_cast<char>(code));
}

}  // namespace app
