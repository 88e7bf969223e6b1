#include "haptics/ligament/elevator_hold.h"

#include <gtest/gtest.h>

#include <cstring>
#include <limits>
#include <random>

#include "tests/haptics/allocation_count.h"
#include "tests/haptics/elevator_scene.h"

namespace haptics {
namespace {

constexpr double kTick_s = 1e-3;
/// Of the core of a straight 301: between the balls along its edges.
constexpr double kCoreWidth_mm = 2.7, kCoreTip_mm = 0.2, kCoreRoot_mm = 0.7;

ElevatorLaw smoothLaw() {
  ElevatorLaw law;
  law.friction = 0.0;
  return law;
}

/// A straight 301 somewhere.
ElevatorHold bladeAt(const ToolPose& X_PT, const ElevatorLaw& law = {}) {
  ElevatorHold hold(ElevatorKind::straight_301, law);
  EXPECT_TRUE(hold.take(ElevatorKind::straight_301, X_PT));
  return hold;
}

/// Two walls across y, up to z; nothing above.
DistanceField slotField(double gap_mm, double top_mm) {
  return phantom::fieldWhere({60, 60, 70}, 0.2,
                             [=](const glm::dvec3& p) { return std::max(gap_mm / 2.0 - std::abs(p.y), p.z - top_mm); });
}

TEST(Elevator, IsAWheelAndAxleBetweenTwoWalls) {
  const DistanceField walls = slotField(2.0, 3.0);
  const ElevatorScene scene{.obstacles = &walls};
  const ToolPose rest = phantom::bladeAt({0.0, 0.0, -5.5});
  ElevatorHold hold = bladeAt(rest, smoothLaw());
  ElevatorHand hand{.X_PT = rest};
  int pressed = 0;
  for (int n = 0; n < 1200; ++n) {
    hand.X_PT.rotation = phantom::twisted(0.8 * n / 1200.0);
    const ElevatorTick tick = hold.step(hand, scene, nullptr, kTick_s);
    EXPECT_FALSE(tick.unsettled);
    if (tick.twist_Nmm < 100.0) continue;
    ++pressed;
    const double phi = phantom::twistOf(tick.X_PT), depth_mm = tick.fulcrum_P_mm.z - tick.X_PT.translation_mm.z;
    const double t_mm = kCoreTip_mm + (kCoreRoot_mm - kCoreTip_mm) * (depth_mm - 0.15) / 7.7;
    const double force_N = tick.twist_Nmm / (kCoreWidth_mm * std::cos(phi) - t_mm * std::sin(phi));
    EXPECT_NEAR(tick.blade_on_bone_N / (2.0 * force_N), 1.0, 0.01) << phi;
    EXPECT_LT(glm::length(tick.on_hand.force_N.xyz), 0.02 * force_N) << "a couple";
  }
  EXPECT_GT(pressed, 300);
}

TEST(Elevator, WedgesAPieceApartAsItPressesOnBothWalls) {
  // The walls of one piece, cut but not through: it does not move, the blade between presses on both.
  const DistanceField walls = slotField(2.0, 3.0);
  std::vector<SamplePoint> points = phantom::cylinder(3.0, 12.0, 0.5, 0.2);
  for (SamplePoint& point : points) point.p_Q_mm.z -= 20.0;
  PieceHold piece(arranged(points), LigamentLaw{});
  const ElevatorScene scene{.piece = &walls};
  const ToolPose rest = phantom::bladeAt({0.0, 0.0, -5.5});
  ElevatorHold hold = bladeAt(rest, smoothLaw());
  ElevatorHand hand{.X_PT = rest};
  ElevatorTick tick;
  for (int n = 0; n < 1200; ++n) {
    hand.X_PT.rotation = phantom::twisted(0.8 * n / 1200.0);
    tick = hold.step(hand, scene, &piece, kTick_s);
  }
  EXPECT_NEAR(tick.wedging.force_N / (0.5 * tick.blade_on_piece_N), 1.0, 0.01);
  EXPECT_GT(tick.wedging.force_N, 50.0);
  EXPECT_GT(std::abs(tick.wedging.axis_P.y), 0.99);
  EXPECT_NEAR(tick.wedging.at_P_mm.x, 0.0, 0.05);
  EXPECT_LT(glm::length(tick.on_piece.force_N.xyz), 0.02 * tick.wedging.force_N);
}

TEST(Elevator, IsALeverOverTheSecondMolar) {
  // Blade along x; under it a ledge, half of it tooth; over its tip a piece that is held by its ligament.
  const auto ledge = [](const glm::dvec3& p) {
    return phantom::boxDistance_mm(p - glm::dvec3(4.0, 0.0, -2.5), {1.6, 4.0, 2.0});
  };
  const DistanceField obstacles = phantom::fieldWhere({90, 60, 60}, 0.2, ledge);
  const DistanceField teeth =
      phantom::fieldWhere({90, 60, 60}, 0.2, [&](const glm::dvec3& p) { return std::max(ledge(p), p.y); });
  const auto crown = [](const glm::dvec3& p) {
    return phantom::boxDistance_mm(p - glm::dvec3(-1.5, 0.0, 2.6), {3.0, 3.0, 2.0});
  };
  const DistanceField own = phantom::fieldWhere({60, 60, 60}, 0.2, crown);
  std::vector<SamplePoint> points = phantom::cylinder(3.0, 12.0, 0.5, 0.2);
  for (SamplePoint& point : points) {
    point.p_Q_mm += glm::dvec3(-1.5, 0.0, 10.0);
    point.rest_gap_mm = -1e3;
  }
  PieceHold piece(arranged(points), LigamentLaw{});
  // Shaft along x, concave face up.
  const ToolPose rest{glm::dquat(0.5, 0.5, 0.5, 0.5), {0.0, 0.0, 0.1}};
  ElevatorHold hold = bladeAt(rest, smoothLaw());
  const ElevatorScene scene{&obstacles, &teeth, &own};
  ElevatorHand hand{.X_PT = rest};
  ElevatorTick tick;
  for (int n = 0; n < 1500; ++n) {
    // The handle goes down.
    hand.X_PT.rotation = glm::angleAxis(0.2 * std::min(1.0, n / 1000.0), glm::dvec3(0.0, 1.0, 0.0)) * rest.rotation;
    tick = hold.step(hand, scene, &piece, kTick_s);
    EXPECT_FALSE(tick.unsettled) << n;
  }
  const glm::dvec3 tip = tick.X_PT.translation_mm, fulcrum = tick.fulcrum_P_mm;
  const glm::dvec3 hand_N = -tick.on_hand.force_N.xyz;
  const double turn_Nmm = (-tick.on_hand.torque_Nmm.xyz + glm::cross(tip - fulcrum, hand_N)).y;
  const double lever_mm = fulcrum.x - (tip.x - tick.on_piece.torque_Nmm.xyz.y / tick.on_piece.force_N.xyz.z);
  EXPECT_GT(tick.blade_on_piece_N, 30.0);
  EXPECT_GT(lever_mm, 2.0);
  EXPECT_NEAR(tick.on_piece.force_N.xyz.z * lever_mm / turn_Nmm, 1.0, 0.01);
  const double on_ledge_N = tick.blade_on_teeth_N + tick.blade_on_bone_N;
  EXPECT_NEAR(on_ledge_N / (tick.blade_on_piece_N - hand_N.z), 1.0, 0.01);
  EXPECT_NEAR(tick.blade_on_teeth_N / on_ledge_N, 0.5, 0.01) << "share of the second molar";
}

TEST(Elevator, IsAWedgeWithFriction) {
  // A cleft of 45 degrees to each side, of which a field has the slope to the last digit; the tip's corners press on
  // both.
  constexpr double kHalf_rad = 45.0 * std::numbers::pi / 180.0;
  const DistanceField cleft = phantom::fieldWhere({60, 60, 60}, 0.2, [](const glm::dvec3& p) {
    return (p.z + 3.0) * std::sin(kHalf_rad) - std::abs(p.y) * std::cos(kHalf_rad);
  });
  const ElevatorScene scene{.obstacles = &cleft};
  for (const double friction : {0.0, 0.3}) {
    ElevatorLaw law;
    law.friction = friction;
    const ToolPose rest = phantom::bladeAt({0.0, 0.0, -1.0}, phantom::twisted(0.5 * std::numbers::pi));
    ElevatorHold hold = bladeAt(rest, law);
    ElevatorTick tick;
    double push_N = 0.0;
    for (int n = 0; n < 3000; ++n) {
      push_N = 0.01 * n;
      tick = hold.step(phantom::pushing(rest, {0.0, 0.0, -std::max(push_N, 0.1)}), scene, nullptr, kTick_s);
    }
    // Both normal forces, along y: less what friction takes back.
    const double normal_N = 0.5 * tick.blade_on_bone_N;
    const double side_N = normal_N * (std::cos(kHalf_rad) - friction * std::sin(kHalf_rad));
    EXPECT_NEAR(side_N / (push_N / (2.0 * std::tan(kHalf_rad + std::atan(friction)))), 1.0, 0.03) << friction;
  }
}

TEST(Elevator, SticksOnAnInclineBelowItsFriction) {
  const DistanceField plane = phantom::fieldWhere({60, 60, 60}, 0.2, [](const glm::dvec3& p) { return p.y + 2.0; });
  const ElevatorScene scene{.obstacles = &plane};
  const auto slid_mm = [&](double tangent) {
    const ToolPose rest = phantom::bladeAt({0.0, -1.55, -3.0});
    ElevatorHold hold = bladeAt(rest);
    // Pressed first, then the force leans over to its slope.
    ElevatorTick tick;
    glm::dvec3 from(0.0);
    for (int n = 0; n < 2000; ++n) {
      const double lean = tangent * std::min(1.0, n / 500.0);
      tick = hold.step(phantom::pushing(rest, {0.0, -20.0, -20.0 * lean}), scene, nullptr, kTick_s);
      if (n == 999) from = tick.X_PT.translation_mm;
    }
    return glm::distance(tick.X_PT.translation_mm, from);
  };
  EXPECT_LT(slid_mm(0.98 * 0.3), 1e-3);
  EXPECT_GT(slid_mm(1.02 * 0.3), 0.5);
}

TEST(Elevator, IsCentredInASlotThatIsTooNarrow) {
  const DistanceField slot = slotField(0.75, 6.0);
  const ElevatorScene scene{.obstacles = &slot};
  const ToolPose rest = phantom::bladeAt({0.0, 0.1, -4.0});
  ElevatorHold hold = bladeAt(rest, smoothLaw());
  ElevatorHand hand{.X_PT = phantom::bladeAt({0.0, 0.0, -4.0}), .stiffness_N_per_mm = 0.0};
  ElevatorTick tick;
  for (int n = 0; n < 500; ++n) tick = hold.step(hand, scene, nullptr, kTick_s);
  EXPECT_NEAR(tick.X_PT.translation_mm.y, 0.0, 0.02 * 0.25);
  EXPECT_GT(tick.blade_on_bone_N, 10.0);
}

/// Blade, piece, hand and friction in one, and its slope against differences.
TEST(Elevator, SlopesAreThoseOfTheEnergies) {
  const phantom::LuxationScene scene;
  const PieceHold piece = scene.hold();
  const ElevatorShape shape = elevatorShape(ElevatorKind::straight_34s);
  const ElevatorLaw law;
  std::mt19937 random(5);
  std::uniform_real_distribution<double> unit(-1.0, 1.0);
  const glm::dvec3 middle = shape.middle_T_mm, centre = piece.samples().centre_Q_mm;
  int pressed = 0, kinks = 0;
  for (int round = 0; round < 40; ++round) {
    const auto random_step = [&](double way, double turn) {
      return Six{way * unit(random),  way * unit(random),  way * unit(random),
                 turn * unit(random), turn * unit(random), turn * unit(random)};
    };
    ToolPose X_PT = scene.rest_X_PT;
    X_PT.rotation = X_PT.rotation * phantom::twisted(-0.25);
    X_PT = moved(X_PT, middle, random_step(0.1, 0.1));
    const PiecePose X_PQ = moved(PiecePose{}, centre, random_step(0.05, 0.01));
    ElevatorHand hand{.X_PT = moved(X_PT, middle, random_step(2.0, 0.8))};
    BladeFriction friction;
    for (auto& region : friction.region)
      region = {20.0, middle + glm::dvec3(unit(random), unit(random), unit(random)),
                glm::normalize(glm::dvec3(unit(random), unit(random), 2.0)), glm::dvec3(0.0)};
    BladeContacts contacts;
    contacts.find(shape, scene.scene(), &piece.samples(), law.point_N_per_mm, 50.0, X_PT, X_PQ);
    const auto at = [&](const Twelve& step, PairBalance& balance) {
      Six of_blade{}, of_piece{};
      std::copy_n(step.begin(), 6, of_blade.begin());
      std::copy_n(step.begin() + 6, 6, of_piece.begin());
      const ToolPose tool = moved(X_PT, middle, of_blade);
      const PiecePose moved_piece = moved(X_PQ, centre, of_piece);
      Balance one;
      addHand(hand, tool, middle, one);
      balance.add(one, 0);
      contacts.press(tool, moved_piece, balance);
      friction.add(law, X_PT, X_PQ, tool, moved_piece, middle, centre, balance);
    };
    PairBalance here;
    Twelve offset{};
    for (std::size_t n = 0; n < 12; ++n) offset[n] = n % 6 < 3 ? 0.01 * unit(random) : 0.0;
    at(offset, here);
    pressed += contacts.pressing().size() > 10 ? 1 : 0;
    double largest_N = 0.0;
    for (std::size_t n = 0; n < 12; ++n) largest_N = std::max(largest_N, std::abs(here.gradient[n]));
    for (std::size_t n = 0; n < 12; ++n) {
      const double h = 3e-4;
      Twelve less{}, more{};
      less[n] = -h;
      more[n] = h;
      PairBalance below, above;
      // Steps are about a pose: the offset first.
      Six of_blade{}, of_piece{};
      std::copy_n(offset.begin(), 6, of_blade.begin());
      std::copy_n(offset.begin() + 6, 6, of_piece.begin());
      const ToolPose keep_T = X_PT;
      const PiecePose keep_Q = X_PQ;
      const ToolPose from_T = moved(keep_T, middle, of_blade);
      const PiecePose from_Q = moved(keep_Q, centre, of_piece);
      const auto energy = [&](const Twelve& step) {
        Six blade_step{}, piece_step{};
        std::copy_n(step.begin(), 6, blade_step.begin());
        std::copy_n(step.begin() + 6, 6, piece_step.begin());
        const ToolPose tool = moved(from_T, middle, blade_step);
        const PiecePose placed = moved(from_Q, centre, piece_step);
        PairBalance balance;
        Balance one;
        addHand(hand, tool, middle, one);
        balance.add(one, 0);
        contacts.press(tool, placed, balance);
        friction.add(law, keep_T, keep_Q, tool, placed, middle, centre, balance);
        return balance.energy_Nmm;
      };
      const double apart = std::abs((energy(more) - energy(less)) / (2.0 * h) - here.gradient[n]);
      EXPECT_LT(apart, 1e-3 * largest_N + 2e-2) << n;
      kinks += apart > 1e-4 * largest_N + 2e-2 ? 1 : 0;
    }
  }
  EXPECT_GT(pressed, 20);
  EXPECT_LT(kinks, 480 * 3 / 100) << "of the edges between samples and blade";
}

/// Twists of 1.5 s until nine tenths are torn, at most `most`.
int twistsUntilLoose(const phantom::LuxationScene& scene, double torque_Nmm, int most) {
  PieceHold piece = scene.hold();
  ElevatorHold hold(ElevatorKind::straight_34s);
  hold.take(ElevatorKind::straight_34s, scene.rest_X_PT);
  for (int n = 0; n < 1500 * most; ++n) {
    const double share = 0.5 - 0.5 * std::cos(2.0 * std::numbers::pi * n / 1500.0);
    if (hold.step(scene.turned(0.9 * share, torque_Nmm), scene.scene(), &piece, kTick_s).torn_share > 0.9)
      return n / 1500 + 1;
  }
  return most + 1;
}

TEST(Elevator, LoosensInFewerTwistsTheHarderItIsTwisted) {
  const phantom::LuxationScene scene;
  const int at_500 = twistsUntilLoose(scene, 500.0, 24), at_600 = twistsUntilLoose(scene, 600.0, 24);
  EXPECT_EQ(twistsUntilLoose(scene, 300.0, 8), 9) << "not at all";
  EXPECT_GT(at_500, 10);
  EXPECT_GT(at_500, at_600);
  EXPECT_GT(at_600, 3);
  EXPECT_EQ(twistsUntilLoose(scene, 800.0, 3), 1);
}

/// A closed way of the hand: smooth, from rest to rest.
struct ClosedHand {
  std::array<std::array<double, 3>, 6> part{};

