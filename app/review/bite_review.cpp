#include "app/review/bite_review.h"

#include "app/procedure/preparation/bite_watch.h"
#include "app/procedure/preparation/filling_outcomes.h"
#include "app/procedure/root_canal/dense_tooth.h"
#include "app/session/replay.h"
#include "app/session/session_reader.h"
#include "app/text/usage_error.h"

namespace app {

std::vector<BiteAgain> bitesAgain(const std::string& path) {
  SessionReader session(path);
  refuseDamaged(session, path);
  const StoredStart start = session.start();
  if (!start.setup.prepared) throw UsageError("--bites: " + path + " is no preparation of a tooth, leave it out");
  if (start.setup.former && start.whole.empty())
    throw UsageError("--bites: " + path + " continues another session, whose first tooth it does not hold, name that");
  const BittenTooth tooth(
      Crown(ToothBlocks(DenseTooth(start.grid, start.whole.empty() ? start.solid : start.whole, start.label)),
            start.setup.prepared->frame),
      *start.setup.prepared);
  std::vector<BiteAgain> all;
  for (const SessionEvent& event : session.events()) {
    if (event.kind != kBiteEvent) continue;
    const std::optional<BiteRecord> recorded = biteFrom(event.text);
    if (!recorded) continue;
    const ReplayedState state = replayTo(session, recorded->t_s);
    const std::vector<std::uint8_t> solid = state.bodies.solidInGridOrder();
    BoxBytes made(DenseSolid(start.grid, solid), tooth.box());
    if (const haptics::Filling* const filling = state.bodies.filling())
      made = filledTooth(made, filling->volumes(), start.grid);
    all.push_back({*recorded, recordOf(tooth.bitten(made, 0.001 * recorded->paper_um).bite, recorded->t_s)});
  }
  return all;
}

}  // namespace app
