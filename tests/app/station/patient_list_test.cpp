#include "app/station/patient_list.h"

#include <gtest/gtest.h>

#include <cstdlib>
#include <filesystem>
#include <fstream>

#include "assets/patient/patient_toml.h"
#include "tests/scratch_folder.h"

namespace app {
namespace {

namespace fs = std::filesystem;

class PatientList : public testing::Test {
 protected:
  PatientList() { setenv("XDG_DATA_HOME", scratch_.file("data").c_str(), 1); }
  ~PatientList() override { unsetenv("XDG_DATA_HOME"); }

  void add(const std::string& name, const std::string& title, int written_s) const {
    const fs::path folder = usualPatientFolder() / name;
    fs::create_directories(folder);
    assets::Patient patient;
    patient.title = title;
    std::ofstream(folder / "patient.toml") << assets::patientToml(patient);
    fs::last_write_time(folder, fs::file_time_type::clock::now() + std::chrono::seconds(written_s));
  }
  std::vector<std::string> names() const {
    std::vector<std::string> names;
    for (const PatientListing& one : listPatients(usualPatientFolder())) names.push_back(one.name);
    return names;
  }

  tests::ScratchFolder scratch_;
};

TEST_F(PatientList, IsEmptyWithoutAFolder) { EXPECT_TRUE(listPatients(usualPatientFolder()).empty()); }

TEST_F(PatientList, ShowsTheNewestFirstUnderTheNameOfItsFolder) {
  add("old one", "imported scan, site unknown", -60);
  add("imported-2026-11-27", "imported scan, lower right third molar (48)", 0);
  const std::vector<PatientListing> list = listPatients(usualPatientFolder());
  ASSERT_EQ(list.size(), 2u);
  EXPECT_EQ(list[0].name, "imported-2026-11-27");
  EXPECT_EQ(list[0].title, "imported scan, lower right third molar (48)");
  EXPECT_EQ(list[0].path, (usualPatientFolder() / "imported-2026-11-27").string());
  EXPECT_EQ(list[1].name, "old one");
}

TEST_F(PatientList, TellsWhatNobodyHasConfirmed) {
  add("mine", "imported scan", 0);
  EXPECT_FALSE(listPatients(usualPatientFolder())[0].is_to_check);
  assets::Patient found;
  found.site = assets::OperativeSite{};
  found.found = assets::Confirmation{};
  std::ofstream(usualPatientFolder() / "mine" / "patient.toml") << assets::patientToml(found);
  EXPECT_TRUE(listPatients(usualPatientFolder())[0].is_to_check);
}

TEST_F(PatientList, LeavesOutWhatIsNoPatientOrCannotStandInALine) {
  add("good", "a", 0);
  add(".part-1-killed", "b", 0);
  add("two\nlines", "c", 0);
  add(std::string(100, 'x'), "d", 0);
  fs::create_directories(usualPatientFolder() / "empty");
  std::ofstream(usualPatientFolder() / "file") << "x";
  add("damaged", "e", 0);
  std::ofstream(usualPatientFolder() / "damaged" / "patient.toml") << "schema = ";
  EXPECT_EQ(names(), std::vector<std::string>{"good"});
}

TEST_F(PatientList, ANewNameIsFreeAndHoldsTheDayAlone) {
  const std::string first = newPatientPath(usualPatientFolder(), 1'795'000'000);
  EXPECT_TRUE(fs::path(first).filename().string().starts_with("imported-2026-11-1")) << first;
  fs::create_directories(first);
  EXPECT_EQ(newPatientPath(usualPatientFolder(), 1'795'000'000), first + "-2");
}

TEST_F(PatientList, APatientIsFoundByItsNameAndPathsStay) {
  add("mine", "a", 0);
  EXPECT_EQ(patientNamed("mine"), (usualPatientFolder() / "mine").string());
  for (const char* text : {"", "other", "./mine", "/tmp", "../patients/mine", ".."})
    EXPECT_EQ(patientNamed(text), text);
}

}  // namespace
}  // namespace app
