#include "app/procedure/socket/socket_watch.h"

#include <gtest/gtest.h>

#include "tests/app/case/block_with_molar.h"

namespace app {
namespace {

struct Operation {
  assets::Patient patient = test::blockWithMolar();
  haptics::Bodies bodies;
  SocketWatch watch;
  haptics::Tick tick;

  Operation()
      : patient(numbered()),
        bodies(patient.ct.grid, patient.ct.solid, patient.ct.label, assets::voxelsOfTooth(patient.ct, 48)),
        watch(patient, patient.ct.solid, bodies) {
    tick.pieces = 1;
    tick.dt_s = 0.001;
  }
  static assets::Patient numbered() {
    assets::Patient patient = test::blockWithMolar();
    assets::numberSingleTooth(patient.ct, 48);
    return patient;
  }
  void look() {
    tick.X_PQ[0] = bodies.pose(0);
    tick.t_s += 2.0;
    watch.follow({}, tick, true);
  }
};

TEST(SocketWatch, LooksFromTheMomentAPieceIsOut) {
  Operation operation;
  operation.look();
  EXPECT_FALSE(operation.watch.newest());
  operation.bodies.setAside(0);
  operation.look();
  ASSERT_TRUE(operation.watch.newest());
  EXPECT_TRUE(operation.watch.newest()->record.retained.empty());
}

TEST(SocketWatch, APieceThatIsPutBackMakesItSilent) {
  Operation operation;
  operation.bodies.setAside(0);
  operation.look();
  operation.bodies.place(0, {});
  operation.look();
  EXPECT_FALSE(operation.watch.newest());
}

TEST(SocketWatch, FollowsTheBoneByItsBricks) {
  Operation operation;
  operation.bodies.setAside(0);
  operation.look();
  const double before_mm = sumOf(operation.watch.newest()->record.edges);
  std::vector<glm::ivec3> bricks;
  operation.bodies.takeDirtyBricks(bricks);
  // A trench along the crest beside the socket: two edges more.
  haptics::ErosionStep all;
  all.loss.fill(1.0);
  const haptics::BurShape head{haptics::ShapeKind::cylinder, 3.0, 16.0};
  haptics::carveTool(operation.bodies, head, {{1.0, 0.0, 0.0, 0.0}, {-4.0, 40.0, 0.0}}, all, 1);
  bricks.clear();
  operation.bodies.takeDirtyBricks(bricks);
  ASSERT_FALSE(bricks.empty());
  operation.tick.t_s += 2.0;
  operation.watch.follow(bricks, operation.tick, true);
  EXPECT_GT(sumOf(operation.watch.newest()->record.edges), before_mm + 5.0);
}

TEST(SocketWatch, APieceThatStaysIsRetained) {
  Operation operation;
  operation.bodies.setAside(0);
  operation.look();
  // Another piece, still in its place.
  operation.tick.pieces = 2;
  const haptics::CarvedBone& tooth = operation.bodies.bones()[1];
  for (std::size_t block = 0; block < tooth.blocks() / 2; ++block) {
    const haptics::BlockState state = tooth.stateOf(block);
    operation.bodies.place(0, {});
    operation.bodies.moveBlock(0, 1, block, state.solid);
  }
  operation.bodies.setAside(0);
  operation.tick.X_PQ[1] = operation.bodies.pose(1);
  operation.look();
  ASSERT_EQ(operation.watch.newest()->record.retained.size(), 1u);
  EXPECT_GT(operation.watch.newest()->record.retained[0].amount, 100.0);
}

}  // namespace
}  // namespace app
