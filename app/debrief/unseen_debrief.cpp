#include <chrono>
#include <optional>
#include <thread>
#include <utility>

#include "app/debrief/debrief_player.h"
#include "app/debrief/debrief_steering.h"
#include "app/text/elapsed.h"
#include "app/text/message.h"
#include "app/view/renderer_choice.h"
#include "render/gpu/graphics_card.h"
#include "render/gpu/offscreen_context.h"

namespace app {

void followDebriefUnseen(const DebriefPlan& plan, DebriefGuide& guide) {
  using UnseenClock = std::chrono::steady_clock;
  constexpr std::chrono::milliseconds kIdle{12};
  std::optional<render::OffscreenContext> context;  // outlives what is drawn with it
  DebriefPlayer player(plan);
  player.scene().runs().front()->bookmarks();
  render::RenderOptions options;
  options.backend = rendererWithoutWindow(plan.backend, context, printMessage);
  player.open(options, options.backend == render::Backend::cpu || render::currentGraphicsCard().is_software);
  DebriefSteering steering(guide, player);
  for (UnseenClock::time_point before = UnseenClock::now(); !steering.isOver();) {
    steering.take();
    const UnseenClock::time_point now = UnseenClock::now();
    player.advance(secondsBetween(std::exchange(before, now), now));
    const bool is_new = player.draw(plan.size_px, plan.choice);
    player.noteShown();
    steering.tell(is_new);
    if (!is_new && player.isPrepared()) std::this_thread::sleep_for(kIdle);
  }
}

}  // namespace app