  ClosedHand(std::mt19937& random, double way_mm, double turn_rad) {
    std::uniform_real_distribution<double> unit(-1.0, 1.0);
    for (std::size_t n = 0; n < 6; ++n)
      for (double& harmonic : part[n]) harmonic = unit(random) * (n < 3 ? way_mm : turn_rad) / 2.0;
  }
  ToolPose at(const ToolPose& rest, double share) const {
    std::array<double, 6> value{};
    for (std::size_t n = 0; n < 6; ++n)
      for (std::size_t h = 0; h < 3; ++h)
        value[n] += part[n][h] * std::sin(std::numbers::pi * static_cast<double>(h + 1) * share);
    const glm::dquat turn = glm::normalize(glm::dquat(1.0, 0.5 * glm::dvec3(value[3], value[4], value[5])));
    return {turn * rest.rotation, rest.translation_mm + glm::dvec3(value[0], value[1], value[2])};
  }
};

TEST(Elevator, NoClosedWayOfTheHandGainsEnergy) {
  const phantom::LuxationScene scene;
  std::mt19937 random(3);
  double least_Nmm = 0.0, most_N = 0.0;
  for (int loop = 0; loop < 40; ++loop) {
    PieceHold piece = scene.hold();
    ElevatorHold hold(ElevatorKind::straight_34s);
    hold.take(ElevatorKind::straight_34s, scene.rest_X_PT);
    const double size = 0.2 + 0.1 * (loop % 10);
    const ClosedHand way(random, 3.0 * size, 0.6 * size);
    ElevatorHand hand{.X_PT = scene.rest_X_PT};
    double work_Nmm = 0.0, torn_Nmm = 0.0;
    Wrench<calibration::Patient> before{};
    constexpr int kTicks = 800;
    for (int n = 1; n <= kTicks; ++n) {
      const ToolPose from = hand.X_PT;
      hand.X_PT = way.at(scene.rest_X_PT, static_cast<double>(n) / kTicks);
      const ElevatorTick tick = hold.step(hand, scene.scene(), &piece, kTick_s);
      const glm::dquat turn = hand.X_PT.rotation * glm::conjugate(from.rotation);
      // What the hand does on its end of the coupling.
      work_Nmm -= 0.5 * glm::dot(tick.on_hand.force_N.xyz + before.force_N.xyz,
                                 hand.X_PT.translation_mm - from.translation_mm) +
                  glm::dot(tick.on_hand.torque_Nmm.xyz + before.torque_Nmm.xyz, glm::dvec3(turn.x, turn.y, turn.z));
      before = tick.on_hand;
      torn_Nmm += tick.torn_Nmm;
      most_N = std::max(most_N, tick.blade_on_piece_N);
    }
    least_Nmm = std::min(least_Nmm, work_Nmm - 0.95 * torn_Nmm);
  }
  EXPECT_GT(most_N, 100.0);
  EXPECT_GE(least_Nmm, -0.1);
}

/// A hand that goes somewhere else every 0.2 s about the rest of a scene.
struct RandomTool {
  std::mt19937 random;
  double way_mm, turn_rad;
  int tick = 0;
  std::array<double, 6> from{}, to{};

