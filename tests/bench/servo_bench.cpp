// Work per tick, against the sum voxel by voxel, in one run: nothing else to install, nothing to compare by hand.
// Scenes: the bur half a radius deep in flat bone and sliding; wholly inside solid bone; drilling a trough.
#include <time.h>

#include <algorithm>
#include <cstdio>
#include <vector>

#include "haptics/contact/overlap.h"
#include "haptics/servo/servo.h"
#include "tests/haptics/phantom.h"

namespace {

using namespace haptics;
using namespace haptics::phantom;

double threadTime_us() {
  timespec t{};
  clock_gettime(CLOCK_THREAD_CPUTIME_ID, &t);
  return static_cast<double>(t.tv_sec) * 1e6 + static_cast<double>(t.tv_nsec) * 1e-3;
}

struct Figures {
  double p50 = 0.0, p99 = 0.0, most = 0.0;
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
  return {us[us.size() / 2], us[us.size() * 99 / 100], us.back()};
}

void print(const char* scene, double s, double R, const Figures& figures, double twin_p50) {
  std::printf("%-28s %4.1f %4.1f %9.1f %9.1f %9.1f", scene, s, R, figures.p50, figures.p99, figures.most);
  if (twin_p50 > 0.0) std::printf(" %9.1f", twin_p50 / figures.p50);
  std::printf("\n");
}

}  // namespace

int main() {
  std::printf("%-28s %4s %4s %9s %9s %9s %9s\n", "scene", "s", "R", "p50 us", "p99 us", "max us", "twin / p50");
  for (double s : {0.2, 0.1})
    for (double R : {1.0, 2.0, 4.0}) {
      volatile double sink = 0.0;
      const auto place = [](int i) { return glm::dvec3(0.013 + 0.0005 * (i % 1000), 0.021, 0.0); };

      const Phantom flat = halfSpace(R + 1.0, s), solid = block(R + 1.0, s);
      const auto half = [&](int i) { return Point<Patient>{place(i) + glm::dvec3(0.0, 0.0, 0.5 * R)}; };
      const auto inside = [&](int i) { return Point<Patient>{place(i)}; };
      const auto fast = measure(2000, [&](int i) { sink = sphereOverlap(flat.field(), half(i), R).volume_mm3; });
      const auto twin =
          measure(30, [&](int i) { sink = sphereOverlapVoxelByVoxel(flat.field(), half(i), R).volume_mm3; });
      print("one sum, half a radius deep", s, R, fast, twin.p50);
      const auto full = measure(2000, [&](int i) { sink = sphereOverlap(solid.field(), inside(i), R).volume_mm3; });
      const auto full_twin =
          measure(30, [&](int i) { sink = sphereOverlapVoxelByVoxel(solid.field(), inside(i), R).volume_mm3; });
      print("one sum, solid bone", s, R, full, full_twin.p50);

      // A stroke at 12 mm/s, 1 mm behind the surface, pedal down: contact, proxy, law, safety, carving, digest.
      CarvedBone bone = halfSpace(R + 6.0, s).bone(1);
      Servo servo(bone);
      Command command;
      command.tool.head.radius_mm = R;
      print("tick, drilling a trough", s, R,
            measure(2000,
                    [&](int i) {
                      HandSample hand;
                      hand.X_PT.translation_mm = {4.0 * std::sin(0.003 * i), 0.02, R - 1.0 - 0.0005 * i};
                      hand.drill_pedal = true;
                      sink = servo.step(hand, command, 1e-3).removed_mm3;
                    }),
            0.0);
    }
}
