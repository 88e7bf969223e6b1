// `molar import` and `molar inspect` from a real server, Debian's Orthanc, by both routes: the patient is that of the
// folder, and nothing of a person is left.
#include <gtest/gtest.h>

#include <memory>

#include <nlohmann/json.hpp>

#include "assets/patient/patient_folder.h"
#include "tests/app/commands/program.h"
#include "tests/app/imaging_server/orthanc.h"
#include "tests/assets/import/dicom/dicom_on_disk.h"
#include "tests/shared_data.h"

namespace app {
namespace {

namespace fs = std::filesystem;
using dicom_on_disk::text;

double bone(const glm::dvec3& p_P_mm) {
  const double from_middle_mm = glm::length(p_P_mm - glm::dvec3(8, 36, 46));
  const double random = 43758.5453 * std::sin(glm::dot(p_P_mm, glm::dvec3(12.9898, 78.233, 37.719)));
  return (from_middle_mm < 7.0    ? 1300.0
          : from_middle_mm < 14.0 ? 40.0
                                  : -1000.0) +
         60.0 * (random - std::floor(random));
}

/// One server for all tests; each has an own folder beside it.
class ServerImport : public ProgramTest {
 protected:
  static void SetUpTestSuite() {
    if (!tests::Orthanc::missing().empty()) return;
    const fs::path folder = fs::path(testing::TempDir()) / ("molar_orthanc_" + std::to_string(getpid()));
    server = std::make_unique<tests::Orthanc>(folder);
    writeSeries(folder / "one", "CANARY-7", "1.2.30", "20260314", "CANARY lower jaw");
    writeSeries(folder / "two", "CANARY-8", "1.2.31", "20250101", "CANARY early");
    writeSeries(folder / "three", "CANARY-8", "1.2.32", "20260202", "CANARY late\x1b[31m");
    for (const char* name : {"one", "two", "three"}) is_filled = server->take(folder / name) && is_filled;
  }
  static void TearDownTestSuite() {
    if (!server) return;
    const fs::path folder = server->at("");
    server.reset();
    fs::remove_all(folder);
  }
  static void writeSeries(const fs::path& folder, const std::string& patient, const std::string& study,
                          const std::string& date, const std::string& description) {
    fs::create_directories(folder);
    const dicom_on_disk::Series series;
    for (int k = 0; k < series.slices; ++k) {
      dicom_on_disk::Elements file = dicom_on_disk::sliceOf(series, k, bone);
      file[0x00100010] = text("PN", "CANARY^NAME");
      file[0x00100020] = text("LO", patient);
      file[0x0020000d] = text("UI", study);
      file[0x0020000e] = text("UI", study + ".1");
      file[0x00080018] = text("UI", study + ".1." + std::to_string(k + 1));
      file[0x00080020] = text("DA", date);
      file[0x00081030] = text("LO", description);
      std::ofstream(folder / ("IM" + std::to_string(k)), std::ios::binary) << dicom_on_disk::bytesOf(file);
    }
  }

