// What the page's picture costs the drawing thread: read at once, or a frame late through a pixel buffer
// (render/gpu/late_image). Run under xvfb-run where there is no display.
#include <algorithm>
#include <chrono>
#include <cstdio>
#include <vector>

#include "render/frame_renderer.h"
#include "render/gpu/offscreen_context.h"
#include "tests/render/drawn_scene.h"

namespace {

using BenchClock = std::chrono::steady_clock;

double since_ms(BenchClock::time_point from) {
  return std::chrono::duration<double, std::milli>(BenchClock::now() - from).count();
}

void tell(const char* what, std::vector<double> times_ms) {
  std::ranges::sort(times_ms);
  std::printf("%-28s median %.2f ms, slowest %.2f\n", what, times_ms[times_ms.size() / 2], times_ms.back());
}

}  // namespace

int main() {
  using namespace render;
  constexpr int kFrames = 8;
  const OffscreenContext context;
  const assets::CtVolume ct = testing::ballVolume(testing::smallGrid(glm::ivec3(64), 0.5), {{{0, 0, 0}, 9.0}});
  FrameRenderer renderer(ct.grid, ct.solid, ct.label);
  testing::Random random(7);
  Frame frame = testing::frameFor(testing::randomRig(random, false));
  frame.rig.screen.px = {1280, 720};
  std::vector<double> at_once_ms, asked_ms, taken_ms;
  for (int n = 0; n < kFrames; ++n) {
    renderer.render(frame);
    BenchClock::time_point from = BenchClock::now();
    const Image whole = renderer.readImage();
    at_once_ms.push_back(since_ms(from));
  }
  for (int n = 0; n < kFrames; ++n) {
    renderer.render(frame);
    // As the loop waits for the drawing before it goes on; without it, the first call has that to do.
    renderer.throwIfError();
    BenchClock::time_point from = BenchClock::now();
    bool is_there = renderer.readLate({960, 540}).has_value();
    asked_ms.push_back(since_ms(from));
    renderer.render(frame);
    while (!is_there) {
      from = BenchClock::now();
      is_there = renderer.readLate({960, 540}).has_value();
    }
    taken_ms.push_back(since_ms(from));
  }
  tell("read at once, 1280 x 720", at_once_ms);
  tell("asked for, 960 x 540", asked_ms);
  tell("taken a frame later", taken_ms);
}
