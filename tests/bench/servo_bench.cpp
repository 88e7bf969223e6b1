// Work per tick, against the sum voxel by voxel, in one run: nothing else to install, nothing to compare by hand.
//   haptics_servo_bench            sums, laws, ticks, growth with the radius, instruction sets
//   haptics_servo_bench correction what the measured arm adds to a tick
//   haptics_servo_bench soft       what soft tissue adds to a tick
//   haptics_servo_bench memory     60 x 60 x 50 mm of bone at 0.1 mm: bytes a voxel, as counted and as resident
// Times are CPU time of this thread, so that other work on the machine disturbs them less; p10 is what the code costs.
#include <time.h>
#include <unistd.h>

#include <algorithm>
#include <cstdio>
#include <fstream>
#include <random>
#include <string_view>
#include <vector>

#include "haptics/bone/carve.h"
#include "haptics/contact/law.h"
#include "haptics/contact/overlap.h"
#include "haptics/servo/measured_handle.h"
#include "haptics/servo/servo.h"
#include "haptics/servo/soft_hold.h"
#include "tests/haptics/phantom.h"
#include "tests/haptics/time_erosion.h"
#include "tests/haptics/untrue_omni.h"

namespace {

using namespace haptics;
using namespace haptics::phantom;

double threadTime_us() {
  timespec t{};
  clock_gettime(CLOCK_THREAD_CPUTIME_ID, &t);
  return static_cast<double>(t.tv_sec) * 1e6 + static_cast<double>(t.tv_nsec) * 1e-3;
}

struct Figures {
  double p10 = 0.0, p50 = 0.0, p99 = 0.0, most = 0.0;
};

template <class Work>
Figures measure(int times, Work work) {
  std::vector<double> us;
  for (int i = 0; i < times; ++i) {
    const double began = threadTime_us();
    work(i);
    us.push_back(threadTime_us() - began);
  }
  std::sort(us.begin(), us.end());
  return {us[us.size() / 10], us[us.size() / 2], us[us.size() * 99 / 100], us.back()};
}

void print(const char* scene, double s, double R, const Figures& figures, double twin_p10) {
  std::printf("%-24s %4.1f %4.1f %9.1f %9.1f %9.1f %9.1f", scene, s, R, figures.p10, figures.p50, figures.p99,
              figures.most);
  if (twin_p10 > 0.0) std::printf(" %9.0f", twin_p10 / figures.p10);
  std::printf("\n");
}

/// Bone of which 55 % of the voxels hold anything, at random: nothing is empty and nothing full.
Phantom trabecular(double half_mm, double s) {
  Phantom phantom = block(half_mm, s);
  std::mt19937 random(7);
  for (auto& solid : phantom.solid)
    solid = random() % 100 < 55 ? static_cast<std::uint8_t>(100 + random() % 156) : std::uint8_t{0};
  return phantom;
}

struct Scene {
  const char* name;
  Phantom (*bone)(double half_mm, double s);
  double centre_in_R;  ///< of the bur above the face, radii
};
const Scene kScenes[] = {{"solid bone", block, 0.0},
                         {"half a radius deep",
                          [](double h, double s) {
                            return halfSpace(h, s, {0.30, 0.50, 0.8124});
                          },
                          0.5},
                         {"trabecular bone", trabecular, 0.0}};

glm::dvec3 place(int i, double R, const Scene& scene) {
  return glm::dvec3(0.013 + 0.0005 * (i % 700), 0.021, 0.0) + scene.centre_in_R * R * glm::dvec3(0.30, 0.50, 0.8124);
}

void sums() {
  std::printf("one sum, %s\n%-24s %4s %4s %9s %9s %9s %9s %9s\n", nameOf(assets::chosenInstructionSet()).data(),
              "scene", "s", "R", "p10 us", "p50 us", "p99 us", "max us", "twin/p10");
  volatile double sink = 0.0;
  for (const Scene& scene : kScenes)
    for (double s : {0.2, 0.1})
      for (double R : {1.0, 2.0, 4.0}) {
        const Phantom phantom = scene.bone(R + 1.0, s);
        const SolidField field = phantom.field();
        const auto fast =
            measure(3000, [&](int i) { sink = sphereOverlap(field, {place(i, R, scene)}, R).volume_mm3; });
        const auto twin =
            measure(12, [&](int i) { sink = sphereOverlapVoxelByVoxel(field, {place(i, R, scene)}, R).volume_mm3; });
        print(scene.name, s, R, fast, twin.p10);
      }
}

/// One look of every law, half a radius deep in flat bone and in solid bone.
void laws() {
  std::printf("\nlaws, one look\n%-24s %4s %4s %9s %9s\n", "law", "s", "R", "half-deep", "solid");
  volatile double sink = 0.0;
  for (const auto& [R, s] : {std::pair(2.0, 0.2), std::pair(4.0, 0.1)}) {
    const Phantom half = kScenes[1].bone(R + 1.0, s), whole = kScenes[0].bone(R + 1.0, s);
    for (const LawName& name : kLaws) {
      LawSettings law;
      law.kind = name.kind;
      const auto p10 = [&](const Phantom& phantom, const Scene& scene) {
        const SolidField field = phantom.field();
        const BurShape head{ShapeKind::sphere, R, 0.0};
        const ToolMotion turning{{{1.0, 0.0, -1.0}}, 4000.0, 1e-3, 0.0};
        return measure(
                   300,
                   [&](int i) {
                     const calibration::Pose<Patient, calibration::Tool> X_PT{{1.0, 0.0, 0.0, 0.0}, place(i, R, scene)};
                     sink = contactOf(law, {field, head, X_PT, law.tissue, turning}).depth_mm;
                   })
            .p10;
      };
      std::printf("%-24s %4.1f %4.1f %9.1f %9.1f\n", std::string(name.key).c_str(), s, R, p10(half, kScenes[1]),
                  p10(whole, kScenes[0]));
    }
  }
}

/// Least squares of log time over log radius.
void growth() {
  std::printf("\ngrowth, s = 0.1 mm, R = 1 to 8 mm: cost ~ R^exponent\n");
  volatile double sink = 0.0;
  for (const Scene& scene : kScenes) {
    double n = 0.0, sx = 0.0, sy = 0.0, sxx = 0.0, sxy = 0.0;
    for (double R : {1.0, 2.0, 4.0, 8.0}) {
      const Phantom phantom = scene.bone(R + 1.0, 0.1);
      const SolidField field = phantom.field();
      const double us =
          measure(1000, [&](int i) { sink = sphereOverlap(field, {place(i, R, scene)}, R).volume_mm3; }).p10;
      const double x = std::log(R), y = std::log(us);
      n += 1.0, sx += x, sy += y, sxx += x * x, sxy += x * y;
    }
    std::printf("%-24s %.2f\n", scene.name, (n * sxy - sx * sy) / (n * sxx - sx * sx));
  }
}

void instructionSets() {
  std::printf("\ninstruction sets, solid bone, R = 4 mm, s = 0.1 mm\n");
  const Phantom phantom = block(5.0, 0.1);
  const SolidField field = phantom.field();
  const Point<Patient> centre{{0.013, 0.021, 0.0}};
  const double exact = sphereOverlapVoxelByVoxel(field, centre, 4.0).volume_mm3;
  volatile double sink = 0.0;
  for (assets::InstructionSet set :
       {assets::InstructionSet::portable, assets::InstructionSet::avx2, assets::InstructionSet::avx512}) {
    if (!assets::available(set)) {
      std::printf("%-24s not on this machine\n", nameOf(set).data());
      continue;
    }
    const auto one = [&](int i) {
      return sphereOverlap(field, {centre.mm + glm::dvec3(0.0005 * i, 0.0, 0.0)}, 4.0, nullptr, set).volume_mm3;
    };
    const auto fast = measure(1000, [&](int i) { sink = one(i); });
    std::printf("%-24s p10 %7.1f us, volume off by %.1e of itself\n", nameOf(set).data(), fast.p10,
                one(0) / exact - 1.0);
  }
}

/// Strokes at 12 mm/s with the hand 1 mm and more behind the surface, pedal down: contact, proxy, law, safety, carving.
void ticks() {
  std::printf("\na tick, drilling a trough\n%-24s %4s %4s %9s %9s %9s %9s\n", "erosion", "s", "R", "p10 us", "p50 us",
              "p99 us", "max us");
  volatile double sink = 0.0;
  for (double s : {0.2, 0.1})
    for (double R : {1.0, 2.0, 4.0}) {
      Bodies bone = halfSpace(R + 6.0, s).bodies(1);
      Servo servo(bone);
      Command command;
      command.tool.head.radius_mm = R;
      print("time", s, R,
            measure(3000,
                    [&](int i) {
                      HandSample hand;
                      hand.X_PT.translation_mm = {4.0 * std::sin(0.003 * i), 0.02, R - 1.0 - 0.0005 * i};
                      hand.drill_pedal = true;
                      sink = servo.step(hand, command, 1e-3).removed_mm3;
                    }),
            0.0);
      // All of it back, with the bur in the midst.
      HandSample hand;
      hand.X_PT.translation_mm = {0.0, 0.02, 0.0};
      servo.step(hand, command, 1e-3);
      ++command.undo_serial;
      print("its undo", s, R, measure(12, [&](int) { sink = servo.step(hand, command, 1e-3).removed_mm3; }), 0.0);
    }
}

/// What the measured arm adds to a tick: a thousand angles a look, so that the clock's own cost does not show.
void correction() {
  const calibration::PerturbedArm arm = untrueOmni(1);
  MeasuredHandle handle(calibration::MeasuredArm{arm.geometry, arm.truth, {}});
  constexpr int kAtOnce = 1000;
  volatile double sink = 0.0;
  const auto us = measure(300, [&](int i) {
    for (int n = 0; n < kAtOnce; ++n) {
      HandleState state;
      state.has_joints = true;
      const double a = 1e-4 * n + 1e-5 * i;
      state.joints_rad = {0.3 - a, 0.4 + a, -0.2 + a, 0.1 - a, 0.3 * a, -a};
      sink = handle.corrected(state).X_DH.translation_mm.x;
    }
  });
  constexpr double kNs = 1000.0 / kAtOnce;
  std::printf("\ncorrection of a measured arm, ns: p10 %.0f, p50 %.0f, p99 %.0f\n", kNs * us.p10, kNs * us.p50,
              kNs * us.p99);
}

/// The whole instrument along z in an opening between two walls of soft tissue, by hand motions of 1 mm.
void softTissue() {
  assets::SoftTissueField field;
  field.grid = {glm::ivec3(101), 1.5, glm::dvec3(-75.0, -75.0, -20.0)};
  field.tissue.assign(field.grid.voxelCount(), static_cast<std::uint8_t>(assets::SoftTissue::lip));
  field.distance.resize(field.grid.voxelCount());
  assets::forVoxels(field.grid, [&](glm::ivec3 at, std::size_t voxel) {
    field.distance[voxel] = assets::SoftTissueField::stored(12.0 - std::abs(field.grid.centre_P_mm(at).x));
  });
  Tool tool;
  tool.head.radius_mm = 1.5;
  tool.shaft = standardShaft(tool.head);
  std::printf("\nsoft tissue, a tick\n%-24s %9s %9s %9s\n", "the instrument", "p10 us", "p50 us", "p99 us");
  volatile double sink = 0.0;
  for (const auto& [name, x_mm] : {std::pair("free", 0.0), std::pair("held, 2 mm deep", 5.5)}) {
    SoftHold hold;
    const auto step = [&](double at_mm) {
      return hold.update(&field, tool, {{1.0, 0.0, 0.0, 0.0}, {at_mm, 0.0, 0.0}}, {}, false).touch.depth_mm;
    };
    for (int n = 0; n < 200; ++n) sink = step(x_mm * n / 200.0);
    const Figures us = measure(3000, [&](int i) { sink = step(x_mm + 0.5 * std::sin(0.01 * i)); });
    std::printf("%-24s %9.1f %9.1f %9.1f\n", name, us.p10, us.p50, us.p99);
  }
}

double resident_MB() {
  long pages = 0, resident = 0;
  std::ifstream("/proc/self/statm") >> pages >> resident;
  return static_cast<double>(resident) * static_cast<double>(sysconf(_SC_PAGESIZE)) / 1e6;
}

int memory() {
  const assets::VolumeGrid grid{{600, 600, 500}, 0.1, glm::dvec3(0.0)};
  const double voxels = static_cast<double>(grid.voxelCount());
  std::vector<std::uint8_t> solid(grid.voxelCount(), 255), label(grid.voxelCount(), 1);
  const double before_MB = resident_MB();
  CarvedBone bone(grid, solid, label);
  const double made_MB = resident_MB() - before_MB;
  for (std::uint64_t tick = 0; tick < 400; ++tick)
    carveSphere(bone, {{5.0 + 0.12 * static_cast<double>(tick), 30.0, 25.0}}, 4.0, phantom::timeErosion({}, 0.05),
                tick);
  std::printf("%.0f voxels: %.2f bytes a voxel counted, %.2f resident, %.2f after carving a trough of %.0f mm3\n",
              voxels, static_cast<double>(bone.bytes()) / voxels, made_MB * 1e6 / voxels,
              (resident_MB() - before_MB) * 1e6 / voxels, bone.removedByTissue_mm3()[1]);
  return 0;
}

}  // namespace

int main(int argc, char** argv) {
  if (argc > 1 && std::string_view(argv[1]) == "memory") return memory();
  if (argc > 1 && std::string_view(argv[1]) == "ticks") return ticks(), 0;
  if (argc > 1 && std::string_view(argv[1]) == "correction") return correction(), 0;
  if (argc > 1 && std::string_view(argv[1]) == "soft") return softTissue(), 0;
  sums();
  growth();
  instructionSets();
  laws();
  ticks();
  softTissue();
  correction();
}
