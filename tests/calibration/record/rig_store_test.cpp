#include "calibration/record/rig_store.h"

#include <signal.h>
#include <sys/file.h>
#include <sys/wait.h>
#include <unistd.h>

#include <chrono>
#include <cstdlib>
#include <fstream>
#include <random>
#include <thread>

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "calibration/record/rig_file.h"
#include "calibration/record/utc.h"
#include "tests/calibration/record/full_record.h"
#include "tests/refusal.h"

namespace calibration {
namespace {

namespace fs = std::filesystem;
using testing::HasSubstr;

constexpr std::int64_t kStart_s = 1795249200;

class Store : public testing::Test {
 protected:
  fs::path root_ = fs::path(testing::TempDir()) /
                   (std::string("store_") + testing::UnitTest::GetInstance()->current_test_info()->name());
  RigLocation place_{"rig-02", "60623200012", "right"};
  RigStore store_{root_};
  fs::path folder_ = root_ / "rig-02" / "60623200012" / "right";

  void SetUp() override { fs::remove_all(root_); }
  void TearDown() override { fs::remove_all(root_); }

  static RigRecord record(std::int64_t after_s, double eye_sd_mm = 5.0) {
    RigRecord made = fullRecord();
    made.provenance.created_utc = utcOf(kStart_s + after_s);
    made.provenance.parent.clear();
    made.eye_sd_mm = eye_sd_mm;
    return made;
  }
  std::string keep(std::int64_t after_s, bool make_current = true) {
    return store_.keep(place_, record(after_s), "", make_current).filename().string();
  }
  static void write(const fs::path& path, const std::string& text) { std::ofstream(path) << text; }
  template <class Act>
  static std::string refusal(Act act) {
    return tests::refusalOf<CalibrationError>([&] { act(); });
  }
};

TEST_F(Store, KeepsARigUnderItsTimeAndMakesItCurrent) {
  EXPECT_FALSE(store_.current(place_));
  const fs::path path = store_.keep(place_, record(0), "touches\n", true);
  EXPECT_EQ(path, folder_ / "2026-11-21T08-20-00Z.yaml");
  EXPECT_EQ(store_.currentName(place_), "2026-11-21T08-20-00Z.yaml");
  EXPECT_EQ(store_.current(place_)->rig.device->serial, "60623200012");
  std::string touches;
  std::getline(std::ifstream(folder_ / "2026-11-21T08-20-00Z.touches.yaml"), touches);
  EXPECT_EQ(touches, "touches");
  ASSERT_EQ(store_.locations().size(), 1u);
  EXPECT_EQ(store_.locations()[0].serial, "60623200012");
}

TEST_F(Store, NeverOverwrites) {
  EXPECT_EQ(keep(0), "2026-11-21T08-20-00Z.yaml");
  EXPECT_EQ(keep(0), "2026-11-21T08-20-00Z-02.yaml");
  EXPECT_EQ(keep(0), "2026-11-21T08-20-00Z-03.yaml");
  EXPECT_EQ(keep(1), "2026-11-21T08-20-01Z.yaml");
  EXPECT_THAT(store_.names(place_), testing::ElementsAre("2026-11-21T08-20-00Z.yaml", "2026-11-21T08-20-00Z-02.yaml",
                                                         "2026-11-21T08-20-00Z-03.yaml", "2026-11-21T08-20-01Z.yaml"));
}

TEST_F(Store, LeavesTheOldOneCurrentUnlessAsked) {
  const std::string first = keep(0);
  keep(60, false);
  EXPECT_EQ(store_.currentName(place_), first);
  EXPECT_EQ(store_.names(place_).size(), 2u);
}

TEST_F(Store, IgnoresOtherFiles) {
  keep(0);
  for (const char* name : {"2026-11-21T08-20-00Z.touches.yaml", "notes.yaml", "2026-11-21T08-20-00Z.yaml~",
                           ".part-2026-11-21T08-20-09Z.yaml", "2026-13-21T08-20-00Z.yaml",
                           "2026-11-21T08-20-00Z-1.yaml", "2026-11-21T08:20:05Z.yaml", "history.csv"})
    write(folder_ / name, "x");
  fs::create_directory(folder_ / "2026-11-22T08-20-00Z.yaml");
  fs::create_directories(root_ / "rig-02" / "empty" / "left");
  EXPECT_EQ(store_.names(place_).size(), 1u);
  EXPECT_EQ(store_.locations().size(), 1u);
}

TEST_F(Store, RollsBackStepByStep) {
  const std::string a = keep(0), b = keep(60), c = keep(120);
  EXPECT_EQ(store_.rollBack(place_), b);
  EXPECT_EQ(store_.currentName(place_), b);
  EXPECT_EQ(store_.rollBack(place_), a);
  EXPECT_THAT(refusal([&] { store_.rollBack(place_); }), HasSubstr("no rig before"));
  EXPECT_EQ(store_.currentName(place_), a);
}

TEST_F(Store, RollsBackToTheParentNotToADiscardedRig) {
  const std::string good = keep(0), bad = keep(60);
  store_.rollBack(place_);
  const std::string next = keep(120);
  EXPECT_EQ(store_.rollBack(place_), good);
}

TEST_F(Store, RollsBackThoughTheClockWasWrong) {
  const std::string first = keep(1000), second = keep(0);
  EXPECT_EQ(store_.currentName(place_), second);
  EXPECT_EQ(store_.rollBack(place_), first);
}

TEST_F(Store, RollsBackFromADamagedRigOrPointer) {
  const std::string a = keep(0), b = keep(60);
  write(folder_ / b, "spoilt");
  EXPECT_NE(refusal([&] { store_.current(place_); }), "accepted");
  EXPECT_EQ(store_.rollBack(place_), a);
  write(folder_ / "current", "../../elsewhere.yaml\n");
  EXPECT_THAT(refusal([&] { store_.current(place_); }), HasSubstr("names no rig"));
  EXPECT_THAT(refusal([&] { store_.rollBack(place_); }), HasSubstr(b));  // the newest, damaged
  fs::remove(folder_ / b);
  EXPECT_EQ(store_.rollBack(place_), a);
}

TEST_F(Store, RefusesARigOfAnotherDevice) {
  RigRecord other = record(0);
  other.rig.device->serial = "4711";
  EXPECT_THAT(refusal([&] { store_.keep(place_, other, "", true); }), HasSubstr("4711"));
  other = record(0);
  other.rig.device->mount = "left";
  EXPECT_THAT(refusal([&] { store_.keep(place_, other, "", true); }), HasSubstr("left"));
  other = record(0);
  other.rig.device.reset();
  other.rig.arm.reset();
  EXPECT_THAT(refusal([&] { store_.keep(place_, other, "", true); }), HasSubstr("no device"));
  EXPECT_TRUE(store_.names(place_).empty());

  // Created by hand.
  const std::string name = keep(0);
  other = record(0);
  other.rig.device->serial = "4711";
  write(folder_ / name, rigRecordText(other));
  EXPECT_THAT(refusal([&] { store_.current(place_); }), HasSubstr("4711"));
}

TEST_F(Store, KeepsNothingThatCannotBeReadBack) {
  const std::string first = keep(0);
  RigRecord bad = record(60);
  bad.rig.arm->gain[2] = 0.5;
  EXPECT_NE(refusal([&] { store_.keep(place_, bad, "touches", true); }), "accepted");
  bad = record(60);
  bad.rig.X_WD.translation_mm.x = std::nan("");
  EXPECT_NE(refusal([&] { store_.keep(place_, bad, "touches", true); }), "accepted");
  bad.provenance.created_utc = "now";
  EXPECT_NE(refusal([&] { store_.keep(place_, bad, "touches", true); }), "accepted");
  EXPECT_EQ(store_.currentName(place_), first);
  // The rig, `current` and the lock.
  EXPECT_EQ(std::distance(fs::directory_iterator(folder_), {}), 3);
}

TEST_F(Store, StaysInsideItsFolder) {
  for (const char* name : {"", "..", ".", "a/b", "../x", "a b", ".hidden", "a\nb"}) {
    RigLocation away = place_;
    away.rig_id = name;
    EXPECT_THAT(refusal([&] { store_.names(away); }), HasSubstr("is not a valid name")) << name;
    away = place_;
    away.mount = name;
    EXPECT_THAT(refusal([&] { store_.names(away); }), HasSubstr("is not a valid name")) << name;
    EXPECT_THAT(refusal([&] { store_.pathOf(place_, name); }), HasSubstr("is not a rig")) << name;
  }
}

TEST_F(Store, KeepsAnySerialAndKeepsThemApart) {
  for (const char* serial : {"", "../../x", "a b", "a_b", "a/b", "...", "\u00e5\u00e4\u00f6",
                             "0123456789012345678901234567890123456789012345678901234567890123456789"}) {
    const RigLocation position{"rig-02", serial, "right"};
    RigRecord mine = record(0);
    mine.rig.device->serial = serial;
    const fs::path path = store_.keep(position, mine, "", true);
    EXPECT_EQ(path.parent_path().parent_path().parent_path(), root_ / "rig-02") << serial;
    EXPECT_EQ(store_.names(position).size(), 1u) << serial;
    EXPECT_EQ(store_.current(position)->rig.device->serial, serial);
  }
  EXPECT_EQ(store_.locations().size(), 8u);
  for (const RigLocation& position : store_.locations()) EXPECT_TRUE(store_.current(position));
}

TEST_F(Store, RefusesASecondWriter) {
  keep(0);
  const int theirs = ::open((folder_ / ".lock").c_str(), O_RDWR);
  ASSERT_EQ(::flock(theirs, LOCK_EX), 0);
  EXPECT_THAT(refusal([&] { keep(60); }), HasSubstr("another program"));
  EXPECT_THAT(refusal([&] { store_.rollBack(place_); }), HasSubstr("another program"));
  ::close(theirs);
  keep(60);
}

TEST_F(Store, RemovesLeftoversOfAKilledWriter) {
  const std::string first = keep(0);
  write(folder_ / ".part-2026-11-21T08-21-00Z.yaml", "half");
  write(folder_ / ".part-current", "2026-11-21T08-21");
  write(folder_ / "2026-11-21T08-21-00Z.touches.yaml", "of a rig that never came");
  EXPECT_EQ(store_.currentName(place_), first);
  EXPECT_EQ(keep(60), "2026-11-21T08-21-00Z-02.yaml");
  EXPECT_FALSE(fs::exists(folder_ / ".part-current"));
}

TEST_F(Store, HasACompleteCurrentRigWheneverItIsKilled) {
  std::mt19937 rng(3);
  keep(0);
  std::int64_t next_s = 60;
  int confirmed_in_all = 0;
  for (int round = 0; round < 25; ++round) {
    int pipe_ends[2];
    ASSERT_EQ(::pipe(pipe_ends), 0);
    const pid_t child = ::fork();
    if (child == 0) {
      ::close(pipe_ends[0]);
      for (std::int64_t t = next_s;; t += 60) {
        store_.keep(place_, record(t, 1.0 + static_cast<double>(t % 90)), std::string(20000, 't'), true);
        if (::write(pipe_ends[1], &t, sizeof t) != sizeof t) ::_exit(1);
      }
    }
    ::close(pipe_ends[1]);
    // Every other round only after one was stored, however busy the machine.
    std::int64_t told = 0, confirmed = 0;
    if (round % 2 == 1 && ::read(pipe_ends[0], &told, sizeof told) == sizeof told) confirmed = told, ++confirmed_in_all;
    std::this_thread::sleep_for(std::chrono::microseconds(500 + rng() % 30000));
    ::kill(child, SIGKILL);
    ::waitpid(child, nullptr, 0);
    while (::read(pipe_ends[0], &told, sizeof told) == sizeof told) confirmed = told, ++confirmed_in_all;
    ::close(pipe_ends[0]);

    const auto now = store_.current(place_);
    ASSERT_TRUE(now);
    const std::int64_t in_force_s = *secondsOfUtc(now->provenance.created_utc) - kStart_s;
    EXPECT_GE(in_force_s, confirmed) << "what was confirmed is lost";
    for (const std::string& name : store_.names(place_))
      EXPECT_NO_THROW(readRigRecord(store_.pathOf(place_, name).string()));
    next_s = *secondsOfUtc(
                 readRigRecord(store_.pathOf(place_, store_.names(place_).back()).string()).provenance.created_utc) -
             kStart_s + 60;
  }
  EXPECT_GT(confirmed_in_all, 0) << "no round got far enough to prove anything";
  keep(next_s + 60);
}

TEST_F(Store, HasTheConfiguredRoot) {
  ::setenv("MOLAR_CALIBRATION", "/a/b", 1);
  EXPECT_EQ(RigStore::usualRoot(), "/a/b");
  ::unsetenv("MOLAR_CALIBRATION");
  ::setenv("XDG_DATA_HOME", "/data", 1);
  EXPECT_EQ(RigStore::usualRoot(), "/data/molar/calibration");
  ::setenv("XDG_DATA_HOME", "relative", 1);
  ::setenv("HOME", "/me", 1);
  EXPECT_EQ(RigStore::usualRoot(), "/me/.local/share/molar/calibration");
}

TEST(MismatchWith, NamesWhatDiffers) {
  const RigRecord record = fullRecord();
  EXPECT_EQ(mismatchWith(record, "omni", "60623200012", "right"), "");
  EXPECT_EQ(mismatchWith(record, "omni", "", "right"), "");
  EXPECT_THAT(mismatchWith(record, "touch", "60623200012", "right"), HasSubstr("touch"));
  EXPECT_THAT(mismatchWith(record, "omni", "4711", "right"), HasSubstr("4711"));
  EXPECT_THAT(mismatchWith(record, "omni", "60623200012", "left"), HasSubstr("left"));
  RigRecord plain;
  EXPECT_EQ(mismatchWith(plain, "omni", "4711", "left"), "");
}

TEST(AgeDays, CountsFromTheMeasurement) {
  const RigRecord record = fullRecord();
  EXPECT_EQ(age_days(record, "2026-11-21T08:20:00Z"), 0.0);
  EXPECT_EQ(age_days(record, "2027-02-19T20:20:00Z"), 90.5);
  EXPECT_EQ(age_days(record, "2026-11-20T08:20:00Z"), -1.0);
  EXPECT_FALSE(age_days(record, "soon"));
  EXPECT_FALSE(age_days(RigRecord{}, "2026-11-21T08:20:00Z"));
}

}  // namespace
}  // namespace calibration
