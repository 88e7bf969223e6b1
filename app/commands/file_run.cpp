#include "app/commands/file_run.h"

#include <algorithm>
#include <cmath>
#include <numbers>

#include <fmt/core.h>

#include "app/options/canal_text.h"
#include "app/text/list.h"
#include "app/text/parse_number.h"
#include "app/text/usage_error.h"
#include "haptics/file/canal_wear.h"

namespace app {
namespace {

using haptics::ChainShape;
using haptics::FileChain;
using haptics::FileInCanal;

constexpr int kRestTicks = 400, kStrokeTicks = 75;
constexpr double kPushStep_mm = 0.01, kStrokeStep_mm = 0.02, kTurnStep_rad = 0.01;
constexpr double kFieldSpacing_mm = 0.04, kStartAbove_mm = 0.5, kPrebent_mm = 3.0;

haptics::FilePose handAt(double z_mm) {
  haptics::FilePose X_PT;
  X_PT.translation_mm = {0.0, 0.0, z_mm};
  return X_PT;
}

double insertedTo(const KFileOptions& options, const assets::RootCanal& canal) {
  return options.depth_mm.value_or(canal.length_mm() - 0.5);
}

haptics::WearSettings wearOf(const KFileOptions& options) {
  haptics::WearSettings settings;
  if (options.wear == "counters") settings.law = haptics::WearLaw::counters;
  if (options.wear == "counters-helical") settings.law = haptics::WearLaw::counters_helical;
  return settings;
}

/// A hand with a file in a canal that it wears.
class PushedRun {
 public:
  PushedRun(const KFileOptions& options, const assets::KFile& file, const assets::CanalField& field)
      : bone_(field.grid, field.solid, {}),
        wear_(wearOf(options)),
        hand_(handAt(file.length_mm + kStartAbove_mm)),
        answer_{file, FileInCanal(chosenChain(options, file), {}, {true, 0.0}, hand_), {}} {
    answer_.rest.prebend(kPrebent_mm, options.prebend_deg * std::numbers::pi / 180.0, 0.0);
    if (options.prebend_deg != 0.0) overOrifice();
    if (options.working_mm) stop_ = haptics::RubberStop{*options.working_mm, {0.0, 0.0, 0.0}, {0.0, 0.0, 1.0}};
  }

  /// A bent tip is held over the orifice, not its handle.
  void overOrifice() {
    for (int n = 0; n < kRestTicks; ++n) {
      const ChainShape& shape = answer_.rest.state().shape;
      if (n == kRestTicks / 2) hand_.translation_mm.x -= shape.node_mm[answer_.rest.chain().links].x;
      move(0.0, 0.0);
    }
  }

  bool goesOn() const { return !answer_.rest.fragment(); }
  double axial_N() const { return answer_.tick.on_hand.force_N.xyz.z; }

  void move(double down_mm, double turn_rad) {
    hand_.translation_mm.z -= down_mm;
    hand_.rotation = glm::normalize(hand_.rotation * glm::angleAxis(turn_rad, glm::dvec3(0.0, 0.0, -1.0)));
    const haptics::SolidField wall = bone_.field();
    answer_.tick = answer_.rest.step(hand_, {&wall, stop_, nullptr});
    ++ticks_;
  }
  void turn(double down_mm, double turn_rad) {
    move(down_mm, turn_rad);
    if (std::abs(answer_.tick.torque_Nmm) > std::abs(answer_.torque_Nmm)) answer_.torque_Nmm = answer_.tick.torque_Nmm;
    answer_.torque_share = std::max(answer_.torque_share, answer_.tick.torque_share);
  }
  void file(double down_mm) {
    move(down_mm, 0.0);
    wear_.step(answer_.rest, bone_, nullptr, ticks_);
  }
  FiledAnswer atRest() {
    for (int n = 0; n < kRestTicks && goesOn(); ++n) {
      move(0.0, 0.0);
      if (n > 20 && !answer_.tick.unsettled && answer_.tick.steps == 1) break;
    }
    answer_.unsettled = answer_.tick.unsettled;
    answer_.due_mm3 = wear_.due_mm3();
    answer_.removed_mm3 = wear_.removed_mm3();
    return answer_;
  }

