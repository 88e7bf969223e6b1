// Files in canals of closed form: forces, friction, torque, rest, and hands of all kinds.
#include <gtest/gtest.h>

#include <cstring>

#include "assets/instruction_set.h"
#include "haptics/file/wall_kernels.h"
#include "tests/haptics/allocation_count.h"
#include "tests/haptics/file_scene.h"
#include "tests/haptics/shuffled_blocks.h"

namespace haptics {
namespace {

using phantom::CanalWall;

const CanalWall& bent() {
  static const CanalWall wall(phantom::bentCanal());
  return wall;
}
const CanalWall& flared() {
  static const CanalWall wall(phantom::bentCanal(0.7));
  return wall;
}

/// A file that is pushed from above the orifice along the handle's axis.
struct Pushed {
  FileInCanal file;
  FilePose hand;
  FileScene scene;
  FileTick tick{};
  int unsettled = 0;

  Pushed(const CanalWall& canal, const FileChain& chain, const FileLaw& law, const FileGrip& grip = {true, 0.0})
      : file(chain, law, grip, phantom::above(chain, 0.05)), hand(phantom::above(chain, 0.05)) {
    scene.wall = &canal.wall;
  }
  void along(double way_mm, double step_mm) {
    const int ticks = static_cast<int>(std::lround(std::abs(way_mm) / step_mm));
    for (int n = 0; n < ticks; ++n) {
      hand.translation_mm.z -= way_mm / ticks;
      tick = file.step(hand, scene);
      unsettled += tick.unsettled ? 1 : 0;
    }
  }
  void turn(double angle_rad, int ticks) {
    for (int n = 0; n < ticks; ++n) {
      hand.rotation = glm::normalize(hand.rotation * glm::angleAxis(angle_rad / ticks, glm::dvec3(0.0, 0.0, -1.0)));
      tick = file.step(hand, scene);
      unsettled += tick.unsettled ? 1 : 0;
    }
  }
  double axial_N() const { return tick.on_hand.force_N.xyz.z; }
};

FileChain elastic(FileChain chain) {
  chain.metal.set_strain = 0.0;
  return chain;
}

double pushForce_N(const CanalWall& canal, int size, std::size_t links) {
  Pushed push(canal, elastic(phantom::steelFile(size, links)), phantom::evenFriction());
  push.along(15.55, 0.01);
  EXPECT_EQ(push.unsettled, 0) << size << ", " << links;
  return push.axial_N();
}

TEST(FileInCanal, IsPushedWithTheForceOfTwiceAsManyLinks) {
  for (const int size : {15, 20, 25}) {
    const double usual = pushForce_N(bent(), size, 32), fine = pushForce_N(bent(), size, 64);
    EXPECT_NEAR(usual / fine, 1.0, 0.03) << size;
  }
}

TEST(FileInCanal, IsPushedWithTheForceOfHalfTheVoxels) {
  const CanalWall fine(phantom::bentCanal(), 0.02);
  EXPECT_NEAR(pushForce_N(bent(), 20, 32) / pushForce_N(fine, 20, 32), 1.0, 0.05);
  EXPECT_NEAR(pushForce_N(bent(), 25, 32) / pushForce_N(fine, 25, 32), 1.0, 0.12) << "jammed";
}

/// A file that fills an arc bends as the arc: strain D / (2 R), but for its play.
TEST(FileInCanal, BendsAsTheCanalThatItFills) {
  const assets::RootCanal tight{4.0, 5.0, 1.2, 4.0, 0.175, 0.135, 1.0};
  const CanalWall canal(tight, 0.03);
  Pushed push(canal, elastic(phantom::steelFile(15, 64)), phantom::evenFriction());
  push.along(12.0, 0.01);
  const ChainShape& shape = push.file.state().shape;
  double bend = 0.0;
  std::size_t joints = 0;
  for (std::size_t i = 2; i <= 64; ++i) {
    const double along_mm = tight.nearest_mm(shape.node_mm[i - 1]);
    if (shape.node_mm[i - 1].z > -4.5 || along_mm < 5.0 || along_mm > 9.0) continue;
    bend += push.file.balance().bend[i].angle_rad;
    ++joints;
  }
  ASSERT_GT(joints, 8U);
  const double curvature = bend / (static_cast<double>(joints) * push.file.chain().link_mm);
  EXPECT_NEAR(curvature * tight.arc_radius_mm, 1.0, 0.05);
}

TEST(FileInCanal, SlidesWithItsFrictionTimesWhatPressesIt) {
  const double mu = 0.15;
  Pushed push(bent(), elastic(phantom::steelFile(20)), phantom::evenFriction(mu));
  push.along(13.0, 0.005);
  const double k = push.file.law().bristle_N_per_mm;
  double friction_N = 0.0, pressed_N = 0.0;
  for (std::size_t i = 1; i <= push.file.chain().links; ++i) {
    friction_N += mu * k * std::abs(push.file.state().bristle[i].mm.x);
    pressed_N += push.file.state().normal_N[i];
  }
  EXPECT_GT(pressed_N, 1.0);
  EXPECT_NEAR(friction_N / (mu * pressed_N), 1.0, 0.01);
}

TEST(FileInCanal, TurnsAgainstItsFrictionTimesTheRadiusOfWhatPressesIt) {
  const double mu = 0.3;
  Pushed push(bent(), elastic(phantom::steelFile(20)), phantom::evenFriction(mu));
  push.along(13.0, 0.01);
  push.turn(6.0, 600);
  double expected_Nmm = 0.0;
  for (std::size_t i = 1; i <= push.file.chain().links; ++i)
    expected_Nmm += mu * push.file.state().normal_N[i] * push.file.chain().radius_mm[i];
  EXPECT_NEAR(push.tick.torque_Nmm / expected_Nmm, 1.0, 1e-3);
  EXPECT_NEAR(-glm::dot(push.tick.on_hand.torque_Nmm.xyz, glm::dvec3(0.0, 0.0, -1.0)), push.tick.torque_Nmm, 1e-9);
  EXPECT_EQ(push.unsettled, 0);
}

/// Turning and pushing at once, the friction along the axis falls as v / sqrt(v^2 + (r w)^2).
TEST(FileInCanal, GoesInMoreEasilyWhileItTurns) {
  const double mu = 0.3;
  Pushed push(bent(), elastic(phantom::steelFile(20)), phantom::evenFriction(mu));
  push.along(12.0, 0.01);
  const auto axialShare = [&] {
    double axial = 0.0, pressed_N = 0.0;
    for (std::size_t i = 1; i <= push.file.chain().links; ++i) {
      axial += push.file.law().bristle_N_per_mm * std::abs(push.file.state().bristle[i].mm.x);
      pressed_N += push.file.state().normal_N[i];
    }
    return axial / pressed_N;
  };
  EXPECT_NEAR(axialShare(), 1.0, 0.02);
  for (int n = 0; n < 200; ++n) {
    push.along(0.002, 0.002);
    push.turn(0.01, 1);
  }
  EXPECT_LT(axialShare(), 0.9);
}

TEST(NodeFriction, ScrewsInAsItsFormula) {
  const double along = 0.15, across = 0.45, radius_mm = 0.14, lead_mm = 0.6, normal_N = 2.0;
  const FluteFriction flutes = fluteFriction(along, across, radius_mm, lead_mm);
  const double helix = std::atan(2.0 * std::numbers::pi * radius_mm / lead_mm);
  // Turned for long, the bristle lies round the axis.
  Bristle bristle;
  for (int n = 0; n < 400; ++n) {
    bristle.mm.y += 1e-3;
    bristle = {bristle.held(65.0, normal_N)};
  }
  const double round_N = bristlePull(65.0, normal_N, bristle.mm.y, bristle.mm.x).N;
  EXPECT_NEAR(-flutes.coupled * round_N, normal_N * (across - along) * std::sin(helix) * std::cos(helix), 1e-6);
  EXPECT_NEAR(flutes.round * round_N * radius_mm,
              normal_N * radius_mm * (along * std::pow(std::sin(helix), 2.0) + across * std::pow(std::cos(helix), 2.0)),
              1e-6);
  EXPECT_NEAR(flutes.axial, along * std::pow(std::cos(helix), 2.0) + across * std::pow(std::sin(helix), 2.0), 1e-12);
}

TEST(FileInCanal, TurnedClockwiseItPullsTheHandIn) {
  Pushed clockwise(bent(), elastic(phantom::steelFile(20)), {});
  clockwise.along(13.0, 0.01);
  Pushed back = clockwise;
  clockwise.turn(6.0, 600);
  back.turn(-6.0, 600);
  double expected_N = 0.0;
  for (std::size_t i = 1; i <= clockwise.file.chain().links; ++i) {
    const FluteFriction flutes =
        fluteFriction(0.15, 0.45, clockwise.file.chain().radius_mm[i], clockwise.file.chain().lead_mm);
    expected_N -= flutes.coupled * clockwise.file.state().normal_N[i];
  }
  EXPECT_GT(expected_N, 0.2);
  EXPECT_LT(clockwise.axial_N(), back.axial_N());
  EXPECT_NEAR(back.axial_N() - clockwise.axial_N(), 2.0 * expected_N, 0.25 * expected_N);
}

/// A thread over a round bar: EI next to nothing, pulled at one end, T = T0 e^(mu A).
TEST(FileInCanal, PulledRoundABarItObeysTheCapstan) {
  const double mu = 0.2, bar_mm = 4.0, spacing_mm = 0.04, hung_N = 0.5;
  assets::VolumeGrid grid;
  grid.spacing_mm = spacing_mm;
  grid.size = {230, 12, 230};
  grid.origin_P_mm = {-4.6, -0.24, -4.6};
  std::vector<std::uint8_t> solid(grid.voxelCount());
  assets::forVoxels(grid, [&](glm::ivec3 ijk, std::size_t v) {
    const glm::dvec3 p = grid.centre_P_mm(ijk);
    const double depth_mm = bar_mm - std::hypot(p.x, p.z);
    solid[v] = static_cast<std::uint8_t>(std::lround(255.0 * std::clamp(0.5 + depth_mm / spacing_mm, 0.0, 1.0)));
  });
  const Cubelets cubelets(grid, solid, {});
  const SolidField wall = cubelets.field();

  // Handle on the left, drawn to the left along the top; the far end hangs down on the right.
  const std::size_t links = 64;
  const FileChain chain = uniformChain(16.0, 0.02, 0.15, links);
  FileLaw law = phantom::evenFriction(mu);
  law.drag_N_per_mm2 = 0.0;
  FilePose hand;
  hand.rotation = glm::angleAxis(-std::numbers::pi / 2.0, glm::dvec3(0.0, 1.0, 0.0));
  hand.translation_mm = {-4.0, 0.0, bar_mm + 0.15};
  FileInCanal file(chain, law, {true, 0.0}, hand);
  ASSERT_NEAR(file.state().shape.direction[0].x, 1.0, 1e-12);
  PerNode<glm::dvec3> pull{};
  pull[links] = {0.0, 0.0, -hung_N};
  FileScene scene{&wall, {}, &pull};
  for (int n = 0; n < 400; ++n) file.step(hand, scene);
  // Over some voxels: each of them is a little hill.
  double drawn_N = 0.0;
  for (int n = 0; n < 500; ++n) {
    hand.translation_mm.x -= 0.005;
    const FileTick tick = file.step(hand, scene);
    if (n >= 100) drawn_N += tick.on_hand.force_N.xyz.x / 400.0;
  }
  ASSERT_LT(file.state().shape.direction[links].z, -0.999) << "it hangs";
  EXPECT_NEAR(drawn_N / hung_N / std::exp(mu * std::numbers::pi / 2.0), 1.0, 0.02);
}

TEST(FileInCanal, RestsWithTheSameForceAtOneAndFourKilohertz) {
  const auto atRest = [](int rate) {
    Pushed push(flared(), elastic(phantom::steelFile(20)), phantom::evenFriction(), FileGrip{});
    push.along(16.5, 0.01 / rate);
    for (int n = 0; n < 400; ++n) push.tick = push.file.step(push.hand, push.scene);
    EXPECT_EQ(push.unsettled, 0);
    return push.axial_N();
  };
  const double slow_N = atRest(1);
  EXPECT_GT(slow_N, 0.5);
  EXPECT_NEAR(atRest(4) / slow_N, 1.0, 0.01);
}

TEST(FileInCanal, NeverPullsHarderThanItsSpring) {
  Pushed push(bent(), phantom::steelFile(40), {}, FileGrip{});
  push.along(20.0, 0.02);
  EXPECT_LT(push.axial_N(), kFileCoupling_N_per_mm * 20.0);
  EXPECT_GT(push.axial_N(), 3.0) << "jammed";
  // One more step of the hand changes the force by the spring's stiffness at most.
  const double before_N = push.axial_N();
  push.along(0.01, 0.01);
  EXPECT_LE(push.axial_N() - before_N, 0.01 * kFileCoupling_N_per_mm + 1e-4);
}

TEST(FileInCanal, StopsAtItsWorkingLength) {
  Pushed push(bent(), phantom::steelFile(15), {}, FileGrip{});
  push.scene.stop = RubberStop{14.0, {0.0, 0.0, 0.0}, {0.0, 0.0, 1.0}};
  push.along(18.0, 0.01);
  const double tip_mm = bent().canal.nearest_mm(push.file.state().shape.node_mm[push.file.chain().links]);
  EXPECT_GT(push.tick.stop_N, 1.0);
  EXPECT_NEAR(tip_mm, 14.0, 0.1) << "the ring gives by force over 50 N/mm";
  EXPECT_NEAR(push.axial_N(), 0.8 * (18.0 - 14.05), 0.3);
}

TEST(FileInCanal, BreaksWhereItsTorqueIsTooLarge) {
  FileChain chain = phantom::steelFile(10);
  Pushed push(bent(), chain, {}, FileGrip{});
  push.along(14.0, 0.01);
  EXPECT_FALSE(push.file.fragment());
  // Locked by a friction that no file has.
  FileLaw locked;
  locked.friction_along = locked.friction_across = 40.0;
  Pushed stuck(bent(), chain, locked, {true, 0.0});
  stuck.along(15.0, 0.005);
  for (int n = 0; n < 3000 && !stuck.file.fragment(); ++n) {
    const double share = stuck.tick.torque_share;
    stuck.turn(0.02, 1);
    if (stuck.file.fragment()) {
      EXPECT_GT(share, 0.9);
    }
  }
  ASSERT_TRUE(stuck.file.fragment());
  const FileFragment& left = *stuck.file.fragment();
  EXPECT_GT(left.from_tip_mm, 0.0);
  EXPECT_NEAR(left.from_tip_mm + stuck.file.chain().length_mm(), 21.0, 1e-9);
  EXPECT_FALSE(stuck.file.step(stuck.hand, stuck.scene).refused) << "what is left goes on";
}

TEST(FileInCanal, TurnedInACurveItBreaksAfterItsTurns) {
  // Constant strain: the sum of turns over turns to break is one at that number.
  const FileMetal metal = fileMetal(assets::KFileMetal::nickel_titanium);
  EXPECT_DOUBLE_EQ(turnsToBreak(metal, 0.05), 400.0);
  EXPECT_GT(turnsToBreak(metal, 0.02), turnsToBreak(metal, 0.05)) << "a wider curve";
  // A thicker file of the same curve, a narrower curve of the same file.
  Pushed push(bent(), elastic(phantom::steelFile(20)), phantom::evenFriction(), {true, 0.0});
  push.along(14.5, 0.01);
  push.turn(2.0 * std::numbers::pi, 400);
  const double strain = push.tick.strain, damage = push.file.state().damage[32];
  double worst = 0.0;
  std::size_t where = 0;
  for (std::size_t i = 1; i <= 32; ++i)
    if (push.file.state().damage[i] > worst) worst = push.file.state().damage[i], where = i;
  EXPECT_NEAR(worst * turnsToBreak(push.file.chain().metal, strain), 1.0, 0.15) << "a turn, less its wind-up";
  EXPECT_LT(damage, worst);
  const double along_mm = bent().canal.nearest_mm(push.file.state().shape.node_mm[where]);
  EXPECT_GT(along_mm, 10.0) << "in the curve";
}

struct Wandered {
  int unsettled = 0, reverted = 0, rose = 0, most_steps = 0;
  double work_Nmm = 0.0, least_work_Nmm = 0.0, strongest_N = 0.0;
  double last_energy_Nmm = 0.0;
};

Wandered wander(const CanalWall& canal, const assets::KFile& of, unsigned seed, int ticks) {
  const FileChain chain = fileChain(of, kUsualLinks);
  const FilePose start = phantom::above(chain, -1.0);
  FileInCanal file(chain, {}, {}, start);
  FileScene scene;
  scene.wall = &canal.wall;
  phantom::WanderingHand hand(seed, start, 16.0);
  Wandered found;
  glm::dvec3 last_N(0.0), last_mm = start.translation_mm;
  for (int n = 0; n < ticks; ++n) {
    const FilePose at = hand.next();
    const FileTick tick = file.step(at, scene);
    EXPECT_TRUE(std::isfinite(tick.energy_Nmm)) << n;
    found.unsettled += tick.unsettled ? 1 : 0;
    found.reverted += tick.reverted ? 1 : 0;
    found.rose += tick.energy_Nmm > tick.started_Nmm + 1e-7 ? 1 : 0;
    found.most_steps = std::max(found.most_steps, tick.steps);
    const glm::dvec3 force_N = tick.on_hand.force_N.xyz;
    found.strongest_N = std::max(found.strongest_N, glm::length(force_N));
    last_N = force_N;
    last_mm = at.translation_mm;
  }
  return found;
}

TEST(FileInCanal, ComesToRestInEveryTickOfWanderingHands) {
  unsigned seed = 1;
  for (const int size : {8, 15, 25, 40})
    for (const auto metal : {assets::KFileMetal::steel, assets::KFileMetal::nickel_titanium}) {
      const Wandered found = wander(flared(), *assets::kFile(size, 25, metal), ++seed, 4000);
      EXPECT_EQ(found.unsettled, 0) << size;
      EXPECT_EQ(found.reverted, 0) << size;
      EXPECT_EQ(found.rose, 0) << size << ": the energy of a tick never rises";
      EXPECT_LE(found.most_steps, kMostFileSteps) << size;
      EXPECT_GT(found.strongest_N, 0.01) << size;
      EXPECT_LT(found.strongest_N, 20.0) << size;
    }
}

/// To and fro on one way the hand loses work, and never gains: friction.
TEST(FileInCanal, GivesTheHandNoWork) {
  Pushed push(bent(), elastic(phantom::steelFile(20)), {}, FileGrip{});
  push.along(13.0, 0.01);
  double work_Nmm = 0.0;
  for (int stroke = 0; stroke < 6; ++stroke) {
    double by_stroke_Nmm = 0.0;
    for (const double way_mm : {-0.01, 0.01})
      for (int n = 0; n < 150; ++n) {
        const double before_N = push.axial_N();
        push.along(way_mm, 0.01);
        by_stroke_Nmm += 0.5 * (before_N + push.axial_N()) * way_mm;
      }
    if (stroke > 0) {
      EXPECT_GT(by_stroke_Nmm, 0.0) << stroke;
    }
    work_Nmm += by_stroke_Nmm;
  }
  EXPECT_GT(work_Nmm, 0.1);
}

TEST(FileInCanal, RefusesAHandThatIsNoNumber) {
  Pushed push(bent(), phantom::steelFile(15), {}, FileGrip{});
  push.along(5.0, 0.05);
  const ChainShape before = push.file.state().shape;
  FilePose nowhere = push.hand;
  nowhere.translation_mm.x = std::nan("");
  EXPECT_TRUE(push.file.step(nowhere, push.scene).refused);
  nowhere = push.hand;
  nowhere.rotation = glm::dquat(0.0, 0.0, 0.0, 0.0);
  EXPECT_TRUE(push.file.step(nowhere, push.scene).refused);
  EXPECT_EQ(before.node_mm, push.file.state().shape.node_mm);
}

TEST(FileInCanal, AllocatesNothing) {
  const FileChain chain = phantom::steelFile(25);
  const FilePose start = phantom::above(chain, -1.0);
  FileInCanal file(chain, {}, {}, start);
  FileScene scene;
  scene.wall = &flared().wall;
  phantom::WanderingHand hand(5, start, 14.0);
  const std::size_t before = allocation_count::now();
  double sum_N = 0.0;
  for (int n = 0; n < 3000; ++n) sum_N += file.step(hand.next(), scene).normal_N;
  EXPECT_EQ(allocation_count::now(), before);
  EXPECT_GT(sum_N, 1.0);
}

/// The same bits from every instruction set and wherever a block lies, and the values of a slow and obvious sum.
TEST(WallKernels, AgreeWithEachOtherAndWithAPlainSum) {
  const CanalWall& canal = flared();
  const SolidField& field = canal.wall;
  const phantom::ShuffledBlocks shuffled(field, 8);
  const auto wallOf = [](const SolidField& of) {
    return WallVoxels{of.slot_of,
                      of.solid,
                      {of.grid.size.x, of.grid.size.y, of.grid.size.z},
                      {of.blocks.x, of.blocks.y, of.blocks.z}};
  };
  const WallVoxels wall = wallOf(field), indexed = wallOf(shuffled.field());
  std::mt19937 random(7);
  std::uniform_real_distribution<double> share(-0.15, 1.15), unit(-1.0, 1.0);
  int met = 0;
  for (int trial = 0; trial < 3000; ++trial) {
    SectionRays rays{};
    for (int axis = 0; axis < 3; ++axis) rays.centre[axis] = static_cast<float>(share(random) * field.grid.size[axis]);
    for (int n = 0; n < kRays; ++n) {
      const glm::dvec3 way = glm::normalize(glm::dvec3(unit(random), unit(random), unit(random)) + 1e-3);
      for (int axis = 0; axis < 3; ++axis) rays.along[axis][n] = static_cast<float>(way[axis]);
    }
    rays.radius = static_cast<float>(1.0 + 9.0 * std::abs(unit(random)));
    rays.step = 1.0F;
    rays.flat_face = 0.23F;
    rays.samples = 6;
    RayDepths found{};
    const bool hit = portable::castRays(wall, rays, found);
    met += hit ? 1 : 0;
    for (int n = 0; n < kRays; n += 5) {
      double depth = -0.23;
      for (int m = 0; m < 6 && static_cast<double>(rays.radius) - m >= 0.0; ++m) {
        double value = 0.0;
        glm::dvec3 at, weight[3];
        glm::ivec3 nearest;
        for (int axis = 0; axis < 3; ++axis) {
          at[axis] = static_cast<double>(rays.centre[axis]) +
                     (static_cast<double>(rays.radius) - m) * static_cast<double>(rays.along[axis][n]);
          nearest[axis] = std::clamp(static_cast<int>(std::lround(at[axis])), 1, field.grid.size[axis] - 2);
          const double t = at[axis] - nearest[axis];
          weight[0][axis] = 0.5 * (0.5 - t) * (0.5 - t);
          weight[2][axis] = 0.5 * (0.5 + t) * (0.5 + t);
          weight[1][axis] = 1.0 - weight[0][axis] - weight[2][axis];
        }
        // At the grid's border the outermost cell goes on by half a voxel.
        const glm::dvec3 end(field.grid.size - 1);
        const bool is_inside = glm::all(glm::greaterThan(at, glm::dvec3(0.0))) && glm::all(glm::lessThan(at, end));
        for (int v = 0; is_inside && v < 27; ++v) {
          const glm::ivec3 off(v % 3, v / 3 % 3, v / 9);
          value += weight[off.x].x * weight[off.y].y * weight[off.z].z * field.solidAt(nearest + off - 1) / 255.0;
        }
        if (value <= 0.0) break;
        depth += (m == 0 ? 0.5 : 1.0) * value;
      }
      EXPECT_NEAR(static_cast<double>(found.depth[n]), depth, 2e-3) << trial << ", ray " << n;
    }
    RayDepths other{};
    EXPECT_EQ(portable::castRays(indexed, rays, other), hit);
    EXPECT_EQ(std::memcmp(&found, &other, sizeof found), 0) << trial;
#if defined(__x86_64__)
    for (const WallVoxels& blocks : {wall, indexed}) {
      if (assets::available(assets::InstructionSet::avx2)) {
        EXPECT_EQ(avx2::castRays(blocks, rays, other), hit);
        EXPECT_EQ(std::memcmp(&found, &other, sizeof found), 0) << trial;
      }
      if (assets::available(assets::InstructionSet::avx512)) {
        EXPECT_EQ(avx512::castRays(blocks, rays, other), hit);
        EXPECT_EQ(std::memcmp(&found, &other, sizeof found), 0) << trial;
      }
    }
#endif
  }
  EXPECT_GT(met, 300);
}

}  // namespace
}  // namespace haptics