  void SetUp() override {
    if (const std::string missing = tests::Orthanc::missing(); !missing.empty())
      GTEST_SKIP() << missing << " is not here: apt-get install orthanc orthanc-dicomweb openssl";
    ASSERT_TRUE(is_filled);
    ProgramTest::SetUp();
    fs::create_directories(at("tmp"));
    fs::create_directories(at("config/molar"));
    setenv("TMPDIR", at("tmp").c_str(), 1);
    setenv("XDG_CONFIG_HOME", at("config").c_str(), 1);
    writeSettings("open sesame");
  }
  void TearDown() override {
    unsetenv("TMPDIR");
    if (server) ProgramTest::TearDown();
  }
  void writeSettings(const std::string& password, bool with_authority = true) {
    write("config/molar/server.toml",
          "[[server]]\nurl = '" + server->url() + "'\nuser = 'reader'\npassword = '" + password + "'\n" +
              (with_authority ? "ca_file = '" + server->at("certificate.pem") + "'\n" : "") + "[[server]]\nurl = '" +
              server->dicomUrl() + "'\nreceive = '127.0.0.1:" + std::to_string(server->receive_port) + "'\n");
    fs::permissions(at("config/molar/server.toml"), fs::perms::owner_read | fs::perms::owner_write);
  }
  /// Of the options, the folder that holds the same files, and what molar said.
  void expectTheFoldersPatient(const std::string& asked, const std::string& folder) {
    const ProgramOutput received = molar("import " + asked + " --out " + at("received"));
    ASSERT_EQ(received.status, 0) << received.err;
    ASSERT_EQ(molar("import " + folder + " --out " + at("copied")).status, 0);
    // An OpenVDB file has a random number in it.
    const assets::Patient one = assets::loadPatient(at("received")), other = assets::loadPatient(at("copied"));
    EXPECT_GT(one.ct.hounsfield.size(), 100'000u);
    EXPECT_TRUE(one.ct.hounsfield == other.ct.hounsfield);
    EXPECT_TRUE(one.ct.solid == other.ct.solid);
    EXPECT_TRUE(one.ct.label == other.ct.label);
    EXPECT_EQ(read("received/patient.toml"), read("copied/patient.toml"));
    EXPECT_EQ(received.err.find("CANARY"), std::string::npos) << received.err;
    EXPECT_TRUE(fs::is_empty(at("tmp")));
    fs::remove_all(at("received"));
    fs::remove_all(at("copied"));
  }

  static inline std::unique_ptr<tests::Orthanc> server;
  static inline bool is_filled = true;
};

TEST_F(ServerImport, EitherRouteGivesTheVolumeOfTheFolder) {
  expectTheFoldersPatient(server->url() + " --find PatientID=CANARY-7", server->at("one"));
  expectTheFoldersPatient(server->dicomUrl() + " --find PatientID=CANARY-7", server->at("one"));
}

class ServerImportRealData : public ServerImport {};

// JPEG 2000, which this server cannot unpack.
TEST_F(ServerImportRealData, PackedPicturesComeAsTheyAre) {
  const std::string folder = tests::sharedData("dicom/synthetic/14_jpeg2000");
  MOLAR_NEEDS(folder);
  ASSERT_TRUE(server->take(folder));
  expectTheFoldersPatient(server->url() + " --find PatientID=SYN1", folder);
  expectTheFoldersPatient(server->dicomUrl() + " --find PatientID=SYN1", folder);
}

TEST_F(ServerImport, OneOfSeveralStudiesIsChosenByItsNumber) {
  for (const std::string& url : {server->url(), server->dicomUrl()}) {
    const std::string asked = "inspect " + url + " --find PatientID=CANARY-8";
    const ProgramOutput said = molar(asked);
    EXPECT_EQ(said.status, 2);
    EXPECT_NE(said.err.find("it has 2 studies for this --find; choose one with --study"), std::string::npos)
        << said.err;
    // Standard error is a file here.
    EXPECT_EQ(said.err.find("CANARY"), std::string::npos) << said.err;
    EXPECT_EQ(said.err.find("2025"), std::string::npos) << said.err;
    const auto report = nlohmann::json::parse(molar(asked + " --study 2 --json").out);
    EXPECT_EQ(report["files"], 64);
    EXPECT_EQ(report["can_be_imported"], true);
    expectRefusal(asked + " --study 3", "so there is no --study 3");
  }
}

TEST_F(ServerImport, StudiesAreListedByDateAndDescriptionOnATerminalAlone) {
  // script(1) gives it a terminal.
  write("line.sh", std::string(MOLAR_PROGRAM) + " inspect " + server->url() + " --find PatientID=CANARY-8\n");
  std::system(("script -qec 'sh " + at("line.sh") + "' /dev/null >'" + at("seen") + "' 2>&1 </dev/null").c_str());
  const std::string seen = read("seen");
  const std::size_t early = seen.find("1) 2025-01-01  CT  CANARY early"),
                    late = seen.find("2) 2026-02-02  CT  CANARY late");
  EXPECT_NE(early, std::string::npos) << seen;
  EXPECT_NE(late, std::string::npos) << seen;
  EXPECT_LT(early, late);
  EXPECT_EQ(seen.find("\x1b[31m"), std::string::npos) << seen;
}

TEST_F(ServerImport, WhatGoesWrongIsOneLineAndNothingIsWritten) {
  const std::string to = " --find PatientID=CANARY-7 --out " + at("patient");
  const std::string web = "import " + server->url() + to;
  writeSettings("wrong");
  expectRefusal(web, "takes neither this password nor token (401)");
  writeSettings("open sesame", false);
  expectRefusal(web, "certificate is not trusted");
  write("config/molar/server.toml", "[[server]]\nurl = 'https://a/b'\npasswort = 'x'\n");
  expectRefusal(web, "passwort");
  writeSettings("open sesame");
  fs::permissions(at("config/molar/server.toml"), fs::perms::group_read, fs::perm_options::add);
  expectRefusal(web, "chmod 600");
  writeSettings("open sesame");
  expectRefusal("import https://no-such-host.invalid/dicom-web" + to, "no such host is known");
  expectRefusal("import https://localhost:" + std::to_string(server->webPort()) + "/elsewhere" + to,
                "certificate is not trusted");  // of another server
  expectRefusal("import http://pacs.example/dicom-web" + to, "give https");
  expectRefusal("import " + server->url() + " --out " + at("patient"), "say whose scan it is");
  expectRefusal("import " + server->url() + " --find PatientID=nobody --out " + at("patient"), "no study for this");
  expectRefusal("import " + server->dicomUrl() + " --find PatientID=nobody --out " + at("patient"),
                "no study for this");
  expectRefusal("import dicom://127.0.0.1:" + std::to_string(server->dicom_port) + "/OTHER" + to, "does not talk to");
  expectRefusal("import dicom://127.0.0.1:" + std::to_string(tests::freePort()) + "/PACS" + to, "nothing answers");
  expectRefusal("import " + at("tmp") + " --find PatientID=1 --out " + at("patient"), "ask a server");
  EXPECT_FALSE(fs::exists(at("patient")));
  EXPECT_TRUE(fs::is_empty(at("tmp")));
}

TEST_F(ServerImport, AServerThatDoesNotKnowMolarIsToldAbout) {
  write("config/molar/server.toml", "[[server]]\nurl = '" + server->dicomUrl() + "'\nae_title = 'STRANGER'\n");
  fs::permissions(at("config/molar/server.toml"), fs::perms::owner_read | fs::perms::owner_write);
  expectRefusal("inspect " + server->dicomUrl() + " --find PatientID=CANARY-7", "does not talk to STRANGER");
  // It sends to MOLAR at another port than the one that is open.
  write("config/molar/server.toml", "[[server]]\nurl = '" + server->dicomUrl() +
                                        "'\nreceive = '127.0.0.1:" + std::to_string(tests::freePort()) + "'\n");
  fs::permissions(at("config/molar/server.toml"), fs::perms::owner_read | fs::perms::owner_write);
  expectRefusal("import " + server->dicomUrl() + " --find PatientID=CANARY-7 --out " + at("patient"),
                "could not send the scan here");
  EXPECT_FALSE(fs::exists(at("patient")));
}

}  // namespace
}  // namespace app
