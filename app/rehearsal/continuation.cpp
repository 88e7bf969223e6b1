#include "app/rehearsal/continuation.h"

#include <algorithm>
#include <filesystem>
#include <utility>

#include "app/session/replay.h"
#include "app/session/session_reader.h"
#include "app/text/usage_error.h"
#include "haptics/body/bodies.h"

namespace app {

DrawnPlan drawnPlanOf(const std::string& path) {
  DrawnPlan drawn;
  for (const SessionEvent& event : SessionReader(path).events())
    if (event.kind == kDrawnPlanEvent) drawn = drawnPlanFrom(event.text).value_or(DrawnPlan{});
  // A point is no line.
  for (auto& line : drawn.line_P_mm)
    if (line.size() == 1) line.clear();
  return drawn;
}

Continuation continuationOf(const std::string& path) {
  Continuation next;
  next.path = path;
  BoneAtTime bone = boneAtTime(path, {});
  next.remarks = std::move(bone.remarks);
  next.grid = bone.start.grid;
  next.solid = std::move(bone.solid);
  next.laid = std::move(bone.laid);
  // Of one that goes on itself and was recorded before it was stored the case alone knows.
  if (!bone.start.whole.empty())
    next.whole = std::move(bone.start.whole);
  else if (!bone.start.setup.former)
    next.whole = std::move(bone.start.solid);
  next.label = std::move(bone.start.label);
  next.setup = std::move(bone.start.setup);
  next.setup.fragments = std::move(bone.fragments);
  const double before_s = next.setup.former ? next.setup.former->duration_s : 0.0;
  haptics::Bodies left(next.grid, next.solid, next.label, bone.start.is_tooth);
  if (next.laid && left.filling() != nullptr) left.filling()->begin(*next.laid);
  next.setup.former =
      FormerSession{std::filesystem::path(path).filename().string(), before_s + bone.t_s, left.digest()};
  if (const std::vector<SessionCommand> commands = SessionReader(path).commands(); !commands.empty())
    next.command = commands.back().command;
  next.drawn = drawnPlanOf(path);
  // The serials of the former servo mean nothing to a new one.
  next.command.split = {};
  next.command.site = {};
  next.command.serial = next.command.undo_serial = next.command.redo_serial = next.command.rearm = 0;
  return next;
}

std::vector<std::uint8_t> Continuation::applyTo(assets::Patient& patient) const {
  const auto is_unlabelled = [](const std::vector<std::uint8_t>& labels) {
    return std::ranges::all_of(labels, [](std::uint8_t value) { return value == 0; });
  };
  const bool same_label = patient.ct.label.empty() ? is_unlabelled(label) : patient.ct.label == label;
  if (!(patient.ct.grid == grid) || !same_label)
    throw UsageError("--continue " + path + ": is of another patient or case, " +
                     (setup.built_in ? "or of another version of the built-in one"
                                     : "name its folder: molar rehearse PATIENT --continue " + path));
  patient.fragments = setup.fragments;
  std::vector<std::uint8_t> before = std::exchange(patient.ct.solid, solid);
  return whole.empty() ? before : whole;
}

}  // namespace app
