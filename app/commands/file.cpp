// `molar file`: the shape of a root-canal file under a force, free or pushed into a canal; where it touches, what the
// walls and the hand bear. As a table, or JSON for programs. Frame: the handle's axis points down -z, x across; mm, N.

#include <cmath>
#include <cstdio>
#include <memory>
#include <numbers>
#include <optional>
#include <vector>

#include <fmt/core.h>
#include <nlohmann/json.hpp>

#include "app/commands/command.h"
#include "app/commands/file_run.h"
#include "app/options/canal_text.h"
#include "app/text/command_line.h"
#include "app/text/message.h"
#include "haptics/file/rk4_chain.h"

namespace app {
namespace {

using haptics::ChainShape;
using haptics::FileChain;

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
                     {"settled", !answer.unsettled},
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
    all["entered"] = answer.entered;
    all["contacts"] = contacts;
    all["turned"] = {{"torque_Nmm", answer.torque_Nmm}, {"of_breaking", answer.torque_share}};
    all["worn"] = {{"due_mm3", answer.due_mm3}, {"removed_mm3", answer.removed_mm3}};
    if (answer.rest.fragment()) all["broken_from_tip_mm"] = answer.rest.fragment()->from_tip_mm;
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
  if (options.turn_deg != 0.0)
    std::printf("turned %g degrees: at most %.4f N mm, %.0f %% of what breaks it\n", options.turn_deg,
                answer.torque_Nmm, 100.0 * answer.torque_share);
  if (options.strokes > 0)
    std::printf("%d strokes: %.5f mm3 from the walls, %.5f due by the law\n", options.strokes, answer.removed_mm3,
                answer.due_mm3);
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
  const std::optional<assets::RootCanal> canal = chosenCanal(options, chosen);
  if (options.solver == "rk4") {
    printDamped(options, chosen);
    return 0;
  }
  const FiledAnswer answer = canal ? pushedFile(options, chosen, *canal) : freeFile(options, chosen);
  if (options.json)
    std::printf("%s\n", jsonOf(options, answer, canal ? &*canal : nullptr).dump(2).c_str());
  else
    printFile(options, answer, canal ? &*canal : nullptr);
  if (const auto& left = answer.rest.fragment())
    printMessage(fmt::format("the file broke {:.1f} mm from its tip", left->from_tip_mm));
  if (answer.unsettled) printMessage("the file has not come to rest: what is printed is not its solution");
  if (!answer.entered)
    printMessage("the tip has not entered the canal, or left it again: bend it less or push it less deep");
  return answer.unsettled || !answer.entered ? 1 : 0;
}

}  // namespace

void addFile(CommandLine& molar) {
  auto o = std::make_shared<KFileOptions>();
  CommandLine& command =
      molar.command("file", "A root-canal file's shape and force, free or in a canal").forEngineers();
  command.example("molar file --size 25 --force-N 0.1 --at tip", "held at its handle, drawn across at its tip");
  command.example("molar file --size 20 --length 21 --canal arc:5,45", "pushed into a bent canal");
  command.option("--size", o->size, "ISO size, 6 to 140: the tip in 1/100 mm").showsDefault();
  command.option("--length", o->length_mm, "Tip to handle: 21, 25 or 31 mm").showsDefault();
  command.option("--material", o->material, "Steel, or nickel-titanium with its plateau")
      .oneOf({"steel", "niti"})
      .showsDefault();
  command.option("--force-N", o->force_N, "N across the handle's axis; with --canal: pushes until the hand bears it")
      .from(-100.0, 100.0)
      .showsDefault();
  command.option("--at", o->at, "Node that the force acts on: tip, or 1 to the number of links").showsDefault();
  command.option("--nodes", o->nodes, "Links")
      .wholeFrom(static_cast<int>(haptics::kFewestLinks), static_cast<int>(haptics::kMostLinks))
      .showsDefault();
  Option canal = command.option("--canal", o->canal, "Pushed into: " + canalForms() + ", of molar teeth --case usual");
  command.option("--depth", o->depth_mm, "How far the tip goes in, mm; else to 0.5 mm from the apex").needs(canal);
  command.option("--working-length", o->working_mm, "A rubber stop that far from the tip meets the orifice's plane, mm")
      .from(1.0, 30.0)
      .needs(canal);
  command.option("--prebend", o->prebend_deg, "The last 3 mm bent beforehand, degrees towards x")
      .from(-90.0, 90.0)
      .showsDefault();
  command.option("--turn", o->turn_deg, "Then turned, degrees, clockwise positive").from(-3600.0, 3600.0).needs(canal);
  command.option("--strokes", o->strokes, "Then drawn out by 1.5 mm and pushed in, so often, wearing the walls")
      .wholeFrom(0, 200)
      .needs(canal);
  command.option("--wear", o->wear, "By force and slip, or by counters along the file or its flutes")
      .oneOf({"wear", "counters", "counters-helical"})
      .showsDefault();
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
