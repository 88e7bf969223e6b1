#include "app/review/session_sound.h"

#include <algorithm>
#include <cmath>

#include "app/session/locator_event.h"
#include "app/session/replay.h"
#include "app/session/session_error.h"
#include "app/sound/sound_file.h"
#include "app/sound/work_sound.h"

namespace app {

double writeSessionSound(const std::string& session_path, const std::string& to) {
  SessionReader session(session_path);
  refuseDamaged(session, session_path);
  if (const auto log = session.missingLog()) throw missingLogError(session_path, *log);
  const std::vector<SessionCommand> commands = session.commands();
  auto next = commands.begin();
  std::vector<SessionEvent> told = session.events();
  std::erase_if(told, [](const SessionEvent& event) { return event.kind != kLocatorEvent; });
  auto next_told = told.begin();
  haptics::Command in_force;
  ApexTone apex = ApexTone::none;
  SoundScore score;
  WorkSound sound(kSoundRate_Hz);
  SoundFile file(to, kSoundRate_Hz);
  std::vector<float> samples;
  double written = 0.0;
  for (TickBlock block = session.nextBlock(); !block.ticks.empty(); block = session.nextBlock())
    for (const haptics::Tick& tick : block.ticks) {
      for (; next != commands.end() && next->first_tick <= tick.index; ++next) in_force = next->command;
      const double until = std::round((tick.t_s + tick.dt_s) * kSoundRate_Hz);
      samples.resize(static_cast<std::size_t>(std::clamp(until - written, 0.0, 1e6)));
      written += static_cast<double>(samples.size());
      for (; next_told != told.end() && next_told->tick <= tick.index; ++next_told) {
        const auto shown = locatorFrom(next_told->text);
        apex = shown ? apexTone(shown->left_mm, shown->is_apex) : ApexTone::none;
      }
      SoundControl control = score.of(tick, in_force);
      control.warning.apex = apex;
      sound.render(control, samples);
      file.write(samples);
    }
  if (written == 0.0) throw SessionError(session_path + ": holds no tick, so that nothing was heard");
  file.close();
  return written / kSoundRate_Hz;
}

}  // namespace app
