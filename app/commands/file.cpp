// `molar file`: the shape of a root-canal file under a force, free or pushed into a canal; where it touches, what the
// walls and the hand bear. As a table, or JSON for programs. Frame: the handle's axis points down -z, x across; mm, N.

#include <array>
#include <cmath>
#include <cstdio>
#include <memory>
#include <numbers>
#include <optional>

#include <fmt/core.h>
#include <nlohmann/json.hpp>

#include "app/commands/command.h"
#include "app/options/canal_text.h"
#include "app/text/command_line.h"
#include "app/text/list.h"
#include "app/text/message.h"
#include "app/text/parse_number.h"
#include "app/text/usage_error.h"
#include "haptics/bone/cubelets.h"
#include "haptics/file/file_in_canal.h"
#include "haptics/file/rk4_chain.h"

namespace app {
namespace {

using haptics::ChainShape;
using haptics::FileChain;
using haptics::FileInCanal;
using haptics::FileTick;

constexpr int kRestTicks = 400;
constexpr double kPushStep_mm = 0.01, kFieldSpacing_mm = 0.04, kStartAbove_mm = 0.5;

struct KFileOptions {
  int size = 25, length_mm = 25, nodes = static_cast<int>(haptics::kUsualLinks);
  std::string material = "steel", at = "tip", canal, solver = "rest";
  double force_N = 0.0;
  std::optional<double> depth_mm, uniform_N_mm2;
  bool json = false;
};

struct FiledAnswer {
  assets::KFile file;
  FileInCanal rest;
  FileTick tick;
  int unsettled = 0;  ///< ticks
};

haptics::FilePose handAt(double z_mm) {
  haptics::FilePose X_PT;
  X_PT.translation_mm = {0.0, 0.0, z_mm};
  return X_PT;
}

assets::KFile chosenFile(const KFileOptions& options) {
  const auto list = [](const auto& values) { return joined(values, [](int n) { return std::to_string(n); }); };
  const auto metal = options.material == "niti" ? assets::KFileMetal::nickel_titanium : assets::KFileMetal::steel;
  if (const auto file = assets::kFile(options.size, options.length_mm, metal)) return *file;
  const bool is_size = assets::kFile(options.size, assets::kKFileLengths_mm[0], metal).has_value();
  if (is_size)
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

/// Held at its handle, drawn across at a node, until nothing moves.
FiledAnswer freeFile(const KFileOptions& options, const assets::KFile& file) {
  const FileChain chain = chosenChain(options, file);
  haptics::FileLaw law;
  law.drag_N_per_mm2 = 0.0;
  const haptics::FilePose hand = handAt(0.0);
  haptics::PerNode<glm::dvec3> pull_N{};
  pull_N[loadedNode(options)].x = options.force_N;
  haptics::FileScene scene;
  scene.pull_P_N = &pull_N;
  FiledAnswer answer{file, FileInCanal(chain, law, {true, 0.0}, hand), {}, 0};
  double moved_mm = 1.0;
  for (int n = 0; n < kRestTicks && moved_mm > 1e-9; ++n) {
    const glm::dvec3 tip_mm = answer.rest.state().shape.node_mm[chain.links];
    answer.tick = answer.rest.step(hand, scene);
    moved_mm = glm::length(answer.rest.state().shape.node_mm[chain.links] - tip_mm);
    if (answer.tick.broken_link) break;
  }
  answer.unsettled = answer.tick.unsettled ? 1 : 0;
  return answer;
}

double insertedTo(const KFileOptions& options, const assets::RootCanal& canal) {
  return options.depth_mm.value_or(canal.length_mm() - 0.5);
}

/// Pushed from above the orifice along the handle's axis, to its depth or until the hand bears the force.
FiledAnswer pushedFile(const KFileOptions& options, const assets::KFile& file, const assets::RootCanal& canal) {
  const assets::CanalField field = assets::canalField(canal, kFieldSpacing_mm);
  const haptics::Cubelets cubelets(field.grid, field.solid, {});
  const haptics::SolidField wall = cubelets.field();
  const FileChain chain = chosenChain(options, file);
  const double top_mm = file.length_mm + kStartAbove_mm;
  FiledAnswer answer{file, FileInCanal(chain, {}, {true, 0.0}, handAt(top_mm)), {}, 0};
  haptics::FileScene scene;
  scene.wall = &wall;

  const int ticks = static_cast<int>(std::lround((insertedTo(options, canal) + kStartAbove_mm) / kPushStep_mm));
  haptics::FilePose hand = handAt(top_mm);
  for (int n = 0; n < ticks && !answer.tick.broken_link; ++n) {
    hand.translation_mm.z -= kPushStep_mm;
    answer.tick = answer.rest.step(hand, scene);
    if (options.force_N > 0.0 && answer.tick.on_hand.force_N.xyz.z >= options.force_N) break;
  }
  // Where the hand stays the file comes to rest.
  for (int n = 0; n < kRestTicks && !answer.tick.broken_link; ++n) {
    answer.tick = answer.rest.step(hand, scene);
    if (n > 20 && !answer.tick.unsettled && answer.tick.steps == 1) break;
  }
  answer.unsettled = answer.tick.unsettled ? 1 : 0;
  return answer;
}

nlohmann::json listOf(const glm::dvec3& v) { return {v.x, v.y, v.z}; }

nlohmann::json jsonOf(const KFileOptions& options, const FiledAnswer& answer, const assets::RootCanal* canal) {
  const ChainShape& shape = answer.rest.state().shape;
  const FileChain& chain = answer.rest.chain();
  const glm::dvec3 base_mm = shape.node_mm[0];
  nlohmann::json nodes = nlohmann::json::array(), contacts = nlohmann::json::array();
  for (std::size_t i = 0; i <= chain.links; ++i) {
    const glm::dvec3& p = shape.node_mm[i];
    nodes.push_back({{"node", i},
                     {"from_handle_mm", static_cast<double>(i) * chain.link_mm},
                     {"p_mm", listOf(p)},
                     {"diameter_mm", 2.0 * chain.radius_mm[i]}});
    if (canal == nullptr || i == 0 || answer.rest.balance().normal_N[i] <= 0.0) continue;
    contacts.push_back({{"node", i},
                        {"depth_mm", canal->nearest_mm(p)},
                        {"wall_N", answer.rest.balance().normal_N[i]},
                        {"force_N", listOf(answer.rest.balance().force_N[i])}});
  }
  const glm::dvec3 tip_mm = shape.node_mm[chain.links] - base_mm;
  nlohmann::json all{{"file",
                      {{"size", answer.file.size},
                       {"length_mm", answer.file.length_mm},
                       {"material", options.material},
                       {"colour", answer.file.colour()},
                       {"tip_mm", answer.file.tip_mm()},
                       {"nodes", chain.links}}},
                     {"settled", answer.unsettled == 0},
                     {"tip", {{"across_mm", tip_mm.x}, {"along_mm", -tip_mm.z}}},
                     {"on_hand",
                      {{"force_N", listOf(answer.tick.on_hand.force_N.xyz)},
                       {"torque_Nmm", listOf(answer.tick.on_hand.torque_Nmm.xyz)}}},
                     {"strain", answer.tick.strain},
                     {"strain_from_tip_mm", answer.tick.strain_from_tip_mm},
                     {"nodes", nodes}};
  if (canal != nullptr) {
    all["canal"] = {{"length_mm", canal->length_mm()},
                    {"schneider_deg", canal->schneider_rad() * 180.0 / std::numbers::pi}};
    all["tip"]["depth_mm"] = canal->nearest_mm(shape.node_mm[chain.links]);
    all["wall_N"] = answer.tick.normal_N;
    all["contacts"] = contacts;
  }
  return all;
}

void printShape(const FiledAnswer& answer) {
  const ChainShape& shape = answer.rest.state().shape;
  const FileChain& chain = answer.rest.chain();
  std::printf("%5s %10s %9s %9s %9s\n", "node", "from mm", "across", "along", "D mm");
  for (std::size_t i = 0; i <= chain.links; ++i) {
    const glm::dvec3 p = shape.node_mm[i] - shape.node_mm[0];
    std::printf("%5zu %10.3f %9.4f %9.4f %9.3f\n", i, static_cast<double>(i) * chain.link_mm, p.x, 0.0 - p.z,
                2.0 * chain.radius_mm[i]);
  }
}

void printContacts(const FiledAnswer& answer, const assets::RootCanal& canal) {
  const ChainShape& shape = answer.rest.state().shape;
  const FileChain& chain = answer.rest.chain();
  std::printf("%5s %10s %9s  %s\n", "node", "depth mm", "wall N", "force on it: x, y, z (N)");
  for (std::size_t i = 1; i <= chain.links; ++i) {
    if (answer.rest.balance().normal_N[i] <= 0.0) continue;
    const glm::dvec3& F = answer.rest.balance().force_N[i];
    std::printf("%5zu %10.2f %9.3f  %.3f, %.3f, %.3f\n", i, canal.nearest_mm(shape.node_mm[i]),
                answer.rest.balance().normal_N[i], F.x, F.y, F.z);
  }
  const double from_apex_mm = canal.length_mm() - canal.nearest_mm(shape.node_mm[chain.links]);
  std::printf("tip %.2f mm from the apex of %.2f mm; walls bear %.3f N in all\n", from_apex_mm, canal.length_mm(),
              answer.tick.normal_N);
}

void printFile(const KFileOptions& options, const FiledAnswer& answer, const assets::RootCanal* canal) {
  std::printf("K-file %d, %g mm, %s, %s: tip %.2f mm, %zu links\n", answer.file.size, answer.file.length_mm,
              options.material.c_str(), std::string(answer.file.colour()).c_str(), answer.file.tip_mm(),
              answer.rest.chain().links);
  if (canal != nullptr)
    printContacts(answer, *canal);
  else
    printShape(answer);
  const glm::dvec3 &F = answer.tick.on_hand.force_N.xyz, &M = answer.tick.on_hand.torque_Nmm.xyz;
  std::printf("on the hand %.4f, %.4f, %.4f N; %.4f, %.4f, %.4f N mm\n", F.x, F.y, F.z, M.x, M.y, M.z);
  std::printf("largest strain %.2f %% %.1f mm from the tip\n", 100.0 * answer.tick.strain,
              answer.tick.strain_from_tip_mm);
}

/// The damped chain of inflated inertia, until it rests.
void printDamped(const KFileOptions& options, const assets::KFile& file) {
  constexpr int kSubsteps = 4;
  const FileChain chain = chosenChain(options, file);
  haptics::Rk4Chain damped(chain, 1e-3, kSubsteps);
  haptics::PerNode<glm::dvec2> force_N{};
  force_N[loadedNode(options)].x = options.force_N;
  std::vector<double> across_mm;
  for (int n = 0; n < 4000; ++n) {
    damped.step(force_N);
    across_mm.push_back(damped.node_mm(chain.links).x);
  }
  int settled_ms = 0;
  for (std::size_t n = 0; n < across_mm.size(); ++n)
    if (std::abs(across_mm[n] - across_mm.back()) > 0.05 * std::abs(across_mm.back()))
      settled_ms = static_cast<int>(n) + 1;
  const glm::dvec2 tip_mm = damped.node_mm(chain.links);
  if (options.json) {
    std::printf("%s\n", nlohmann::json{{"tip", {{"across_mm", tip_mm.x}, {"along_mm", tip_mm.y}}},
                                       {"inertia_Nmm_s2", damped.inertia_Nmm_s2()},
                                       {"settling_ms", settled_ms}}
                            .dump(2)
                            .c_str());
    return;
  }
  std::printf("tip %.4f mm across, %.4f along; inertia %.3g N mm s2 a link (inflated), 5 %% after %d ms\n", tip_mm.x,
              tip_mm.y, damped.inertia_Nmm_s2(), settled_ms);
}

int bendFile(const KFileOptions& options) {
  const assets::KFile chosen = chosenFile(options);
  if (options.canal.empty()) {
    if (options.solver == "rk4") {
      printDamped(options, chosen);
      return 0;
    }
  } else if (options.solver == "rk4") {
    throw UsageError("--solver rk4: it knows no walls, leave out --canal");
  }

  std::optional<assets::RootCanal> canal;
  if (!options.canal.empty()) canal = canalFrom(options.canal);
  if (canal) {
    const double orifice_mm = 2.0 * canal->orifice_radius_mm, depth_mm = insertedTo(options, *canal);
    if (options.at != "tip")
      throw UsageError("--at: the hand pushes the file into the canal, leave it out with --canal");
    if (options.force_N < 0.0)
      throw UsageError("--force: the hand pushes, give a positive number of newtons with --canal");
    if (chosen.tip_mm() >= orifice_mm)
      throw UsageError(
          fmt::format("--size {}: its tip of {:.2f} mm is wider than the orifice of {:.2f} mm, choose a smaller one",
                      chosen.size, chosen.tip_mm(), orifice_mm));
    if (!std::isfinite(depth_mm) || depth_mm <= 0.0 || depth_mm > canal->length_mm() + 2.0)
      throw UsageError(fmt::format("--depth: out of range, give 0.1 to {:.1f} mm", canal->length_mm() + 2.0));
    if (depth_mm > chosen.length_mm)
      throw UsageError(fmt::format("--depth: the file is {:g} mm long, give less or a longer file", chosen.length_mm));
  }

  const FiledAnswer answer = canal ? pushedFile(options, chosen, *canal) : freeFile(options, chosen);
  if (options.json)
    std::printf("%s\n", jsonOf(options, answer, canal ? &*canal : nullptr).dump(2).c_str());
  else
    printFile(options, answer, canal ? &*canal : nullptr);
  if (answer.tick.broken_link) printMessage("the file broke");
  if (answer.unsettled > 0) printMessage("the file has not come to rest: what is printed is not its solution");
  return answer.unsettled > 0 ? 1 : 0;
}

}  // namespace

void addFile(CommandLine& molar) {
  auto o = std::make_shared<KFileOptions>();
  CommandLine& command =
      molar.command("file", "A root-canal file's shape and force, free or in a canal").forEngineers();
  command.example("molar file --size 25 --force 0.1 --at tip", "held at its handle, drawn across at its tip");
  command.example("molar file --size 20 --length 21 --canal arc:5,45", "pushed into a bent canal");
  command.option("--size", o->size, "ISO size, 6 to 140: the tip in 1/100 mm").showsDefault();
  command.option("--length", o->length_mm, "Tip to handle: 21, 25 or 31 mm").showsDefault();
  command.option("--material", o->material, "Steel, or nickel-titanium with its plateau")
      .oneOf({"steel", "niti"})
      .showsDefault();
  command.option("--force", o->force_N, "N across the handle's axis; with --canal: pushes until the hand bears it")
      .from(-100.0, 100.0)
      .showsDefault();
  command.option("--at", o->at, "Node that the force acts on: tip, or 1 to the number of links").showsDefault();
  command.option("--nodes", o->nodes, "Links")
      .wholeFrom(static_cast<int>(haptics::kFewestLinks), static_cast<int>(haptics::kMostLinks))
      .showsDefault();
  Option canal = command.option("--canal", o->canal, "Pushed into: " + canalForms() + " (" + builtInCanalNames() + ")");
  command.option("--depth", o->depth_mm, "How far the tip goes in, mm; else to 0.5 mm from the apex").needs(canal);
  command.option("--uniform", o->uniform_N_mm2, "The same bending stiffness everywhere, N mm2: for closed forms")
      .from(1e-3, 1e5)
      .excludes(canal);
  command.option("--solver", o->solver, "Free: the shape at rest, or a damped chain of inflated inertia (rk4)")
      .oneOf({"rest", "rk4"})
      .showsDefault();
  command.flag("--json", o->json, "For programs");
  command.does([o] { return bendFile(*o); });
}

}  // namespace app
