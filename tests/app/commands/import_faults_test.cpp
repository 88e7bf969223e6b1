// Sources that are large, crowded or read-only, and imports that are stopped: one clear line, the source as it was, and
// nothing half-done.
#include <gtest/gtest.h>

#include <algorithm>
#include <chrono>
#include <map>
#include <random>
#include <thread>

#include <fcntl.h>
#include <signal.h>

#include "tests/app/commands/program.h"
#include "tests/assets/import/dicom/dicom_on_disk.h"

namespace app {
namespace {

namespace fs = std::filesystem;

double jawPiece(const glm::dvec3& p_P_mm) {
  const double from_middle_mm = glm::length(p_P_mm - glm::dvec3(8, 36, 46));
  const double random = 43758.5453 * std::sin(glm::dot(p_P_mm, glm::dvec3(12.9898, 78.233, 37.719)));
  return (from_middle_mm < 7.0    ? 1300.0
          : from_middle_mm < 14.0 ? 40.0
                                  : -1000.0) +
         60.0 * (random - std::floor(random));
}

class ImportFaults : public ProgramTest {
 protected:
  void SetUp() override {
    ProgramTest::SetUp();
    fs::create_directories(at("tmp"));
    fs::create_directories(at("scan"));
    fs::create_directories(at("patients"));
    setenv("TMPDIR", at("tmp").c_str(), 1);
    const dicom_on_disk::Series series;
    for (int k = 0; k < series.slices; ++k)
      write("scan/IM" + std::to_string(k), dicom_on_disk::bytesOf(dicom_on_disk::sliceOf(series, k, jawPiece)));
  }
  void TearDown() override {
    unsetenv("TMPDIR");
    ProgramTest::TearDown();
  }

