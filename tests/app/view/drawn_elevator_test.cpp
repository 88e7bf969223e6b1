// The elevator that is drawn has the blade that is felt.

#include <gtest/gtest.h>

#include <cmath>

#include "assets/instrument/elevator.h"
#include "haptics/ligament/elevator_shape.h"
#include "tests/assets/instrument/part_named.h"

namespace app {
namespace {

struct Pair {
  assets::ElevatorForm drawn;
  haptics::ElevatorKind felt;
  bool is_straight;
};

TEST(DrawnElevator, HasTheBladeThatIsFelt) {
  for (const Pair& pair : {Pair{assets::ElevatorForm::straight_301, haptics::ElevatorKind::straight_301, true},
                           {assets::ElevatorForm::straight_34s, haptics::ElevatorKind::straight_34s, true},
                           {assets::ElevatorForm::cryer_left, haptics::ElevatorKind::cryer_left, false},
                           {assets::ElevatorForm::cryer_right, haptics::ElevatorKind::cryer_right, false}}) {
    const haptics::ElevatorShape& shape = haptics::elevatorShape(pair.felt);
    const assets::MeshModel model = assets::elevator(pair.drawn);
    int seen = 0;
    for (const glm::vec3& p : ::tests::partNamed(model, "Blade").position_mm) {
      // Where it goes over into the shank the drawn one is smooth.
      if (pair.is_straight ? p.z > 7.0f : std::abs(p.x) < 2.5f) continue;
      EXPECT_LT(std::abs(shape.distanceAt(glm::dvec3(p)).mm), 0.15)
          << static_cast<int>(pair.felt) << ": " << p.x << " " << p.y << " " << p.z;
      ++seen;
    }
    EXPECT_GT(seen, 100);
  }
}

}  // namespace
}  // namespace app
