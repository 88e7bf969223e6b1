#include "app/review/treatment_review.h"

#include <utility>
#include <vector>

#include "app/procedure/root_canal/dense_tooth.h"
#include "app/session/fragments_event.h"

namespace app {
namespace {

int fileSize(const haptics::CanalFile& file) { return file.isCone() ? 0 : static_cast<int>(file.size); }

FileUse fileUse(SessionReader& session, const assets::ToothCanals& tooth) {
  session.rewind();
  FileUse files(tooth);
  const std::vector<SessionCommand> commands = session.commands();
  std::size_t next = 0;
  int size = 0;
  for (;;) {
    const TickBlock block = session.nextBlock();
    if (block.ticks.empty()) break;
    for (const haptics::Tick& tick : block.ticks) {
      for (; next < commands.size() && commands[next].first_tick <= tick.index; ++next)
        size = fileSize(commands[next].command.tool.file);
      files.add(tick, size);
    }
  }
  files.setFragments(fragmentsIn(session.about().setup, session.events()));
  return files;
}

}  // namespace

std::optional<TreatmentOfSession> treatmentOfSession(SessionReader& session, const StoredStart& start,
                                                     const BoneLeft& left) {
  if (!start.setup.canals) return {};
  TreatmentOfSession of{*start.setup.canals, {}};
  if (const std::vector<SessionCommand> commands = session.commands(); !commands.empty())
    of.wear = commands.back().command.wear.law;
  const ToothBlocks before(DenseTooth(start.grid, start.whole.empty() ? start.solid : start.whole, start.label));
  const DenseSolid after(start.grid, left.solid);
  std::optional<DenseSolid> laid;
  if (left.laid) laid.emplace(start.grid, left.laid->laid);
  of.treatment = treatmentOf(of.tooth, before, after, fileUse(session, of.tooth), laid ? &*laid : nullptr);
  return of;
}

std::optional<TreatmentOfSession> treatmentOfSession(const std::string& path) {
  SessionReader session(path);
  if (!session.about().setup.canals) return {};
  const StoredStart start = session.start();
  auto end = session.finalBone(start);
  if (!end) return {};
  BoneLeft left;
  left.solid = std::move(end->solid);
  left.laid = session.finalFilling(start);
  return treatmentOfSession(session, start, left);
}

}  // namespace app