  RandomTool(unsigned seed, double way, double turn) : random(seed), way_mm(way), turn_rad(turn) {}
  ElevatorHand next(const ToolPose& rest) {
    if (tick++ % 200 == 0) {
      from = to;
      std::uniform_real_distribution<double> unit(-1.0, 1.0);
      for (double& part : to) part = unit(random);
    }
    const double share = (tick - 1) % 200 / 200.0;
    std::array<double, 6> at{};
    for (std::size_t n = 0; n < 6; ++n) at[n] = from[n] + share * (to[n] - from[n]);
    const glm::dquat turn = glm::normalize(glm::dquat(1.0, 0.5 * turn_rad * glm::dvec3(at[3], at[4], at[5])));
    return {.X_PT = {turn * rest.rotation, rest.translation_mm + way_mm * glm::dvec3(at[0], at[1], at[2])}};
  }
};

constexpr std::array kKinds = {ElevatorKind::straight_301, ElevatorKind::straight_34s, ElevatorKind::cryer_left,
                               ElevatorKind::cryer_right};

TEST(Elevator, RandomHandsNearlyAlwaysSettle) {
  const phantom::LuxationScene scene;
  std::array<int, 2> unsettled{}, ticks{};  // attached, loose
  for (unsigned seed = 0; seed < 8; ++seed) {
    PieceHold piece = scene.hold();
    ElevatorHold hold;
    hold.take(kKinds[seed % kKinds.size()], scene.rest_X_PT);
    RandomTool hand(seed, 1.0 + 0.5 * seed, 0.3 + 0.1 * seed);
    for (int n = 0; n < 2000; ++n) {
      const ElevatorTick tick = hold.step(hand.next(scene.rest_X_PT), scene.scene(), &piece, kTick_s);
      EXPECT_LE(tick.evaluations, kMostEvaluations);
      EXPECT_TRUE(calibration::isFinite(tick.X_PT.translation_mm) && calibration::isFinite(tick.X_PQ.translation_mm));
      const std::size_t loose = tick.torn_share > 0.99 ? 1 : 0;
      ++ticks[loose];
      unsettled[loose] += tick.unsettled ? 1 : 0;
    }
    EXPECT_EQ(hold.shape().points, elevatorShape(kKinds[seed % kKinds.size()]).points);
  }
  EXPECT_LT(unsettled[0], ticks[0] / 100) << "of " << ticks[0];
  EXPECT_LT(unsettled[1], ticks[1] * 8 / 100) << "of " << ticks[1] << ": a loose piece is forced where it cannot go";
  EXPECT_GT(ticks[1], 2000);
}

TEST(Elevator, SaysTheSameBitsAgainAndAfterBeingPutBack) {
  const phantom::LuxationScene scene;
  const auto run = [&](int put_back_at) {
    PieceHold piece = scene.hold();
    ElevatorHold hold;
    hold.take(ElevatorKind::straight_34s, scene.rest_X_PT);
    RandomTool hand(2, 1.0, 0.5);
    std::vector<ElevatorTick> ticks;
    for (int n = 0; n < 600; ++n) {
      const ElevatorHand now = hand.next(scene.rest_X_PT);
      if (n == put_back_at) {
        const ElevatorState state = hold.state();
        const PieceState of_piece = piece.state();
        hold.step(now, scene.scene(), &piece, kTick_s);
        hold.restore(state);
        piece.restore(of_piece);
      }
      ticks.push_back(hold.step(now, scene.scene(), &piece, kTick_s));
    }
    return ticks;
  };
  const std::vector<ElevatorTick> once = run(-1), again = run(300);
  double most_N = 0.0;
  for (std::size_t n = 0; n < once.size(); ++n) {
    ASSERT_EQ(std::memcmp(&once[n].X_PT, &again[n].X_PT, sizeof(ToolPose)), 0) << n;
    ASSERT_EQ(std::memcmp(&once[n].X_PQ, &again[n].X_PQ, sizeof(PiecePose)), 0) << n;
    ASSERT_EQ(once[n].twist_Nmm, again[n].twist_Nmm) << n;
    ASSERT_EQ(once[n].torn_Nmm, again[n].torn_Nmm) << n;
    most_N = std::max(most_N, once[n].blade_on_piece_N);
  }
  EXPECT_GT(most_N, 10.0);
}

TEST(Elevator, StepsWithoutAllocation) {
  const phantom::LuxationScene scene;
  PieceHold piece = scene.hold();
  ElevatorHold hold;
  RandomTool hand(4, 1.0, 0.5);
  const std::size_t before = allocation_count::onThisThread();
  hold.take(ElevatorKind::straight_34s, scene.rest_X_PT);
  for (int n = 0; n < 400; ++n) hold.step(hand.next(scene.rest_X_PT), scene.scene(), &piece, kTick_s);
  EXPECT_EQ(allocation_count::onThisThread(), before);
}

TEST(Elevator, InputThatIsNoNumberChangesNothing) {
  const phantom::LuxationScene scene;
  PieceHold piece = scene.hold();
  ElevatorHold hold;
  hold.take(ElevatorKind::straight_34s, scene.rest_X_PT);
  const ElevatorHand good = scene.turned(0.3, 1000.0);
  hold.step(good, scene.scene(), &piece, kTick_s);
  const ElevatorState before = hold.state();
  for (const double bad : {std::numeric_limits<double>::quiet_NaN(), std::numeric_limits<double>::infinity()}) {
    std::array<ElevatorHand, 5> hands{good, good, good, good, good};
    hands[0].X_PT.translation_mm.x = bad;
    hands[1].X_PT.rotation.w = bad;
    hands[2].stiffness_N_per_mm = bad;
    hands[3].twist_Nmm_per_rad = -bad;
    hands[4].tilt_Nmm_per_rad = bad;
    for (const ElevatorHand& hand : hands) EXPECT_TRUE(hold.step(hand, scene.scene(), &piece, kTick_s).refused);
    EXPECT_TRUE(hold.step(good, scene.scene(), &piece, bad).refused);
    EXPECT_FALSE(hold.take(ElevatorKind::cryer_left, {{1.0, 0.0, 0.0, 0.0}, {bad, 0.0, 0.0}}));
  }
  EXPECT_TRUE(hold.step(good, scene.scene(), &piece, 0.0).refused);
  EXPECT_EQ(std::memcmp(&hold.state().X_PT, &before.X_PT, sizeof(ToolPose)), 0);

  // A hand beyond all measure keeps the blade finite.
  ElevatorHand far = good;
  far.X_PT.translation_mm.x = 1e200;
  for (int n = 0; n < 50; ++n) hold.step(far, scene.scene(), &piece, kTick_s);
  EXPECT_TRUE(calibration::isFinite(hold.state().X_PT.translation_mm));
}

TEST(Elevator, HandEndsAtItsBounds) {
  ElevatorHand hand;
  hand.X_PT = {phantom::twisted(2.0), {100.0, 0.0, 0.0}};
  Balance balance;
  const HandPull pull = addHand(hand, {}, {0.0, 0.0, 4.0}, balance);
  EXPECT_NEAR(pull.twist_Nmm, hand.most_twist_Nmm, 1e-9);
  EXPECT_NEAR(glm::length(pull.on_blade.force_N.xyz), hand.most_N, 1e-9);
}

}  // namespace
}  // namespace haptics
