#include "app/debrief/debrief_steering.h"

namespace app {

std::vector<DebriefGuide::Mark> incidentsOf(const DebriefRun& run) {
  std::vector<DebriefGuide::Mark> incidents;
  for (const SessionMark& mark : run.story().marks())
    if (mark.kind == MarkKind::error || mark.kind == MarkKind::touch) incidents.push_back({mark.t_s, mark.what});
  return incidents;
}

bool steer(Transport& transport, const DebriefGuide::Steered& wanted) {
  switch (wanted.what) {
    case DebriefSteer::play:
      if (!transport.isPlaying()) transport.playOrPause();
      break;
    case DebriefSteer::pause:
      transport.pause();
      break;
    case DebriefSteer::seek:
      transport.goTo(wanted.value);
      break;
    case DebriefSteer::scrub:
      transport.pause();
      transport.goTo(wanted.value);
      return true;
    case DebriefSteer::speed:
      transport.setSpeed(wanted.value);
      break;
  }
  return false;
}

DebriefSteering::DebriefSteering(DebriefGuide& guide, DebriefPlayer& player)
    : guide_(guide), player_(player), picture_([&player] { return player.scene().image(); }) {}

void DebriefSteering::take() {
  if (!guide_.allowsVoice()) player_.forgetVoice();
  // A page that is lost in mid-drag lets nothing go.
  constexpr std::chrono::milliseconds kLetGo{500};
  const auto now = std::chrono::steady_clock::now();
  const bool was_dragged = dragged_at_.has_value();
  if (dragged_at_ && now - *dragged_at_ > kLetGo) dragged_at_.reset();
  for (const DebriefGuide::Steered& one : guide_.takeSteered()) {
    // Nothing can be steered to before it was run again.
    if (!player_.isPrepared()) continue;
    dragged_at_ = steer(player_.transport(), one) ? std::optional(now) : std::nullopt;
  }
  if (was_dragged || dragged_at_) player_.setScrubbing(dragged_at_.has_value());
}

void DebriefSteering::tell(bool is_new_picture) {
  const Transport& transport = player_.transport();
  const DebriefRun& run = *player_.scene().runs().front();
  if (player_.isPrepared() && !knows_incidents_) {
    incidents_ = incidentsOf(run);
    knows_incidents_ = true;
  }
  guide_.follow({.t_s = transport.position_s(),
                 .length_s = transport.length_s(),
                 .tick_s = run.moments().start().dt_s,
                 .prepared_share = player_.preparedShare(),
                 .plays = transport.isPlaying(),
                 .speed = transport.speed(),
                 .values = valuesOf(run.moments().tick()),
                 .incidents = incidents_,
                 .is_new_picture = is_new_picture,
                 .picture = picture_});
}

}  // namespace app
