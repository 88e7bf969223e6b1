// A tooth with a conical root in a socket, a servo, and a hand with forceps or a bur over it. Frame P, mm.
#pragma once

#include <algorithm>
#include <array>
#include <cmath>
#include <memory>
#include <vector>

#include "haptics/servo/servo.h"
#include "tests/haptics/phantom.h"

namespace haptics::phantom {

/// Bone up to z = 0, the crown above it; across that a slot that leaves what is below `slot_from_x_mm`.
struct Mouth {
  Phantom phantom;
  std::vector<std::uint8_t> label, is_tooth;
  Bodies bodies;
  SocketSource sockets{bodies};
  DistanceField first_socket = sockets.firstSocket();
  Servo servo{bodies};
  std::vector<std::unique_ptr<PieceSite>> sites;
  Command command;
  HandSample hand;
  Tick tick;

  /// Signed distance, roughly: below 0 inside.
  static double inTooth_mm(const glm::dvec3& p) {
    const double radius_mm = p.z < 0.0 ? 2.6 + 0.1 * p.z : 2.8;
    return std::max(std::hypot(p.x, p.y) - radius_mm, std::max(p.z - 3.5, -5.5 - p.z));
  }

  /// Between tooth and bone at +x, 2 mm deep; below 0 inside.
  static double inGutter_mm(const glm::dvec3& p) {
    return std::max({std::abs(p.y) - 3.0, std::abs(p.x - 2.0) - 1.7, -2.0 - p.z});
  }

  explicit Mouth(bool gutter = false, double slot_from_x_mm = 1e3)
      : phantom(filled(8.0, 0.25,
                       [gutter, slot_from_x_mm](const glm::dvec3& p) {
                         if (p.x > slot_from_x_mm && std::abs(p.z - 1.0) < 0.5) return 1e3;
                         const double around_mm = std::max(p.z, 0.25 - inTooth_mm(p));
                         return std::min(inTooth_mm(p), gutter ? std::max(around_mm, -inGutter_mm(p)) : around_mm);
                       })),
        label(phantom.solid.size(), 1),
        is_tooth(phantom.solid.size(), 0),
        bodies([this] {
          assets::forVoxels(phantom.grid, [&](glm::ivec3 ijk, std::size_t v) {
            if (inTooth_mm(phantom.grid.centre_P_mm(ijk)) > 0.12) return;
            is_tooth[v] = 1;
            label[v] = static_cast<std::uint8_t>(assets::Tissue::dentine);
          });
          return Bodies(phantom.grid, phantom.solid, label, is_tooth);
        }()) {
    command.tool = forcepsTool();
    hand.X_PT.translation_mm = {6.0, 0.0, 2.0};
    step();
  }

  void step(int ticks = 1) {
    for (int n = 0; n < ticks; ++n) tick = servo.step(hand, command, 1e-3);
  }
  void makeReady(std::size_t piece = 0) {
    std::array<PiecePose, kMaxPieces> X_PQ;
    for (std::size_t n = 0; n < X_PQ.size(); ++n) X_PQ[n] = bodies.pose(n);
    sites.push_back(makePieceSite(sockets.scene(piece, X_PQ), first_socket));
    command.site = {command.site.serial + 1, bodies.digest(), piece, sites.back().get()};
    step();
  }
  void go(const glm::dvec3& to_mm, double seconds, const glm::dquat& turned = {1.0, 0.0, 0.0, 0.0}) {
    const glm::dvec3 from_mm = hand.X_PT.translation_mm;
    const glm::dquat from = hand.X_PT.rotation;
    const int steps = static_cast<int>(seconds / 1e-3 + 0.5);
    for (int n = 1; n <= steps; ++n) {
      const double u = static_cast<double>(n) / steps;
      hand.X_PT = {glm::slerp(from, turned, u), glm::mix(from_mm, to_mm, u)};
      hand.velocity_P_mm_per_s.xyz = (to_mm - from_mm) / seconds;
      step();
    }
    hand.velocity_P_mm_per_s = {};
  }
  void grip() {
    go({2.0, 0.0, 2.0}, 0.2);
    hand.drill_pedal = true;
    step();
  }
  /// Ever farther to both sides until a third is torn. Returns the share.
  double loosen() {
    const glm::dvec3 at_mm = hand.X_PT.translation_mm;
    for (int n = 0; n < 60 && tick.torn_share < 0.3; ++n)
      for (const double side : {1.0, -1.0})
        go(at_mm, 0.25, glm::angleAxis(side * (0.3 + 0.02 * n), glm::dvec3(0.0, 1.0, 0.0)));
    return tick.torn_share;
  }
  void release(int ticks = 400) {
    hand.drill_pedal = false;
    step(ticks);
  }
  /// To both sides until it is loose, then out.
  void rockOut(double rad) {
    const glm::dvec3 at_mm = hand.X_PT.translation_mm;
    for (int n = 0; n < 40 && tick.torn_share < 0.999; ++n)
      go(at_mm, 0.5, glm::angleAxis(n % 2 == 0 ? rad : -rad, glm::dvec3(0.0, 1.0, 0.0)));
    go(at_mm, 0.3);
    go(at_mm + glm::dvec3(0.0, 0.0, 9.0), 1.5);
  }
};

}  // namespace haptics::phantom