 private:
  haptics::CarvedBone bone_;
  haptics::CanalWear wear_;
  haptics::FilePose hand_;
  FiledAnswer answer_;
  std::optional<haptics::RubberStop> stop_;
  std::uint64_t ticks_ = 0;
};

}  // namespace

assets::KFile chosenFile(const KFileOptions& options) {
  const auto list = [](const auto& values) { return joined(values, [](int n) { return std::to_string(n); }); };
  const auto metal = options.material == "niti" ? assets::KFileMetal::nickel_titanium : assets::KFileMetal::steel;
  if (const auto file = assets::kFile(options.size, options.length_mm, metal)) return *file;
  if (assets::kFile(options.size, assets::kKFileLengths_mm[0], metal))
    throw UsageError(
        fmt::format("--length {}: K-files are made in {} mm", options.length_mm, list(assets::kKFileLengths_mm)));
  throw UsageError(
      fmt::format("--size {}: ISO 3630-1 has no such size, choose {}", options.size, list(assets::kKFileSizes)));
}

FileChain chosenChain(const KFileOptions& options, const assets::KFile& file) {
  const auto links = static_cast<std::size_t>(options.nodes);
  if (!options.uniform_N_mm2) return haptics::fileChain(file, links);
  return haptics::uniformChain(file.length_mm, *options.uniform_N_mm2, 0.5 * file.tip_mm(), links);
}

std::size_t loadedNode(const KFileOptions& options) {
  if (options.at == "tip") return static_cast<std::size_t>(options.nodes);
  const auto node = parseNumber<int>(options.at);
  if (!node || *node < 1 || *node > options.nodes)
    throw UsageError(fmt::format("--at {}: it is no node, give tip or 1 to {}", options.at, options.nodes));
  return static_cast<std::size_t>(*node);
}

std::optional<assets::RootCanal> chosenCanal(const KFileOptions& options, const assets::KFile& file) {
  if (options.canal.empty()) return std::nullopt;
  if (options.solver == "rk4") throw UsageError("--solver rk4: it knows no walls, leave out --canal");
  if (options.at != "tip") throw UsageError("--at: the hand pushes the file into the canal, leave it out with --canal");
  if (options.force_N < 0.0)
    throw UsageError("--force-N: the hand pushes, give a positive number of newtons with --canal");
  const assets::RootCanal canal = canalFrom(options.canal);
  const double orifice_mm = 2.0 * canal.orifice_radius_mm, depth_mm = insertedTo(options, canal);
  if (file.tip_mm() >= orifice_mm)
    throw UsageError(
        fmt::format("--size {}: its tip of {:.2f} mm is wider than the orifice of {:.2f} mm, choose a "
                    "smaller one",
                    file.size, file.tip_mm(), orifice_mm));
  if (!std::isfinite(depth_mm) || depth_mm < 0.1 || depth_mm > canal.length_mm() + 2.0)
    throw UsageError(fmt::format("--depth: out of range, give 0.1 to {:.1f} mm", canal.length_mm() + 2.0));
  if (depth_mm > file.length_mm)
    throw UsageError(fmt::format("--depth: the file is {:g} mm long, give less or a longer file", file.length_mm));
  return canal;
}

FiledAnswer freeFile(const KFileOptions& options, const assets::KFile& file) {
  const FileChain chain = chosenChain(options, file);
  haptics::FileLaw law;
  law.drag_N_per_mm2 = 0.0;
  const haptics::FilePose hand = handAt(0.0);
  haptics::PerNode<glm::dvec3> pull_N{};
  pull_N[loadedNode(options)].x = options.force_N;
  FiledAnswer answer{file, FileInCanal(chain, law, {true, 0.0}, hand), {}};
  answer.rest.prebend(kPrebent_mm, options.prebend_deg * std::numbers::pi / 180.0, 0.0);
  double moved_mm = 1.0;
  for (int n = 0; n < kRestTicks && (n < 3 || moved_mm > 1e-9) && !answer.tick.broken_link; ++n) {
    const glm::dvec3 tip_mm = answer.rest.state().shape.node_mm[chain.links];
    answer.tick = answer.rest.step(hand, {nullptr, {}, &pull_N});
    moved_mm = glm::length(answer.rest.state().shape.node_mm[chain.links] - tip_mm);
  }
  answer.unsettled = answer.tick.unsettled;
  return answer;
}

FiledAnswer pushedFile(const KFileOptions& options, const assets::KFile& file, const assets::RootCanal& canal) {
  const assets::CanalField field = assets::canalField(canal, kFieldSpacing_mm);
  PushedRun run(options, file, field);
  const int ticks = static_cast<int>(std::lround((insertedTo(options, canal) + kStartAbove_mm) / kPushStep_mm));
  for (int n = 0; n < ticks && run.goesOn(); ++n) {
    run.move(kPushStep_mm, 0.0);
    if (options.force_N > 0.0 && run.axial_N() >= options.force_N) break;
  }
  const double turn_rad = options.turn_deg * std::numbers::pi / 180.0;
  const int turns = static_cast<int>(std::ceil(std::abs(turn_rad) / kTurnStep_rad));
  for (int n = 0; n < turns && run.goesOn(); ++n) run.turn(0.0, turn_rad / turns);
  for (int stroke = 0; stroke < options.strokes; ++stroke)
    for (const double way_mm : {-kStrokeStep_mm, kStrokeStep_mm})
      for (int n = 0; n < kStrokeTicks && run.goesOn(); ++n) run.file(way_mm);
  // What is due waits for its section's turn.
  for (int n = 0; options.strokes > 0 && n < 20 && run.goesOn(); ++n) run.file(0.0);
  FiledAnswer answer = run.atRest();
  const glm::dvec3 tip_mm = answer.rest.state().shape.node_mm[answer.rest.chain().links];
  const double along_mm = canal.nearest_mm(tip_mm);
  answer.entered = tip_mm.z < 0.0 && glm::length(tip_mm - canal.at(along_mm).p_mm) < canal.radius_mm(along_mm);
  return answer;
}

}  // namespace app
