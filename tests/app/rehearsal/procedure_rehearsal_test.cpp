#include <filesystem>
#include <fstream>

#include <gtest/gtest.h>

#include "app/rehearsal/rehearsal.h"
#include "tests/app/session/real_session.h"
#include "tests/scratch_folder.h"

namespace app {
namespace {

/// Handles every request and records every tick.
class Witness final : public Procedure {
 public:
  bool take(const ControlRequest& request) override {
    taken.push_back(request.control);
    return true;
  }
  std::optional<haptics::Command> follow(std::span<const haptics::Tick> ticks) override {
    EXPECT_FALSE(ticks.empty());
    for (const haptics::Tick& tick : ticks) {
      EXPECT_GT(tick.dt_s, 0.0) << "a real tick";
      indices.push_back(tick.index);
    }
    return std::nullopt;
  }
  ProcedureMessages messages() const override { return {}; }
  bool isOver() const override { return false; }

  std::vector<std::uint64_t> indices;
  std::vector<Control> taken;
};

TEST(ProcedureRehearsal, PassesEveryTickOnceAndEndsOnRequestDespiteTheProcedure) {
  const tests::ScratchFolder folder;
  const std::string poses = folder.file("p.csv");
  std::ofstream(poses) << "t_s,px_mm,py_mm,pz_mm,qw,qx,qy,qz,drill,action\n0,0,0,9,1,0,0,0,0,\n"
                          "0.1,0,0,9,1,0,0,0,0,undo\n0.3,0,0,9,1,0,0,0,0,end\n1,0,0,9,1,0,0,0,0,\n";
  const test::BoneBlock block;
  Witness witness;
  RehearsalPlan plan;
  plan.patient.ct.grid = block.grid;
  plan.patient.ct.solid = block.solid;
  plan.patient.ct.label = block.label;
  plan.rig = calibration::desktopRig({64, 48});
  plan.device = "poses:" + poses;
  plan.headless = true;
  plan.ticking = Ticking::stepped;
  plan.procedure = &witness;
  EXPECT_EQ(rehearse(std::move(plan)), 0);
  EXPECT_EQ(witness.taken, std::vector<Control>({Control::undo}));
  ASSERT_GE(witness.indices.size(), 280u) << "all but those of the last frame";
  for (std::size_t n = 0; n < witness.indices.size(); ++n) ASSERT_EQ(witness.indices[n], n);
}

}  // namespace
}  // namespace app
