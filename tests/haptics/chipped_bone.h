// A block of bone with a peg on it that a bur cuts off, in a servo: what is left of the peg above the cut is a chip.
// Frame P, mm: bone below z = 0, the peg 0.8 x 0.8 mm, up to 1.8.
#pragma once

#include <vector>

#include "haptics/body/chip_search.h"
#include "haptics/servo/servo.h"
#include "tests/haptics/phantom.h"

namespace haptics::test {

struct ChippedBone {
  phantom::Phantom phantom = phantom::filled(6.0, 0.2, [](const glm::dvec3& p) {
    const double peg = std::max({std::abs(p.x) - 0.4, std::abs(p.y) - 0.4, p.z - 1.8});
    return std::min(p.z, peg);
  });
  std::vector<std::uint8_t> label = std::vector<std::uint8_t>(phantom.solid.size(), 1);
  Bodies bodies{phantom.grid, phantom.solid, label};
  FirstBytes first{bodies};
  Servo servo{bodies};
  Command command;
  HandSample hand;
  Tick tick;
  double removed_mm3 = 0.0;
  ChipPlan plan;
  std::vector<HandSample> hands;
  std::vector<Tick> ticks;

  ChippedBone() {
    command.serial = 1;
    command.tool.head = {ShapeKind::sphere, 0.4, 0.0};
    command.erosion.time.removal_rate_per_s = 100.0;
    hand.X_PT.translation_mm = {-3.0, 0.0, 4.0};
  }
  void step(int count = 1) {
    for (int n = 0; n < count; ++n) {
      hands.push_back(hand);
      tick = servo.step(hand, command, 1e-3);
      removed_mm3 += tick.removed_mm3;
      ticks.push_back(tick);
    }
  }
  /// Through the foot of the peg and away.
  void cut() {
    hand.drill_pedal = true;
    for (const double y_mm : {-0.3, 0.0, 0.3})
      for (int n = 0; n <= 600; ++n) {
        hand.X_PT.translation_mm = {-1.5 + 0.005 * n, y_mm, 0.8};
        step();
      }
    hand.drill_pedal = false;
    hand.X_PT.translation_mm = {-3.0, 0.0, 4.0};
    step(400);
  }
  ChipPlan found() const {
    ChipSearch search(first);
    forBricks(bodies.grid().bricks(), [&](std::size_t, glm::ivec3 corner) { giveBrick(bodies, corner / 8, search); });
    return search.plan();
  }
  void order() {
    plan = found();
    command.chips = {command.chips.serial + 1, bodies.digest(), plan.digest, &plan};
    ++command.serial;
  }
};

}  // namespace haptics::test
