#include <algorithm>
#include <fstream>
#include <map>
#include <tuple>
#include <vector>

#include <nlohmann/json.hpp>

#include "app/device/practice_device.h"
#include "app/session/session_reader.h"
#include "calibration/record/rig_file.h"
#include "calibration/record/rig_store.h"
#include "tests/app/commands/program.h"

namespace app {
namespace {

/// A coarse patient for speed; with the build's own cache.
class RehearseCommand : public ProgramTest {
 protected:
  void SetUp() override {
    ProgramTest::SetUp();
    setenv("XDG_CACHE_HOME", MOLAR_TEST_CACHE, 1);
    setenv("MOLAR_CALIBRATION", at("store").c_str(), 1);
  }

  std::vector<std::filesystem::path> savedPictures() const {
    std::vector<std::filesystem::path> found;
    std::error_code none;
    for (const auto& entry : std::filesystem::directory_iterator(dataFolder() + "/molar/pictures", none))
      found.push_back(entry.path());
    return found;
  }
};

constexpr char kQuick[] = "rehearse --headless --pace fast --voxel 0.6 --size 96x64 ";
constexpr char kCoarse[] = "rehearse --headless --pace fast --device scripted --voxel 0.6 --size 96x64 ";
constexpr char kPoseHeader[] = "t_s,px_mm,py_mm,pz_mm,qw,qx,qy,qz,drill,tool,action\n";

std::vector<haptics::Tick> ticksOf(const std::string& session) {
  SessionReader reader(session);
  std::vector<haptics::Tick> all;
  for (TickBlock block = reader.nextBlock(); !block.ticks.empty(); block = reader.nextBlock())
    all.insert(all.end(), block.ticks.begin(), block.ticks.end());
  return all;
}

/// Every column of a tick, bit for bit as far as == sees it.
auto columns(const haptics::Tick& t) {
  const haptics::HandSample& h = t.hand;
  return std::tuple(t.index, t.t_s, t.dt_s, t.command_serial, h.X_PT.translation_mm, h.X_PT.rotation,
                    h.velocity_P_mm_per_s.xyz, h.handle_velocity_P_mm_per_s.xyz, h.arm_P_mm.xyz, h.jacobian_P_mm,
                    h.motor_heat, h.gap_s, h.drill_pedal, h.fresh, h.docked, h.held, h.calibrated, t.proxy_P.mm,
                    t.law_force_P_N.xyz, t.law_torque_P_Nmm.xyz, t.commanded_force_P_N.xyz,
                    t.commanded_torque_P_Nmm.xyz, t.energy_Nmm, t.spindle_rad_per_s, t.overlap_mm3, t.depth_mm,
                    t.removed_mm3, t.bone_digest, t.contact_tissue, t.drilling, t.drill_inhibit, t.strokes, t.state,
                    t.faults, t.work_us);
}

TEST_F(RehearseCommand, RecordingReplaysBitForBit) {
  const ProgramOutput said = molar(kCoarse + std::string("--seconds 4 --record ") + at("s.molar"));
  ASSERT_EQ(said.status, 0) << said.err;
  EXPECT_NE(said.out.find("removed"), std::string::npos);
  const ProgramOutput replay = molar("replay " + at("s.molar") + " --verify");
  EXPECT_EQ(replay.status, 0) << replay.out << replay.err;
  const ProgramOutput metrics = molar("metrics " + at("s.molar") + " --json");
  ASSERT_EQ(metrics.status, 0) << metrics.err;
  const auto json = nlohmann::json::parse(metrics.out);
  EXPECT_NEAR(json.at("duration_s").get<double>(), 4.0, 1e-6);
  EXPECT_EQ(json.at("ticks").get<int>(), 4000);
  EXPECT_GT(json.at("removed_mm3").get<double>(), 1.0) << "the scripted tool carves";
  EXPECT_LE(json.at("max_force_N").get<double>(), 3.3 + 1e-9);

  // Any changed byte is found.
  std::string bytes = read("s.molar");
  bytes[bytes.size() / 2] = static_cast<char>(bytes[bytes.size() / 2] ^ 1);
  write("t.molar", bytes);
  EXPECT_NE(molar("replay " + at("t.molar") + " --verify").status, 0);
}

TEST_F(RehearseCommand, MakesTheSameTicksTwiceAtFastPace) {
  write("p.csv", std::string(kPoseHeader) + "0,0,0,6,1,0,0,0,0,,\n0.4,0,0,1,1,0,0,0,1,,\n1.5,2,0,-3,1,0,0,0,1,,\n");
  for (const char* device : {"scripted", "simulated:touch", "poses"}) {
    const std::string hand = device == std::string("poses") ? "poses:" + at("p.csv") : device;
    std::vector<std::vector<haptics::Tick>> runs;
    for (const char* name : {"one.molar", "two.molar"}) {
      const ProgramOutput said = molar(kQuick + ("--force --seconds 3 --device " + hand + " --record " + at(name)));
      ASSERT_EQ(said.status, 0) << said.err;
      EXPECT_NE(said.out.find("3000 ticks, 0 lost"), std::string::npos) << said.out;
      runs.push_back(ticksOf(at(name)));
    }
    ASSERT_EQ(runs[0].size(), 3000u) << device;
    ASSERT_EQ(runs[1].size(), 3000u) << device;
    for (std::size_t i = 0; i < runs[0].size(); ++i) {
      ASSERT_EQ(columns(runs[0][i]), columns(runs[1][i])) << device << " tick " << i;
      ASSERT_EQ(runs[0][i].work_us, 0.0f) << "independent of the clock";
    }
  }
}

TEST_F(RehearseCommand, LosesNoTickOfALongRunAtFastPace) {
  const ProgramOutput said = molar(kCoarse + std::string("--seconds 60 --rate 2000 --record ") + at("s.molar"));
  ASSERT_EQ(said.status, 0) << said.err;
  EXPECT_NE(said.out.find("120000 ticks, 0 lost"), std::string::npos) << said.out;
}

TEST_F(RehearseCommand, FollowsPosesAndRequestsAtTheirTicks) {
  // Far from the tissue: what it asks for shows in the commands alone.
  std::string rows = kPoseHeader;
  rows += "0,100,0,200,1,0,0,0,0,,irrigation:off\n";
  rows += "0.25,100,10,200,0.8,0.6,0,0,1,2,\n";
  rows += "0.5,101,10,200,1,0,0,0,0,sphere:1.5,drill:off\n";
  rows += "0.75,101,10,203,1,0,0,0,0,,irrigation:on\n";
  write("p.csv", rows);
  const ProgramOutput said = molar(
      kQuick + ("--tool sphere:1.5 --tool sphere:1 --device poses:" + at("p.csv") + " --record " + at("s.molar")));
  ASSERT_EQ(said.status, 0) << said.err;
  const std::vector<haptics::Tick> ticks = ticksOf(at("s.molar"));
  ASSERT_EQ(ticks.size(), 751u) << "the last row's tick is the last";
  EXPECT_EQ(ticks[250].hand.X_PT.translation_mm, glm::dvec3(100, 10, 200));
  EXPECT_NEAR(glm::dot(ticks[250].hand.X_PT.rotation, glm::dquat(0.8, 0.6, 0, 0)), 1.0, 1e-12);
  EXPECT_LT(glm::distance(ticks[125].hand.X_PT.translation_mm, glm::dvec3(100, 5, 200)), 1e-9);
  EXPECT_FALSE(ticks[249].hand.drill_pedal);
  EXPECT_TRUE(ticks[250].hand.drill_pedal);
  EXPECT_FALSE(ticks[500].hand.drill_pedal);

  const std::vector<SessionCommand> commands = SessionReader(at("s.molar")).commands();
  std::map<std::uint64_t, haptics::Command> at_tick;
  for (const SessionCommand& one : commands) at_tick[one.first_tick] = one.command;
  ASSERT_TRUE(at_tick.contains(0) && at_tick.contains(250) && at_tick.contains(500) && at_tick.contains(750));
  EXPECT_FALSE(at_tick[0].irrigating);
  EXPECT_EQ(at_tick[250].tool.head.radius_mm, 1.0);
  EXPECT_EQ(at_tick[500].tool.head.radius_mm, 1.5);
  EXPECT_FALSE(at_tick[500].drill_enabled);
  EXPECT_TRUE(at_tick[750].irrigating);
  EXPECT_EQ(molar("replay " + at("s.molar") + " --verify").status, 0);
}

/// Far from the tissue, with four instruments; the wanted one lies to the left on the screen of the built-in patient.
constexpr char kTray[] = "--tool sphere:1.5 --tool sphere:1 --tool forceps --tool elevator:301 ";

TEST_F(RehearseCommand, TheStylusAloneTakesAnInstrumentFromTheRing) {
  // Held, moved, let go; then a short press, which changes to the next; then held and let go in the middle.
  std::string rows = "t_s,px_mm,py_mm,pz_mm,qw,qx,qy,qz,drill,button\n";
  rows += "0,-28,49,60,1,0,0,0,0,0\n0.2,-28,49,60,1,0,0,0,0,1\n0.7,-28,49,60,1,0,0,0,1,1\n";
  rows += "0.9,-48,49,60,1,0,0,0,1,1\n1,-48,49,60,1,0,0,0,1,0\n1.5,-48,49,60,1,0,0,0,0,0\n";
  rows += "2,-48,49,60,1,0,0,0,0,1\n2.1,-48,49,60,1,0,0,0,0,0\n";
  rows += "3,-48,49,60,1,0,0,0,0,1\n3.6,-48,49,60,1,0,0,0,0,0\n4,-48,49,60,1,0,0,0,0,0\n";
  write("p.csv", rows);
  const ProgramOutput said = molar(kQuick + (kTray + ("--device poses:" + at("p.csv") + " --record " + at("s.molar"))));
  ASSERT_EQ(said.status, 0) << said.err;
  std::vector<std::pair<std::uint64_t, haptics::Command>> changes;
  for (const SessionCommand& one : SessionReader(at("s.molar")).commands())
    changes.emplace_back(one.first_tick, one.command);
  const auto inForce = [&](std::uint64_t tick) {
    haptics::Command command;
    for (const auto& [first, one] : changes)
      if (first <= tick) command = one;
    return command;
  };
  EXPECT_FALSE(inForce(450).hands_off) << "it may be a short press";
  EXPECT_TRUE(inForce(600).hands_off);
  EXPECT_FALSE(inForce(600).tool.isElevator());
  EXPECT_TRUE(inForce(990).hands_off);
  EXPECT_FALSE(inForce(1100).hands_off);
  EXPECT_TRUE(inForce(1100).tool.isElevator()) << "to the left is the fourth of four";
  EXPECT_TRUE(inForce(2050).tool.isElevator());
  EXPECT_EQ(inForce(2200).tool.head.radius_mm, 1.5) << "a short press: the next of the tray";
  EXPECT_TRUE(inForce(3500).hands_off);
  EXPECT_FALSE(inForce(3900).hands_off);
  EXPECT_EQ(inForce(3900).tool.head.radius_mm, 1.5) << "let go in the middle";
  for (const haptics::Tick& tick : ticksOf(at("s.molar"))) EXPECT_FALSE(tick.drilling) << tick.t_s;
  EXPECT_EQ(molar("replay " + at("s.molar") + " --verify").status, 0);
}

TEST_F(RehearseCommand, AScriptOpensAndClosesTheRing) {
  std::string rows = kPoseHeader;
  rows +=
      "0,-28,49,60,1,0,0,0,0,,\n0.1,-28,49,60,1,0,0,0,0,,ring:on\n0.4,-8,49,60,1,0,0,0,0,,ring:off\n0.5,-8,49,60,1,0,0,"
      "0,0,,ring\n";
  rows += "0.8,-8,49,60,1,0,0,0,0,,tool:3\n1,-8,49,60,1,0,0,0,0,,\n";
  write("p.csv", rows);
  const ProgramOutput said = molar(kQuick + (kTray + ("--device poses:" + at("p.csv") + " --record " + at("s.molar"))));
  ASSERT_EQ(said.status, 0) << said.err;
  const std::vector<SessionCommand> commands = SessionReader(at("s.molar")).commands();
  std::vector<std::tuple<std::uint64_t, bool, double>> seen;
  for (const SessionCommand& one : commands)
    seen.emplace_back(one.first_tick, one.command.hands_off, one.command.tool.head.radius_mm);
  EXPECT_FALSE(commands.back().command.hands_off) << "another change of tool closes it";
  EXPECT_TRUE(commands.back().command.tool.grips);
  const auto taken = std::ranges::find_if(commands, [](const SessionCommand& one) { return one.first_tick == 400; });
  ASSERT_NE(taken, commands.end());
  EXPECT_EQ(commands[static_cast<std::size_t>(taken - commands.begin())].command.tool.head.radius_mm, 1.0)
      << "to the right is the second";
  const ProgramOutput one_tool = molar(kQuick + ("--tool sphere:1 --device poses:" + at("p.csv")));
  EXPECT_NE(one_tool.status, 0) << "tool 3 is not on that tray";
}

TEST_F(RehearseCommand, NamesTheRowOfAnInvalidRequest) {
  const auto refused = [&](const std::string& row, const std::string& word) {
    write("p.csv", std::string(kPoseHeader) + "0,0,0,9,1,0,0,0,0,,\n" + row + "\n");
    expectRefusal(kQuick + ("--device poses:" + at("p.csv")), word);
  };
  refused("1,0,0,9,1,0,0,0,0,9,", "line 3: tool 9: the tray holds 8");
  refused("1,0,0,9,1,0,0,0,0,,jump", "line 3: ");
  refused("1,0,0,9,1,0,0,0,0,,tool:12", "line 3: tool 12: the tray holds 8");
  refused("1,0,0,9,2,0,0,0,0,,", "line 3: the quaternion");
  refused("0,0,0,9,1,0,0,0,0,,", "line 3: t_s does not rise");
  refused("4000,0,0,9,1,0,0,0,0,,", "line 3: t_s is beyond an hour");
  expectRefusal(kQuick + ("--device poses:" + folder_.string()), "plain file");
  expectRefusal(kQuick + ("--device poses:" + at("none.csv")), "none.csv");
}

// Far from any bone the bur's tip marks: 3 mm across and 4 mm up are 5 mm.
TEST_F(RehearseCommand, MeasuresWithTheRulerAndRecordsIt) {
  write("p.csv", std::string(kPoseHeader) +
                     "0,100,0,200,1,0,0,0,0,,\n0.1,100,0,200,1,0,0,0,0,,ruler\n"
                     "0.2,103,0,204,1,0,0,0,0,,\n0.3,103,0,204,1,0,0,0,0,,ruler\n"
                     "0.4,103,0,204,1,0,0,0,0,,ruler\n0.5,103,0,204,1,0,0,0,0,,\n");
  const ProgramOutput said =
      molar(kQuick + ("--device poses:" + at("p.csv") + " --tool round:3.0 --record " + at("ruler.molar")));
  ASSERT_EQ(said.status, 0) << said.err;
  const ProgramOutput metrics = molar("metrics " + at("ruler.molar") + " --json");
  ASSERT_EQ(metrics.status, 0) << metrics.err;
  const auto measured = nlohmann::json::parse(metrics.out)["measured"];
  ASSERT_EQ(measured.size(), 1u) << metrics.out;
  EXPECT_NEAR(measured[0]["mm"].get<double>(), 5.0, 1e-9);
  EXPECT_NEAR(measured[0]["t_s"].get<double>(), 0.3, 0.03);
  EXPECT_EQ(measured[0]["words"], "5.00 mm from (100.00, 0.00, 198.50) to (103.00, 0.00, 202.50) mm");
  EXPECT_NE(molar("metrics " + at("ruler.molar")).out.find("measured at 0:00: 5.00 mm from"), std::string::npos);
}

TEST_F(RehearseCommand, TakesThePositionFromTheRigUnlessAskedForAnother) {
  const std::string rig = calibration::rigText(calibration::desktopRig({96, 64}, 130.0));
  write("plain.yaml", rig);
  write("left.yaml", rig + "patient:\n   position: \"left\"\n");
  write("odd.yaml", rig + "patient:\n   position: \"standing\"\n");
  const auto picture = [&](const std::string& options) {
    const ProgramOutput said = molar(kQuick + std::string("--device scripted --seconds 0.1 --renderer cpu --force ") +
                                     "--snapshot-size 96x64 --first-snapshot " + at("p.png") + " " + options);
    EXPECT_EQ(said.status, 0) << said.err;
    return std::pair(read("p_left.png"), said.err);
  };
  const auto seated = picture("--rig " + at("plain.yaml")), kept = picture("--rig " + at("left.yaml")),
             asked = picture("--position left --rig " + at("plain.yaml")),
             other = picture("--position seated --rig " + at("left.yaml"));
  EXPECT_TRUE(kept.first == asked.first) << "as the rig says";
  EXPECT_FALSE(kept.first == seated.first);
  EXPECT_TRUE(other.first == seated.first) << "as asked for";
  EXPECT_NE(other.second.find("are set up for left"), std::string::npos) << other.second;
  expectRefusal(kQuick + ("--device scripted --rig " + at("odd.yaml")), "standing");
}

/// What stands after a name in a text of lines.
std::string wordsAfter(const std::string& text, const std::string& name) {
  const std::size_t at = text.find(name);
  if (at == std::string::npos) return "";
  const std::size_t from = text.find_first_not_of(' ', at + name.size());
  return text.substr(from, text.find('\n', from) - from);
}

TEST_F(RehearseCommand, TheSummaryAndTheRecordingTellTheSameTouches) {
  const ProgramOutput said = molar(kCoarse + std::string("--record ") + at("touched.molar"));
  ASSERT_EQ(said.status, 0) << said.err;
  const std::string touched = wordsAfter(said.out, "\n  touched ");
  EXPECT_NE(touched.find("lower right third molar"), std::string::npos) << said.out;
  EXPECT_EQ(wordsAfter(molar("metrics " + at("touched.molar")).out, "\ntouched:"), touched);
  const auto json = nlohmann::json::parse(molar("metrics " + at("touched.molar") + " --json").out);
  ASSERT_FALSE(json["touched"].empty());
  EXPECT_EQ(json["touched"][0]["what"], "lower right third molar");
  EXPECT_GT(json["touched"][0]["contact_s"].get<double>(), 0.0);
}

TEST_F(RehearseCommand, ExecutesTheLastRowInRealTimeToo) {
  write("p.csv", std::string(kPoseHeader) + "0,100,0,200,1,0,0,0,0,,\n0.3,100,0,200,1,0,0,0,0,2,snapshot\n");
  const std::string line = "cd " + folder_.string() + " && " + MOLAR_PROGRAM +
                           " rehearse --headless --voxel 0.6 --size 96x64 --renderer cpu --tool sphere:1.5 --tool "
                           "sphere:1 --device poses:p.csv --record s.molar >out 2>err";
  ASSERT_EQ(std::system(line.c_str()), 0) << read("err");
  EXPECT_EQ(savedPictures().size(), 1u) << read("err");
  for (const auto& entry : std::filesystem::directory_iterator(folder_)) EXPECT_NE(entry.path().extension(), ".png");
  const std::vector<SessionCommand> commands = SessionReader(at("s.molar")).commands();
  ASSERT_FALSE(commands.empty());
  EXPECT_EQ(commands.back().command.tool.head.radius_mm, 1.0);
  EXPECT_EQ(ticksOf(at("s.molar")).back().command_serial, commands.back().command.serial) << "in force for a tick";
}

TEST_F(RehearseCommand, SavesAPictureAtFullQualityWhateverTheLiveQuality) {
  write("p.csv", std::string(kPoseHeader) +
                     "0,0,0,9,1,0,0,0,0,,\n0.2,0,0,6,1,0,0,0,0,,snapshot\n"
                     "0.2005,0,0,6,1,0,0,0,0,,\n0.3,0,0,6,1,0,0,0,0,,\n");
  const auto picture_at = [&](const std::string& quality) {
    const ProgramOutput said = molar(kQuick + ("--no-record --renderer cpu --device poses:" + at("p.csv") + quality));
    EXPECT_EQ(said.status, 0) << said.err;
    const std::vector<std::filesystem::path> saved = savedPictures();
    EXPECT_EQ(saved.size(), 1u);
    if (saved.empty()) return std::string();
    EXPECT_NE(said.err.find("picture saved as " + saved[0].string()), std::string::npos) << said.err;
    EXPECT_TRUE(saved[0].filename().string().ends_with("-tooth-48.png")) << saved[0];
    std::ifstream file(saved[0], std::ios::binary);
    std::ostringstream bytes;
    bytes << file.rdbuf();
    std::filesystem::remove(saved[0]);
    return bytes.str();
  };
  const std::string best = picture_at(" --quality 0"), poorest = picture_at(" --quality 6");
  EXPECT_GT(best.size(), 1000u);
  EXPECT_EQ(best, poorest);
  EXPECT_EQ(best, picture_at(""));
}

TEST_F(RehearseCommand, EndsAtTheTickOfAnEndRequest) {
  write("p.csv",
        std::string(kPoseHeader) + "0,100,0,200,1,0,0,0,0,,\n0.3,100,0,200,1,0,0,0,0,,end\n1,100,0,200,1,0,0,0,0,,\n");
  const ProgramOutput said = molar(kQuick + ("--device poses:" + at("p.csv") + " --record " + at("s.molar")));
  ASSERT_EQ(said.status, 0) << said.err;
  EXPECT_EQ(ticksOf(at("s.molar")).size(), 300u);
}

TEST_F(RehearseCommand, RefusesARateOtherThanTheRecorded) {
  ASSERT_EQ(molar(kCoarse + std::string("--seconds 0.2 --record ") + at("s.molar")).status, 0);
  expectRefusal(kQuick + ("--device replay:" + at("s.molar") + " --rate 2000 --record " + at("t.molar")), "2000 Hz");
  EXPECT_FALSE(std::filesystem::exists(at("t.molar.new"))) << "the begun recording is closed";
}

TEST_F(RehearseCommand, ForceReplacesRecordingsOnly) {
  const std::string poses = std::string(kPoseHeader) + "0,100,0,200,1,0,0,0,0,,\n0.3,100,0,200,1,0,0,0,0,,\n";
  write("p.csv", poses);
  write("feel.toml", "[law]\n");
  expectRefusal(kQuick + ("--force --device poses:" + at("p.csv") + " --record " + at("p.csv")), "no recording");
  expectRefusal(kCoarse + ("--force --parameters " + at("feel.toml") + " --record " + at("feel.toml")), "no recording");
  EXPECT_EQ(read("p.csv"), poses);
  const std::string recorded = kQuick + ("--force --device poses:" + at("p.csv") + " --record " + at("s.molar"));
  EXPECT_EQ(molar(recorded).status, 0);
  EXPECT_EQ(molar(recorded).status, 0);
}

TEST_F(RehearseCommand, FastPaceNeedsSimulatedInput) {
  expectRefusal("rehearse --pace fast --device scripted", "--headless");
  for (const char* device : {"openhaptics", "wooden", "falcon", "usb"})
    expectRefusal("rehearse --headless --pace fast --device " + std::string(device), "is not simulated");
  expectRefusal(kCoarse + std::string("--instructor"), "--instructor");
  expectRefusal(kCoarse + std::string("--second-hand wooden"), "--second-hand");
  expectRefusal(kCoarse + std::string("--pedal pedal"), "--pedal");
  expectRefusal("rehearse --headless --pace quick --device scripted", "--pace");
}

/// A simulated Phantom arms and carves; its recording replays as a pose source.
TEST_F(RehearseCommand, ArmsASimulatedPhantomAndReplaysIt) {
  const std::string quiet = kQuick;
  const ProgramOutput said = molar(quiet + "--device simulated:omni --seconds 7 --record " + at("s.molar"));
  ASSERT_EQ(said.status, 0) << said.err;
  EXPECT_NE(said.err.find("There is no force yet."), std::string::npos) << said.err;
  EXPECT_NE(said.err.find("The hand feels the tissue."), std::string::npos) << said.err;
  EXPECT_EQ(molar("replay " + at("s.molar") + " --verify").status, 0);
  const ProgramOutput again =
      molar(quiet + "--device replay:" + at("s.molar") + " --seconds 2 --record " + at("t.molar"));
  ASSERT_EQ(again.status, 0) << again.err;
  EXPECT_EQ(molar("replay " + at("t.molar") + " --verify").status, 0);
  EXPECT_EQ(molar(quiet + "--device replay:" + at("none.molar")).status, 2);
}

/// The true rig of an arm with errors.
calibration::RigRecord rigOf(const calibration::SyntheticRig& truth, calibration::Verdict verdict) {
  calibration::RigRecord record;
  record.rig = truth.nominal;
  record.rig.X_WD = truth.X_WD;
  record.rig.arm = truth.arm.truth;
  record.provenance.rig_id = "rig-02";
  record.provenance.created_utc = "2026-11-19T08:00:00Z";
  record.provenance.mirror_kind = "front_surface";
  record.verification = calibration::RigVerification{};
  record.verification->verdict = verdict;
  record.verification->errors.n = 16;
  record.verification->errors.rms_mm = 1.4, record.verification->errors.mean_mm = 1.2;
  record.verification->errors.p95_mm = 2.0, record.verification->errors.max_mm = 2.5;
  record.verification->checked_utc = record.provenance.created_utc;
  return record;
}

/// An arm with errors, under its own rig and under the default one; stepped, so that it is the same on every machine.
TEST_F(RehearseCommand, UsesTheRigOfAPracticeDevice) {
  const auto truth = *practiceRig("practice:B:3");
  const calibration::RigRecord green = rigOf(truth, calibration::Verdict::green),
                               red = rigOf(truth, calibration::Verdict::red);
  calibration::RigStore(at("store")).keep({"rig-02", truth.nominal.device->serial, "right"}, green, "", true);
  const std::string line = kQuick + std::string("--device practice:B:3 ");
  const auto metricsOf = [&](const std::string& session) {
    return nlohmann::json::parse(molar("metrics " + at(session) + " --json").out);
  };

  const ProgramOutput said = molar(line + "--seconds 7 --record " + at("s.molar"));
  ASSERT_EQ(said.status, 0) << said.err;
  EXPECT_NE(said.err.find("current rig rig-02: green"), std::string::npos) << said.err;
  EXPECT_NE(said.out.find("calibration      green, 1.40 mm RMS of 16"), std::string::npos) << said.out;
  EXPECT_EQ(molar("replay " + at("s.molar") + " --verify").status, 0);
  const auto json = metricsOf("s.molar");
  EXPECT_EQ(json.at("calibration").at("verdict"), "green");
  EXPECT_EQ(json.at("calibration").at("device_serial"), truth.nominal.device->serial);
  EXPECT_FALSE(json.at("removed_mm3_by_label").contains("other_teeth")) << json;

  // Red: locked, one line, until a word is given, which stays.
  std::ofstream(at("red.yaml")) << calibration::rigRecordText(red);
  const ProgramOutput locked = molar(line + "--rig " + at("red.yaml"));
  EXPECT_EQ(locked.status, 2);
  EXPECT_EQ(std::ranges::count(locked.err, '\n'), 1) << locked.err;
  const std::string word = "--despite-calibration 'for show' --seconds 0.3 --record ";
  EXPECT_EQ(molar(line + "--rig " + at("red.yaml") + " " + word + at("t.molar")).status, 0);
  EXPECT_EQ(metricsOf("t.molar").at("calibration").at("despite"), "for show");

  // Another unit, and the rig of none.
  EXPECT_EQ(molar("rehearse --headless --voxel 0.6 --device practice:B:4 --rig " + at("red.yaml")).status, 2);
  EXPECT_EQ(molar("rehearse --headless --voxel 0.6 --device practice:Z").status, 2);
  EXPECT_EQ(molar(line + "--rig mirrored --seconds 0.3 --record " + at("u.molar")).status, 0);
  EXPECT_EQ(metricsOf("u.molar").at("calibration").at("rig"), "default");
}

/// Through the whole program, with our stand-in for the vendor's library.
TEST_F(RehearseCommand, RunsAPhantomThroughTheVendorsLibrary) {
  setenv("MOLAR_OPENHAPTICS", MOLAR_STAND_IN_HD, 1);
  const std::string line = "rehearse --headless --voxel 0.6 --size 96x64 --device openhaptics --seconds 2 ";
  const ProgramOutput said = molar(line + "--record " + at("s.molar"));
  unsetenv("MOLAR_OPENHAPTICS");
  ASSERT_EQ(said.status, 0) << said.err;
  // A machine so busy that ticks are late may take the force away, the device itself gives no cause.
  const std::vector<haptics::Tick> ticks = ticksOf(at("s.molar"));
  ASSERT_FALSE(ticks.empty());
  bool punctual = true;
  for (const haptics::Tick& tick : ticks) {
    punctual = punctual && tick.hand.gap_s == 0.0;
    ASSERT_FALSE(haptics::has(tick.faults, haptics::Fault::device)) << tick.index;
    ASSERT_FALSE(punctual && haptics::has(tick.faults, haptics::Fault::latched)) << tick.index << said.out;
  }
  EXPECT_EQ(molar("replay " + at("s.molar") + " --verify").status, 0);
}

TEST_F(RehearseCommand, ReportsAnUnavailableDeviceInOneLine) {
  setenv("MOLAR_OPENHAPTICS", at("libHD.so").c_str(), 1);
  for (const char* address :
       {"openhaptics", "wooden", "falcon", "usb", "wooden:9-9", "spoon", "replay:", "simulated:x"}) {
    const ProgramOutput said = molar("rehearse --headless --voxel 0.6 --device " + std::string(address));
    EXPECT_EQ(said.status, 2) << address;
    EXPECT_EQ(std::count(said.err.begin(), said.err.end(), '\n'), 1) << said.err;
  }
  unsetenv("MOLAR_OPENHAPTICS");
}

TEST_F(RehearseCommand, WritesImagesOfBothEyes) {
  const ProgramOutput said =
      molar(kCoarse + std::string("--seconds 0.2 --snapshot-size 160x100 --snapshot ") + at("end.png"));
  ASSERT_EQ(said.status, 0) << said.err;
  EXPECT_EQ(read("end_left.png").substr(1, 3), "PNG");
  EXPECT_NE(read("end_left.png"), read("end_right.png"));
}

/// Law and gains change while running; every change is reported and recorded, and the recording replays bit for bit.
TEST_F(RehearseCommand, AppliesChangesOfASettingsFile) {
  const std::string file = write("feel.toml", "[law]\nstiffness_N_per_mm = 0.6\n");
  const std::string said = at("said");
  // The next step once the one before was seen, however long the machine takes: `seen WORDS` in what it says.
  const std::string script = R"(seen() { while ! grep -qF "$1" )" + said + R"( && kill -0 $p; do sleep 0.02; done; }
    put() { echo "$1" > )" + file +
                             ".new; mv " + file + ".new " + file + R"(; }
    while [ ! -e )" + at("s.molar") +
                             R"( ] && kill -0 $p; do sleep 0.02; done
    put '[law]
name = "forssim"'
    seen 'agus -> forssim'
    put '[law'
    seen 'old values stay'
    kill -TERM $p; wait $p)";
  const int status =
      std::system((std::string(MOLAR_PROGRAM) + " rehearse --headless --device scripted --voxel 0.6 --size 96x64 " +
                   "--seconds 120 --parameters " + file + " --record " + at("s.molar") + " >/dev/null 2>" + said +
                   " & p=$!\n" + script)
                      .c_str());
  const std::string words = read("said");
  EXPECT_EQ(status, 0) << words;
  EXPECT_NE(words.find("[law] name agus -> forssim"), std::string::npos) << words;
  EXPECT_NE(words.find("line 1: not valid TOML"), std::string::npos) << words;
  EXPECT_NE(words.find("the old values stay"), std::string::npos) << words;
  const ProgramOutput replay = molar("replay " + at("s.molar") + " --verify");
  EXPECT_EQ(replay.status, 0) << replay.out << replay.err;
}

TEST_F(RehearseCommand, RefusesABadSettingsFileAtTheStart) {
  write("feel.toml", "[law]\nstiffness_N_per_mm = 99\n");
  expectRefusal(kCoarse + std::string("--parameters ") + at("feel.toml"), "line 2: [law] stiffness_N_per_mm");
  expectRefusal("rehearse --headless --device simulated --voxel 0.6 --set stiffness_N_per_mm=10", "2b/T");
  expectRefusal(kCoarse + std::string("--law harmonic --tool cone:1,2"), "does not admit");
  expectRefusal(kCoarse + std::string("--law spring"), "forssim");
}

TEST_F(RehearseCommand, DrawsTheSecondInstrument) {
  const auto end = [&](const std::string& options, const std::string& name) {
    const ProgramOutput said =
        molar(kCoarse + std::string("--seconds 0.3 --renderer cpu --snapshot-size 160x100 --force ") + options +
              " --snapshot " + at(name + ".png"));
    EXPECT_EQ(said.status, 0) << said.err;
    return read(name + "_left.png");
  };
  EXPECT_NE(end("--second-hand scripted --second-tool mirror", "mirror"),
            end("--second-hand scripted --second-tool retractor", "retractor"));
  expectRefusal(kCoarse + std::string("--second-hand mouse"), "--second-hand mouse");
}

TEST_F(RehearseCommand, RecordsWhereTheSecondHandWasAndReplaysIt) {
  const auto measured = [&](const std::string& options, const std::string& name) {
    EXPECT_EQ(molar(kCoarse + std::string("--seconds 2 --record ") + at(name) + " " + options).status, 0);
    std::vector<std::string> words;
    const auto metrics = nlohmann::json::parse(molar("metrics --json " + at(name)).out);
    for (const auto& one : metrics["measures"])
      if (one["id"] == "S7" || one["id"].get<std::string>().starts_with("M10.")) words.push_back(one.dump());
    return words;
  };
  const auto with = measured("--second-hand scripted", "s.molar");
  EXPECT_EQ(with, measured("--second-hand replay:" + at("s.molar"), "t.molar"));
  ASSERT_EQ(with.size(), 4u);
  EXPECT_NE(with[2].find("\"value\":0."), std::string::npos) << with[2];
  EXPECT_NE(measured("", "u.molar")[1].find("nothing was in the other hand"), std::string::npos);
  EXPECT_NE(measured("--second-hand scripted --second-tool retractor", "v.molar")[2].find("held no mirror"),
            std::string::npos);
}

TEST_F(RehearseCommand, ReportsTheTemporaryFileOfAReplacedRecording) {
  const std::string line = kCoarse + std::string("--seconds 0.2 --record ") + at("s.molar");
  ASSERT_EQ(molar(line).status, 0);
  write("s.molar.new", "somebody's");
  const ProgramOutput said = molar(line + " --force");
  EXPECT_EQ(said.status, 0) << said.err;
  EXPECT_NE(said.err.find("recording to " + at("s.molar.new2") + " until it is closed"), std::string::npos) << said.err;
  EXPECT_NE(said.out.find("recorded in      " + at("s.molar") + "\n"), std::string::npos) << said.out;
  EXPECT_NE(said.out.find("0 lost\n"), std::string::npos) << said.out;
}

TEST_F(RehearseCommand, KeepsAnOldRecording) {
  write("s.molar", "precious");
  expectRefusal(kCoarse + std::string("--seconds 0.2 --record ") + at("s.molar"), "s.molar");
  EXPECT_EQ(read("s.molar"), "precious");
}

}  // namespace
}  // namespace app