  std::string import() const { return "import " + at("scan") + " --out " + at("patients/one"); }
  void expectImported() {
    const ProgramOutput said = molar(import());
    EXPECT_EQ(said.status, 0) << said.err;
    EXPECT_TRUE(fs::exists(at("patients/one/volume.vdb")));
    expectNothingElse();
  }
  void expectNothingElse() const {
    EXPECT_TRUE(fs::is_empty(at("tmp")));
    for (const auto& entry : fs::directory_iterator(at("patients"))) EXPECT_EQ(entry.path().filename(), "one");
  }
};

TEST_F(ImportFaults, AScanAmongTwentyThousandOtherFilesIsFoundOrRefused) {
  constexpr int kOthers = 20'000 - 64;
  for (int n = 0; n < kOthers; ++n) {
    if (n % 4000 == 0) fs::create_directories(at("scan/viewer" + std::to_string(n / 4000)));
    write("scan/viewer" + std::to_string(n / 4000) + "/page" + std::to_string(n) + ".html", n % 3 == 0 ? "" : "<html>");
  }
  expectImported();
  write("scan/one_more.txt", "x");
  expectRefusal("import " + at("scan") + " --out " + at("patients/two"),
                "scan: more than 20,000 files or 8 GB lie in it; choose the folder of one scan");
  expectNothingElse();
}

TEST_F(ImportFaults, AFolderOfSixGigabytesIsReadByItsHeaders) {
  // Sparse: a disk image without DICOM, and a file that begins like a slice and has no end.
  fs::resize_file(write("scan/disk.img", ""), std::uintmax_t{5} << 30);
  expectImported();
  const std::string slice = read("scan/IM0");
  write("scan/IM900", slice.substr(0, slice.size() - 5000));
  fs::resize_file(at("scan/IM900"), std::uintmax_t{1} << 30);
  fs::remove_all(at("patients/one"));
  const ProgramOutput said = molar("inspect " + at("scan"));
  EXPECT_EQ(said.status, 0) << said.err;
  fs::resize_file(at("scan/disk.img"), std::uintmax_t{8} << 30);
  expectRefusal(import(), "more than 20,000 files or 8 GB");
  expectNothingElse();
}

TEST_F(ImportFaults, AReadOnlyDiscStaysAsItIs) {
  std::map<std::string, fs::file_time_type> before;
  for (const auto& entry : fs::directory_iterator(at("scan"))) {
    before[entry.path().string()] = entry.last_write_time();
    fs::permissions(entry.path(), fs::perms::owner_read | fs::perms::group_read);
  }
  fs::permissions(at("scan"), fs::perms::owner_read | fs::perms::owner_exec);
  const auto folder_before = fs::last_write_time(at("scan"));
  expectImported();
  EXPECT_EQ(fs::last_write_time(at("scan")), folder_before);
  for (const auto& [path, time] : before) EXPECT_EQ(fs::last_write_time(path), time);
  EXPECT_EQ(static_cast<std::size_t>(std::distance(fs::directory_iterator(at("scan")), {})), before.size());
  if (::geteuid() != 0) expectRefusal("import " + at("scan") + " --out " + at("scan/patient"), "patient");
  fs::permissions(at("scan"), fs::perms::owner_all);
}

pid_t beginImport(const std::string& source, const std::string& out, const std::string& said) {
  const pid_t child = ::fork();
  if (child == 0) {
    const int file = ::open(said.c_str(), O_WRONLY | O_CREAT | O_TRUNC, 0600);
    ::dup2(file, 1), ::dup2(file, 2);
    ::execl(MOLAR_PROGRAM, "molar", "import", source.c_str(), "--out", out.c_str(), "--no-face", nullptr);
    ::_exit(127);
  }
  return child;
}

/// An import that a signal ends after some time; its status as waitpid tells it.
int importStoppedBy(int number, std::chrono::microseconds after, const std::string& source, const std::string& out,
                    const std::string& said) {
  const pid_t child = beginImport(source, out, said);
  std::this_thread::sleep_for(after);
  ::kill(child, number);
  int status = 0;
  ::waitpid(child, &status, 0);
  return status;
}

// Wherever it strikes: a whole patient, or none and nothing beside it.
TEST_F(ImportFaults, AStoppedImportLeavesNothing) {
  const auto begun = std::chrono::steady_clock::now();
  expectImported();
  const std::chrono::duration<double> whole = std::chrono::steady_clock::now() - begun;
  fs::remove_all(at("patients/one"));
  std::mt19937 random(11);
  std::uniform_real_distribution<double> share(0.0, 1.0);
  int stopped = 0;
  for (int round = 0; round < 24; ++round) {
    const int number = round % 3 == 0 ? SIGTERM : SIGINT;
    const std::chrono::microseconds after(static_cast<long>(1e6 * whole.count() * share(random)));
    const int status = importStoppedBy(number, after, at("scan"), at("patients/one"), at("said"));
    const bool is_whole = fs::exists(at("patients/one"));
    const bool is_success = WIFEXITED(status) && WEXITSTATUS(status) == 0;
    EXPECT_TRUE(is_whole || !is_success) << read("said");
    expectNothingElse();
    if (is_whole) {
      EXPECT_EQ(molar("inspect " + at("patients/one")).status, 0);
      fs::remove_all(at("patients/one"));
    } else {
      ++stopped;
      const std::string said = read("said");
      // Before the program's first line of its own it is the shell's to say.
      EXPECT_TRUE(said.empty() || said.find("molar: import: stopped, nothing was imported\n") != said.npos) << said;
    }
  }
  EXPECT_GT(stopped, 0);
}

// While the folder is written beside its place, with another thread's hand in it.
TEST_F(ImportFaults, AnImportStoppedAtItsWritingLeavesNothing) {
  int stopped = 0;
  for (int round = 0; round < 40 && stopped < 3; ++round) {
    const pid_t child = beginImport(at("scan"), at("patients/one"), at("said"));
    int status = 0;
    while (::waitpid(child, &status, WNOHANG) == 0) {
      if (!fs::is_empty(at("patients"))) ::kill(child, SIGINT);
      std::this_thread::sleep_for(std::chrono::milliseconds(1));
    }
    expectNothingElse();
    if (!fs::exists(at("patients/one"))) ++stopped;
    EXPECT_TRUE(fs::exists(at("patients/one")) || read("said").find("nothing was imported\n") != std::string::npos);
    fs::remove_all(at("patients/one"));
  }
  EXPECT_GT(stopped, 0);
}

TEST_F(ImportFaults, AKilledImportLeavesNoPatientAndTheNextOneWorks) {
  std::mt19937 random(12);
  std::uniform_real_distribution<double> share(0.0, 1.0);
  const auto begun = std::chrono::steady_clock::now();
  expectImported();
  const std::chrono::duration<double> whole = std::chrono::steady_clock::now() - begun;
  for (int round = 0; round < 8; ++round) {
    fs::remove_all(at("patients/one"));
    importStoppedBy(SIGKILL, std::chrono::microseconds(static_cast<long>(1e6 * whole.count() * share(random))),
                    at("scan"), at("patients/one"), at("said"));
    EXPECT_TRUE(fs::is_empty(at("tmp")));
    if (fs::exists(at("patients/one"))) {
      EXPECT_EQ(molar("inspect " + at("patients/one")).status, 0);
    }
  }
  fs::remove_all(at("patients/one"));
  EXPECT_EQ(molar(import()).status, 0);
}

}  // namespace
}  // namespace app
