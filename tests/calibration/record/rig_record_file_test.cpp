#include <filesystem>
#include <fstream>
#include <random>
#include <sstream>

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "calibration/record/rig_file.h"
#include "calibration/record/sha256.h"
#include "tests/calibration/record/full_record.h"
#include "tests/mutants.h"
#include "tests/refusal.h"

namespace calibration {
namespace {

using testing::HasSubstr;

class RigRecordFile : public testing::Test {
 protected:
  std::string path_ =
      (std::filesystem::path(testing::TempDir()) /
       (std::string("record_") + testing::UnitTest::GetInstance()->current_test_info()->name() + ".yaml"))
          .string();
  void TearDown() override { std::filesystem::remove(path_); }

  RigRecord read(const std::string& text) {
    std::ofstream(path_, std::ios::binary) << text;
    return readRigRecord(path_);
  }
  std::string refusal(const std::string& text) {
    return tests::refusalOf<CalibrationError>([&] { read(text); });
  }
  static std::string replaced(std::string text, const std::string& from, const std::string& to) {
    const auto at = text.find(from);
    EXPECT_NE(at, std::string::npos) << from;
    return text.replace(at, from.size(), to);
  }
  /// With a recomputed hash.
  static std::string resealed(std::string text) {
    text.resize(text.rfind("sha256:"));
    return text + "sha256: \"" + sha256Of(text) + "\"\n";
  }
  /// A list or value of a key.
  static std::string with(const std::string& text, const std::string& key, const std::string& value) {
    const auto at = text.find(" " + key + ":");
    EXPECT_NE(at, std::string::npos) << key;
    const auto from = at + key.size() + 2;
    const auto end = text[from + 1] == '[' || text[from] == '[' ? text.find(']', from) + 1 : text.find('\n', from);
    std::string changed = text;
    return resealed(changed.replace(from, end - from, " " + value));
  }
};

TEST_F(RigRecordFile, RestoresEveryBlockBitForBit) {
  for (std::uint32_t seed = 1; seed <= 20; ++seed) {
    const RigRecord record = fullRecord(seed);
    const RigRecord back = read(rigRecordText(record));
    EXPECT_EQ(back.rig.X_WD.rotation, record.rig.X_WD.rotation);
    EXPECT_EQ(back.rig.X_WP.rotation, record.rig.X_WP.rotation);
    EXPECT_EQ(back.rig.X_WD.translation_mm, record.rig.X_WD.translation_mm);
    EXPECT_EQ(back.rig.mirror->normal, record.rig.mirror->normal);
    EXPECT_EQ(back.rig.right_eye.mm, record.rig.right_eye.mm);
    EXPECT_EQ(back.rig.arm->offset_rad, record.rig.arm->offset_rad);
    EXPECT_EQ(back.rig.arm->gain, record.rig.arm->gain);
    EXPECT_EQ(back.rig.arm->quadratic_per_rad, record.rig.arm->quadratic_per_rad);
    EXPECT_EQ(back.rig.arm->thigh_delta_mm, record.rig.arm->thigh_delta_mm);
    EXPECT_EQ(back.rig.arm->shin_delta_mm, record.rig.arm->shin_delta_mm);
    EXPECT_EQ(back.rig.arm->tilt_rad, record.rig.arm->tilt_rad);
    EXPECT_EQ(back.rig.arm->reach_delta_mm, record.rig.arm->reach_delta_mm);
    EXPECT_EQ(back.rig.arm->tip_H_mm, record.rig.arm->tip_H_mm);
    EXPECT_EQ(back.sigma, record.sigma);
    EXPECT_EQ(back.patient_position, record.patient_position);
    EXPECT_EQ(back.rest->rotation, record.rest->rotation);
    EXPECT_EQ(back.rest->worst_mm, record.rest->worst_mm);
    EXPECT_EQ(back.residuals.size(), 27u);
    for (std::size_t i = 0; i < 27; ++i) {
      EXPECT_EQ(back.residuals[i].id, record.residuals[i].id);
      EXPECT_EQ(back.residuals[i].error_mm.xyz, record.residuals[i].error_mm.xyz);
      EXPECT_EQ(back.residuals[i].used, record.residuals[i].used);
    }
    // Deterministic: the same record makes the same bytes.
    EXPECT_EQ(rigRecordText(back), rigRecordText(record));
    EXPECT_EQ(back.hash.size(), 64u);
  }
}

TEST_F(RigRecordFile, HoldsTheMetadata) {
  const RigRecord back = read(rigRecordText(fullRecord()));
  EXPECT_EQ(back.rig.device->serial, "60623200012");
  EXPECT_EQ(back.rig.device->mount, "right");
  EXPECT_EQ(back.rig.device->stylus_tip, "burr-3mm-07");
  EXPECT_EQ(back.provenance.rig_id, "rig-02");
  EXPECT_EQ(back.provenance.created_utc, "2026-11-21T08:20:00Z");
  EXPECT_EQ(back.provenance.operator_code, "tech-07");
  EXPECT_EQ(back.provenance.mirror_kind, "half_silvered");
  EXPECT_EQ(back.provenance.plate_mm, 2.0);
  EXPECT_EQ(back.provenance.parent, std::string(64, 'a'));
  EXPECT_EQ(back.eye_sd_mm, 4.7);
  EXPECT_EQ(back.procedure->method, "jig27");
  EXPECT_EQ(back.procedure->model, ArmModel::full);
  EXPECT_EQ(back.procedure->outliers, 1);
  EXPECT_EQ(back.procedure->cv_rms_mm, 0.24);
  EXPECT_EQ(back.verification->verdict, Verdict::green);
  EXPECT_EQ(back.verification->errors.max_mm, 0.55);
  EXPECT_EQ(back.verification->errors.bias_mm.xyz.y, -0.05);
  EXPECT_EQ(back.verification->checked_utc, "2026-11-21T08:23:00Z");
  EXPECT_EQ(back.verification->worst, "worst: back left low, 0.6 mm");
  EXPECT_EQ(back.verification->residuals.size(), 16u);
}

TEST_F(RigRecordFile, RefusesAFileThatWasEdited) {
  const std::string good = rigRecordText(fullRecord());
  EXPECT_THAT(refusal(replaced(good, "green", "amber")), HasSubstr("edited"));
  EXPECT_THAT(refusal(good + "more: 1\n"), HasSubstr("edited"));
  EXPECT_THAT(refusal(replaced(good, "sha256: \"", "sha256: \"0")), HasSubstr("edited"));
  EXPECT_THAT(refusal(good.substr(0, good.rfind("sha256:"))), HasSubstr("end with the hash is missing"));
}

TEST_F(RigRecordFile, ReadsAFileTypedByHandWithTheBlocksItHas) {
  const std::string typed = rigText(desktopRig({1920, 1080})) +
                            "device: { model: \"touch\", serial: \"7\" }\n"
                            "kinematics: { model: \"phantom6_v1\", l: [ 133.5, 133.35 ], m: [ 0, 0, 0.01, 0, 0, 0 ],\n"
                            "   k: [ 1.01, 1, 1, 1, 1, 1 ], q: [ 0, 0, 0 ], tilt: 0., a1: 0., tip: [ 0, 0, -41 ] }\n"
                            "some_day: { a: 1 }\n";
  const RigRecord record = read(typed);
  EXPECT_TRUE(record.hash.empty());
  EXPECT_NEAR(record.rig.arm->thigh_delta_mm, 0.15, 1e-12);
  EXPECT_NEAR(record.rig.arm->gain[0], 0.01, 1e-12);
  EXPECT_EQ(record.rig.arm->offset_rad[2], 0.01);
  EXPECT_EQ(record.rig.arm->tip_H_mm.z, -41.0);
  EXPECT_FALSE(record.verification);
}

TEST_F(RigRecordFile, RefusesANewerSchemaByItsNumber) {
  EXPECT_THAT(refusal(replaced(rigRecordText(fullRecord()), "schema: 1", "schema: 2")), HasSubstr("newer"));
}

TEST_F(RigRecordFile, RefusesAMeasuredPoseThatIsOnlyRoughlyRigid) {
  Rig rig = fullRecord().rig;
  rig.X_WD.rotation *= 1.00002;  // 4e-5 off: fine where a person typed it
  EXPECT_EQ(refusal(rigText(rig)), "accepted");
  RigRecord record = fullRecord();
  record.rig.X_WD.rotation *= 1.00002;
  EXPECT_THAT(refusal(rigRecordText(record)), HasSubstr("'X_WD' is not a rigid pose"));
}

TEST_F(RigRecordFile, RefusesAQuaternionThatIsNotItsMatrix) {
  const std::string good = rigRecordText(fullRecord());
  EXPECT_THAT(refusal(replaced(resealed(replaced(good, "X_WD_wxyz", "X_WQ_wxyz")), "a", "a")), "accepted");
  RigRecord other = fullRecord(2);
  const std::string theirs = rigRecordText(other);
  const auto line = [](const std::string& text) {
    const auto at = text.find("X_WD_wxyz");
    return text.substr(at, text.find(']', at) + 1 - at);
  };
  EXPECT_THAT(refusal(resealed(replaced(good, line(good), line(theirs)))), HasSubstr("remove 'X_WD_wxyz'"));
}

TEST_F(RigRecordFile, RefusesAnImplausibleArm) {
  const std::string good = rigRecordText(fullRecord());
  const std::pair<const char*, const char*> absurd[] = {{"gain", "[ 0.11, 0, 0, 0, 0, 0 ]"},
                                                        {"k", "[ 1, 1, 1, 1, 1, 1.2 ]"},
                                                        {"m", "[ 0, 0.6, 0, 0, 0, 0 ]"},
                                                        {"more_mm", "[ 0, 21 ]"},
                                                        {"l", "[ 133.35, 100 ]"},
                                                        {"q", "[ 0, 0, 0.2 ]"},
                                                        {"a1", "-20.5"},
                                                        {"tilt", "0.3"},
                                                        {"tip", "[ 0, 0, -251 ]"},
                                                        {"m", "[ 0, 0, 0, 0, 0, .Nan ]"},
                                                        {"tip", "[ 0, .Inf, 0 ]"},
                                                        {"m", "[ 0, 0, 0, 0, 0 ]"},
                                                        {"sigma", "[ -1 ]"},
                                                        {"model", "\"phantom7\""},
                                                        {"gain", "[ 0, 0, 0, 0, 0, 0.01 ]"}};
  for (const auto& [key, value] : absurd) {
    const std::string told = refusal(with(good.substr(0), key, value));
    EXPECT_THAT(told, HasSubstr(key)) << key << " " << value;
    EXPECT_THAT(told, testing::Not(HasSubstr("edited"))) << key;
  }
}

TEST_F(RigRecordFile, RefusesUnknownNames) {
  const std::string good = rigRecordText(fullRecord());
  const std::pair<const char*, const char*> wrong[] = {
      {"verdict", "\"blue\""}, {"verdict", "1"},    {"kind", "\"partial\""}, {"n", "-1"},
      {"tre_rms", ".Nan"},     {"tre_max", "-0.1"}, {"method", "\"a b\""},   {"mirror", "\"x y\""},
      {"ipd_mm", "70."},       {"sd_mm", "-1."},    {"plate_mm", "-1."},     {"checked_utc", "\"yesterday\""},
      {"used", "2 }"},         {"worst_mm", "-1."}, {"n_used", "1.5"},       {"duration_s", "-1."}};
  for (const auto& [key, value] : wrong) {
    const std::string told = refusal(with(good, key, value));
    EXPECT_THAT(told, testing::AnyOf(HasSubstr(std::string("'") + key + "'"), HasSubstr(std::string(".") + key + "'"),
                                     HasSubstr("FileStorage")))
        << key << " " << value;
    EXPECT_THAT(told, testing::Not(HasSubstr("edited"))) << key;
  }
}

TEST_F(RigRecordFile, RequiresAKnownDeviceAndNoPersonalNames) {
  RigRecord record = fullRecord();
  const std::string good = rigRecordText(record);
  EXPECT_THAT(refusal(resealed(replaced(good, "model: omni", "model: falcon"))), HasSubstr("'device.model'"));
  record.provenance.operator_code = "Anna Berg";
  EXPECT_THAT(refusal(rigRecordText(record)), HasSubstr("'operator' is not a code"));
  record = fullRecord();
  record.rig.device->model = "falcon";
  EXPECT_THROW(rigRecordText(record), CalibrationError);
  record.rig.device.reset();
  EXPECT_THROW(rigRecordText(record), CalibrationError);
}

TEST_F(RigRecordFile, KeepsTextsUnchanged) {
  for (const char* serial :
       {"", "007", "1e3", "yes", "~", "a: b # c", "q\"uo'te\\x", "[1, 2]", "- x", ".Nan", "null"}) {
    RigRecord record = fullRecord();
    record.rig.device->serial = serial;
    EXPECT_EQ(read(rigRecordText(record)).rig.device->serial, serial);
  }
}

TEST_F(RigRecordFile, IsRefusedOrEqualHoweverItIsDamaged) {
  const RigRecord record = fullRecord();
  const std::string good = rigRecordText(record);
  mutants::forEachMutant({good}, 300, [&](const std::string& bad, std::size_t, std::uint64_t) {
    try {
      EXPECT_EQ(rigRecordText(read(bad)), good);
    } catch (const CalibrationError&) {
    }
  });
}

TEST_F(RigRecordFile, SurvivesDamageUnderAFittingHash) {
  // The hash finds nearly all damage; the blocks behind it must be robust too.
  const std::string good = rigRecordText(fullRecord());
  std::mt19937 rng(8);
  for (int i = 0; i < 300; ++i) {
    std::string bad = good;
    const std::size_t body = bad.rfind("sha256:");
    for (int k = 0; k < 1 + i % 3; ++k) bad[rng() % body] = static_cast<char>(rng() % 256);
    bad = resealed(bad);
    try {
      const RigRecord record = read(bad);
      EXPECT_TRUE(std::isfinite(record.rig.X_WD.translation_mm.x));
      if (record.rig.arm) {
        EXPECT_LE(std::abs(record.rig.arm->gain[0]), 0.1);
      }
    } catch (const CalibrationError&) {
    }
  }
}

// OpenCV's reader hangs on a zero byte after a line.
TEST_F(RigRecordFile, RefusesBytesThatAreNotText) {
  const std::string good = rigRecordText(fullRecord());
  const auto after_a_line = static_cast<std::ptrdiff_t>(good.find('\n', good.find("px:")) + 1);
  for (const char byte : {'\0', '\1', '\x7f'}) {
    std::string spoilt = good;
    spoilt.insert(spoilt.begin() + after_a_line, byte);
    EXPECT_THAT(refusal(spoilt), HasSubstr("bytes that are not text"));
  }
}

TEST_F(RigRecordFile, RefusesDeeplyNestedLists) {
  for (const char* bracket : {"[", "{a:", "- ", "[ \"]\", ", "[ ']', "}) {
    std::string hostile = "%YAML:1.0\n---\nkind: ";
    for (int i = 0; i < 500000; ++i) hostile += bracket;
    EXPECT_THAT(refusal(hostile + "\n"), HasSubstr("64 deep")) << bracket;
  }
}

}  // namespace
}  // namespace calibration
