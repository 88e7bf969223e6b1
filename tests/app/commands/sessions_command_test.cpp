#include <algorithm>
#include <vector>

#include <nlohmann/json.hpp>

#include "app/session/metrics.h"
#include "app/session/replay.h"
#include "app/session/session_reader.h"
#include "assets/patient/patient_folder.h"
#include "assets/synthetic/jaw.h"
#include "haptics/body/bodies.h"
#include "tests/app/commands/program.h"

namespace app {
namespace {

/// Rehearsals of a coarse patient, with the build's own cache of it, recorded into a data folder of the test.
class SessionsCommand : public ProgramTest {
 protected:
  void SetUp() override {
    ProgramTest::SetUp();
    setenv("XDG_CACHE_HOME", MOLAR_TEST_CACHE, 1);
    setenv("MOLAR_CALIBRATION", at("store").c_str(), 1);
  }
  nlohmann::json sessions() const {
    const ProgramOutput said = molar("sessions --json");
    EXPECT_EQ(said.status, 0) << said.err;
    return nlohmann::json::parse(said.out);
  }
};

constexpr char kCoarseRun[] = "rehearse --headless --pace fast --device scripted --voxel 0.6 --size 96x64 ";

TEST_F(SessionsCommand, EveryRehearsalIsRecordedAndNamedAndTheLastIsAtHand) {
  const ProgramOutput said = molar(kCoarseRun + std::string("--seconds 3"));
  ASSERT_EQ(said.status, 0) << said.err;
  const nlohmann::json list = sessions();
  ASSERT_EQ(list.size(), 1u);
  const std::string file = list[0].at("file");
  EXPECT_NE(said.out.find(file), std::string::npos) << "the path is named at the end\n" << said.out;
  EXPECT_TRUE(file.starts_with(dataFolder() + "/molar/sessions/20")) << file;
  EXPECT_TRUE(file.ends_with("-tooth-48.molar")) << file;
  EXPECT_EQ(list[0].at("verdict"), "complete");
  EXPECT_NEAR(list[0].at("length_s").get<double>(), 3.0, 1e-9);
  EXPECT_EQ(molar("replay last --verify").status, 0);
  EXPECT_EQ(molar("metrics last --json").out, molar("metrics " + file + " --json").out);
  EXPECT_EQ(molar("export last --out " + at("a.stl")).status, 0);
  EXPECT_EQ(molar("rehearse --headless --pace fast --voxel 0.6 --no-record --device replay:last").status, 0);
  EXPECT_EQ(sessions().size(), 1u) << "--no-record records nothing";
  ASSERT_EQ(molar(kCoarseRun + std::string("--seconds 0.2 --record ") + at("mine.molar")).status, 0);
  EXPECT_EQ(sessions().size(), 1u) << "nor does --record into the data folder";
}

TEST_F(SessionsCommand, TheBoneOfAnyMomentHasItsDigestAndItsSound) {
  ASSERT_EQ(molar(kCoarseRun + std::string("--seconds 6 --record ") + at("s.molar")).status, 0);
  const std::string replay = "replay " + at("s.molar");
  const ProgramOutput end = molar(replay + " --digest"), early = molar(replay + " --to 1 --digest");
  EXPECT_EQ(std::stoull(end.out, nullptr, 16), verify(at("s.molar")).bone_digest);
  EXPECT_EQ(early.status, 0) << early.err;
  EXPECT_NE(early.out, end.out);
  EXPECT_EQ(molar(replay + " --to 1 --digest --volume " + at("v.nrrd")).status, 0);
  EXPECT_TRUE(std::filesystem::exists(at("v.nrrd")));
  const ProgramOutput sound = molar(replay + " --sound-file " + at("s.flac"));
  EXPECT_EQ(sound.out, "sound of 6.000 s written\n") << sound.err;
  expectRefusal(replay + " --sound-file " + at("s.mp3"), "name it .flac");
  expectRefusal(replay + " --sound-file " + at("s.flac"), "s.flac");
  expectRefusal(replay + " --sound-file " + at("t.flac") + " --to 1", "--to");
  expectRefusal(replay + " --to 1", "--volume");
}

TEST_F(SessionsCommand, GoesOnWithoutADataFolderAndSaysSo) {
  setenv("XDG_DATA_HOME", write("a_file", "not a folder").c_str(), 1);
  const ProgramOutput said = molar(kCoarseRun + std::string("--seconds 0.2"));
  EXPECT_EQ(said.status, 0) << said.err;
  const std::size_t first = said.err.find("not recording, the rehearsal goes on: ");
  ASSERT_NE(first, std::string::npos) << said.err;
  EXPECT_EQ(said.err.find("not recording", first + 1), std::string::npos) << said.err;
  EXPECT_NE(said.out.find("removed"), std::string::npos);
}

TEST_F(SessionsCommand, AKilledRehearsalIsListedAndIsTheLast) {
  const std::string folder = dataFolder() + "/molar/sessions";
  const std::string line =
      std::string(MOLAR_PROGRAM) +
      " rehearse --headless --device scripted --voxel 0.6 --size 96x64 --seconds 60 >/dev/null 2>&1 "
      "& p=$!; while ! ls " +
      folder +
      "/*.molar-wal >/dev/null 2>&1 && kill -0 $p; do sleep 0.02; done; sleep 0.5; kill -9 $p; "
      "wait $p 2>/dev/null; true";
  ASSERT_EQ(std::system(("bash -c '" + line + "'").c_str()), 0);
  const nlohmann::json list = sessions();
  ASSERT_EQ(list.size(), 1u);
  EXPECT_EQ(list[0].at("verdict"), "killed");
  EXPECT_GT(list[0].at("length_s").get<double>(), 0.0);
  EXPECT_EQ(molar("metrics last --json").status, 0);
  EXPECT_EQ(molar("replay last --verify").status, 0);
  // It goes on from there, too.
  const ProgramOutput said = molar(kCoarseRun + std::string("--seconds 0.2 --continue last"));
  EXPECT_EQ(said.status, 0) << said.err;
}

TEST_F(SessionsCommand, GoesOnWhereItEnded) {
  ASSERT_EQ(molar(kCoarseRun + std::string("--seconds 6 --depth 4 --tool sphere:1 --tool sphere:0.8")).status, 0);
  const std::string former = sessions()[0].at("file");
  const BoneAtTime ended = boneAtTime(former, {});
  ASSERT_EQ(molar(kCoarseRun + std::string("--seconds 6 --continue last --record ") + at("next.molar")).status, 0);
  SessionReader next(at("next.molar"));
  const StoredStart start = next.start();
  EXPECT_TRUE(start.solid == ended.solid) << "the bone as it was";
  EXPECT_EQ(start.setup.built_in->depth_mm, 4.0) << "the same case, though another is the default";
  ASSERT_TRUE(start.setup.former);
  EXPECT_EQ(start.setup.former->file, std::filesystem::path(former).filename().string());
  EXPECT_NEAR(start.setup.former->duration_s, 6.0, 1e-6);
  const haptics::Bodies bone(start.grid, start.solid, start.label, start.is_tooth);
  EXPECT_EQ(bone.pieces(), 1u);
  EXPECT_EQ(start.setup.former->bone_digest, bone.digest());
  EXPECT_EQ(next.nextBlock().ticks.front().bone_digest, bone.digest());
  ASSERT_EQ(start.setup.tray.size(), 2u) << "the same tools";
  EXPECT_EQ(start.setup.tray[0].head.radius_mm, 1.0);
  EXPECT_EQ(start.setup.tray[1].head.radius_mm, 0.8);
  EXPECT_EQ(molar("replay " + at("next.molar") + " --verify").status, 0);
  // Each part has its own measures and says which part it is.
  const auto metrics = nlohmann::json::parse(molar("metrics " + at("next.molar") + " --json").out);
  EXPECT_EQ(metrics.at("continues").at("session"), std::filesystem::path(former).filename().string());
  EXPECT_NEAR(metrics.at("continues").at("duration_s").get<double>(), 6.0, 1e-6);
}

TEST_F(SessionsCommand, RefusesToGoOnWithAnotherPatient) {
  ASSERT_EQ(molar("rehearse --headless --pace fast --device scripted --voxel 0.6 --size 96x64 --seconds 0.3").status,
            0);
  assets::savePatient(assets::syntheticJaw({.right_side = false, .spacing_mm = 0.6}), at("patient"), false);
  expectRefusal("rehearse " + at("patient") + " --headless --pace fast --device scripted --continue last",
                "another patient");
  expectRefusal("rehearse --headless --pace fast --device scripted --continue " + at("none.molar"), "none.molar");
  std::filesystem::remove_all(dataFolder());
  expectRefusal("replay last", "there is no session in ");
}

TEST_F(SessionsCommand, UndoesAndRedoesByScriptBitForBit) {
  // Three cuts into the buccal plate, then undo twice, redo once, undo once, and a new cut.
  ASSERT_EQ(molar(kCoarseRun + std::string("--seconds 12 --record ") + at("find.molar")).status, 0);
  std::vector<haptics::Tick> ticks;
  SessionReader find(at("find.molar"));
  for (TickBlock block = find.nextBlock(); !block.ticks.empty(); block = find.nextBlock())
    ticks.insert(ticks.end(), block.ticks.begin(), block.ticks.end());
  const auto deepest = std::ranges::max_element(ticks, {}, &haptics::Tick::depth_mm);
  const auto calibrated = deepest->hand.X_PT;
  const glm::dvec3 in = calibrated.translation_mm, out = in + 6.0 * (calibrated.rotation * glm::dvec3(0, 0, 1));
  const auto row = [&](double t_s, const glm::dvec3& p, int drill, const std::string& action) {
    const glm::dquat& q = calibrated.rotation;
    char text[256];
    std::snprintf(text, sizeof text, "%.3f,%.9f,%.9f,%.9f,%.12f,%.12f,%.12f,%.12f,%d,,%s\n", t_s, p.x, p.y, p.z, q.w,
                  q.x, q.y, q.z, drill, action.c_str());
    return std::string(text);
  };
  std::string rows = "t_s,px_mm,py_mm,pz_mm,qw,qx,qy,qz,drill,tool,action\n";
  double t_s = 0.0;
  for (int cut = 0; cut < 3; ++cut) {
    const glm::dvec3 aside = glm::dvec3(0.0, 0.8 * cut, 0.0);
    rows += row(t_s, out + aside, 0, "") + row(t_s + 0.2, out + aside, 1, "") + row(t_s + 0.8, in + aside, 1, "");
    rows += row(t_s + 1.2, out + aside, 0, "");
    t_s += 1.8;
  }
  for (const char* action : {"undo", "undo", "redo", "undo"}) rows += row(t_s += 0.5, out, 0, action);
  rows += row(t_s + 0.5, out, 1, "") + row(t_s + 1.1, in, 1, "") + row(t_s + 1.5, out, 0, "");
  rows += row(t_s + 2.0, out, 0, "redo") + row(t_s + 2.5, out, 0, "");
  write("p.csv", rows);
  const ProgramOutput said =
      molar("rehearse --headless --pace fast --voxel 0.6 --size 96x64 --device poses:" + at("p.csv") + " --record " +
            at("s.molar"));
  ASSERT_EQ(said.status, 0) << said.err;
  EXPECT_NE(said.err.find(" mm³ taken back, "), std::string::npos) << said.err;
  EXPECT_NE(said.err.find(" mm³ cut again, "), std::string::npos) << said.err;
  EXPECT_NE(said.err.find("there is no undone stroke to redo"), std::string::npos) << said.err;
  EXPECT_EQ(molar("replay " + at("s.molar") + " --verify").status, 0);
  const SessionMetrics metrics = metricsOf(at("s.molar"));
  EXPECT_GT(metrics.returned_mm3, 0.0);
}

}  // namespace
}  // namespace app
