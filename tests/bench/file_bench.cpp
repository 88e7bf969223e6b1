// A root-canal file that bends: its shape beside closed forms, pushes into a bent canal, hands that wander.
//   haptics_file_bench            all parts
//   haptics_file_bench elastica   a cantilever under a large load
//   haptics_file_bench push       files pushed to length: time per tick, force, by links and voxels
//   haptics_file_bench hands      60 s of a wandering hand for each of 14 files: time per tick, ticks not at rest
//   haptics_file_bench strokes    files drawn to and fro near the apex, with what they take: time per tick, books
//   haptics_file_bench soak       ten minutes of one hand: 600,000 ticks
// CPU time of this thread. MOLAR_INSTRUCTIONS=portable or avx2 selects the set.
#include <cstdio>
#include <string>
#include <vector>

#include "assets/instruction_set.h"
#include "haptics/file/canal_wear.h"
#include "tests/bench/extraction_parts.h"
#include "tests/haptics/file_scene.h"

namespace bench {
namespace {

using haptics::FileChain;
using haptics::FileInCanal;
using haptics::FilePose;
using haptics::FileTick;
using haptics::phantom::CanalWall;

double share(std::vector<double>& sorted, int percent) {
  return sorted[sorted.size() * static_cast<std::size_t>(percent) / 100];
}

void elastica() {
  constexpr double kLength_mm = 16.0, kBending_N_mm2 = 20.0;
  const double known[][2] = {{1.0, 0.301721}, {2.0, 0.493457}, {5.0, 0.713792}, {10.0, 0.810609}};
  std::printf("elastica: P L2/EI, deflection / L at 16, 32, 64 links and its error\n");
  for (const auto& [alpha, exact] : known) {
    std::printf("  %5.1f ", alpha);
    for (const std::size_t links : {16U, 32U, 64U}) {
      const FileChain chain = haptics::uniformChain(kLength_mm, kBending_N_mm2, 0.2, links);
      haptics::FileLaw law;
      law.drag_N_per_mm2 = 0.0;
      const FilePose hand = haptics::phantom::above(chain, 0.0);
      FileInCanal file(chain, law, {true, 0.0}, hand);
      haptics::PerNode<glm::dvec3> pull{};
      pull[links].x = alpha * kBending_N_mm2 / (kLength_mm * kLength_mm);
      haptics::FileScene scene;
      scene.pull_P_N = &pull;
      for (int n = 0; n < 60; ++n) file.step(hand, scene);
      const double found = file.state().shape.node_mm[links].x / kLength_mm;
      std::printf("  %.6f %+.3f %%", found, 100.0 * (found / exact - 1.0));
    }
    std::printf("\n");
  }
}

void push() {
  std::printf("push into 30 degrees Schneider, R 5 mm, to 0.5 mm from the apex, 5 mm/s, friction 0.15\n");
  std::printf(
      "  size links voxel | us: median, 99 %%; last quarter median, 99 %% | steps  not at rest | push N  walls N\n");
  for (const double spacing_mm : {0.04, 0.02}) {
    const CanalWall canal(haptics::phantom::bentCanal(), spacing_mm);
    for (const int size : {10, 15, 20, 25})
      for (const std::size_t links : {16U, 32U, 64U}) {
        if (links != 32 && (spacing_mm < 0.03 || size == 10 || size == 20)) continue;
        FileChain chain = haptics::phantom::steelFile(size, links);
        chain.metal.set_strain = 0.0;
        FilePose hand = haptics::phantom::above(chain, 0.05);
        FileInCanal file(chain, haptics::phantom::evenFriction(), {true, 0.0}, hand);
        haptics::FileScene scene;
        scene.wall = &canal.wall;
        std::vector<double> us;
        FileTick tick;
        int steps = 0, unsettled = 0;
        for (int n = 0; n < 3110; ++n) {
          hand.translation_mm.z -= 0.005;
          const double began_us = threadTime_us();
          tick = file.step(hand, scene);
          us.push_back(threadTime_us() - began_us);
          steps += tick.steps;
          unsettled += tick.unsettled ? 1 : 0;
        }
        std::vector<double> late(us.end() - static_cast<std::ptrdiff_t>(us.size() / 4), us.end());
        std::sort(us.begin(), us.end());
        std::sort(late.begin(), late.end());
        std::printf("  %3d %4zu  %.2f | %5.0f %5.0f %5.0f %5.0f | %.2f %d | %.3f %.2f\n", size, links, spacing_mm,
                    share(us, 50), share(us, 99), share(late, 50), share(late, 99), steps / 3110.0, unsettled,
                    tick.on_hand.force_N.xyz.z, tick.normal_N);
      }
  }
}

void wander(const CanalWall& canal, const assets::KFile& of, unsigned seed, int ticks) {
  const FileChain chain = haptics::fileChain(of, haptics::kUsualLinks);
  const FilePose start = haptics::phantom::above(chain, -1.0);
  FileInCanal file(chain, {}, {}, start);
  haptics::FileScene scene;
  scene.wall = &canal.wall;
  haptics::phantom::WanderingHand hand(seed, start, 16.0);
  std::vector<double> us;
  us.reserve(static_cast<std::size_t>(ticks));
  long steps = 0;
  int unsettled = 0, reverted = 0, rose = 0;
  double strongest_N = 0.0;
  for (int n = 0; n < ticks; ++n) {
    const FilePose at = hand.next();
    const double began_us = threadTime_us();
    const FileTick tick = file.step(at, scene);
    us.push_back(threadTime_us() - began_us);
    steps += tick.steps;
    unsettled += tick.unsettled ? 1 : 0;
    reverted += tick.reverted ? 1 : 0;
    rose += tick.energy_Nmm > tick.started_Nmm + 1e-7 ? 1 : 0;
    strongest_N = std::max(strongest_N, glm::length(tick.on_hand.force_N.xyz));
  }
  std::sort(us.begin(), us.end());
  std::printf(
      "  #%-3d %s %7d ticks: median %4.0f, 99 %% %4.0f, largest %5.0f us; %.2f steps; not at rest %d, "
      "reverted %d, energy up %d; strongest %.2f N\n",
      of.size, of.metal == assets::KFileMetal::steel ? "steel" : "niti ", ticks, share(us, 50), share(us, 99),
      us.back(), static_cast<double>(steps) / ticks, unsettled, reverted, rose, strongest_N);
}

void strokes() {
  std::printf("twenty strokes of 1.5 mm near the apex of the same canal, 30 mm/s\n");
  for (const int size : {10, 15, 20, 25})
    for (const auto metal : {assets::KFileMetal::steel, assets::KFileMetal::nickel_titanium}) {
      const CanalWall canal(haptics::phantom::bentCanal(0.7));
      haptics::CarvedBone bone(canal.field.grid, canal.field.solid, {});
      haptics::CanalWear wear;
      const FileChain chain = haptics::fileChain(*assets::kFile(size, 21, metal), haptics::kUsualLinks);
      FilePose hand = haptics::phantom::above(chain, 0.05);
      FileInCanal file(chain, {}, {}, hand);
      std::vector<double> us, wear_us;
      std::uint64_t ticks = 0;
      int unsettled = 0;
      const auto move = [&](double way_mm) {
        hand.translation_mm.z -= way_mm;
        const haptics::SolidField wall = bone.field();
        haptics::FileScene scene;
        scene.wall = &wall;
        const double began_us = threadTime_us();
        const FileTick tick = file.step(hand, scene);
        const double lay_us = threadTime_us();
        wear.step(file, bone, nullptr, ticks++);
        us.push_back(threadTime_us() - began_us);
        wear_us.push_back(threadTime_us() - lay_us);
        unsettled += tick.unsettled ? 1 : 0;
      };
      for (int n = 0; n < 1460; ++n) move(0.01);
      us.clear(), wear_us.clear();
      for (int stroke = 0; stroke < 20; ++stroke)
        for (const double way_mm : {-0.03, 0.03})
          for (int n = 0; n < 50; ++n) move(way_mm);
      for (int n = 0; n < 20; ++n) move(0.0);
      std::sort(us.begin(), us.end());
      std::sort(wear_us.begin(), wear_us.end());
      std::printf(
          "  #%-3d %s  us: median %4.0f, 99 %% %4.0f; of wear %4.0f, %4.0f; due %.4f mm3, taken %.4f; not at rest %d\n",
          size, metal == assets::KFileMetal::steel ? "steel" : "niti ", share(us, 50), share(us, 99),
          share(wear_us, 50), share(wear_us, 99), wear.due_mm3(), wear.removed_mm3(), unsettled);
    }
}

void hands() {
  const CanalWall canal(haptics::phantom::bentCanal(0.7));
  std::printf("wandering hands in the same canal, its orifice round\n");
  unsigned seed = 0;
  for (const int size : {8, 10, 15, 20, 25, 30, 40})
    for (const auto metal : {assets::KFileMetal::steel, assets::KFileMetal::nickel_titanium})
      wander(canal, *assets::kFile(size, 25, metal), ++seed, 60000);
}

void soak() {
  const CanalWall canal(haptics::phantom::bentCanal(0.7));
  std::printf("ten minutes of a hand\n");
  wander(canal, *assets::kFile(20, 25, assets::KFileMetal::steel), 99, 600000);
}

}  // namespace
}  // namespace bench

int main(int argc, char** argv) {
  const std::string wanted = argc > 1 ? argv[1] : "";
  std::printf("%s\n", std::string(assets::nameOf(assets::chosenInstructionSet())).c_str());
  bool found = false;
  const auto part = [&](const char* name, void (*run)()) {
    if (!wanted.empty() && wanted != name) return;
    run();
    found = true;
  };
  part("elastica", bench::elastica);
  part("push", bench::push);
  part("strokes", bench::strokes);
  part("hands", bench::hands);
  part("soak", bench::soak);
  if (!found) std::fprintf(stderr, "haptics_file_bench: no part of this name\n");
  return found ? 0 : 2;
}
