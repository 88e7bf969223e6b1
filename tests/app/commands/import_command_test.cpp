// A DICOM folder becomes a patient folder, or is refused in one line; nothing of a person is found anywhere afterwards.
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <algorithm>
#include <array>
#include <cctype>
#include <cmath>
#include <map>

#include <nlohmann/json.hpp>

#include "tests/app/commands/program.h"
#include "tests/assets/import/dicom/dicom_on_disk.h"
#include "tests/assets/scan_on_disk.h"
#include "tests/shared_data.h"

namespace app {
namespace {

namespace fs = std::filesystem;
using dicom_on_disk::Elements;
using testing::HasSubstr;

/// Bone in soft tissue in air, with noise as a scanner makes it.
double jaw(const glm::dvec3& p_P_mm) {
  const glm::dvec3 from_middle = p_P_mm - glm::dvec3(8, 36, 46);
  const double hu = glm::length(from_middle) < 7.0 ? 1300.0 : glm::length(from_middle) < 14.0 ? 40.0 : -1000.0;
  const double random = 43758.5453 * std::sin(glm::dot(p_P_mm, glm::dvec3(12.9898, 78.233, 37.719)));
  return hu + 60.0 * (random - std::floor(random) - 0.5);
}

class ImportDicom : public ProgramTest {
 protected:
  void SetUp() override {
    ProgramTest::SetUp();
    fs::create_directories(at("tmp"));
    setenv("TMPDIR", at("tmp").c_str(), 1);
  }

  template <class Change>
  void writeSeries(const std::string& folder, const std::string& stem, const Change& change) {
    fs::create_directories(at(folder));
    const dicom_on_disk::Series series;
    for (int k = 0; k < series.slices; ++k) {
      Elements file = dicom_on_disk::sliceOf(series, k, jaw);
      const std::string preamble = change(file, k);
      std::string bytes = dicom_on_disk::bytesOf(file, "1.2.840.10008.1.2.1", preamble);
      if (deflates)
        bytes = dicom_on_disk::bytesOf({}, "1.2.840.10008.1.2.1.99", preamble) +
                on_disk::packed(bytes.substr(dicom_on_disk::bytesOf({}).size()), -15);
      write(folder + "/" + stem + std::to_string(k), bytes);
    }
  }
  void expectNothingOfAPersonIsLeft();

  bool deflates = false;  ///< what writeSeries() writes
};

std::string inUtf16(const std::string& text) {
  std::string wide;
  for (const char letter : text) wide += {letter, '\0'};
  return wide;
}

bool holdsCanary(std::string bytes) {
  std::ranges::transform(bytes, bytes.begin(), [](unsigned char c) { return static_cast<char>(std::tolower(c)); });
  return bytes.find("canary") != bytes.npos || bytes.find(inUtf16("canary")) != bytes.npos;
}

/// Every text that a slice can carry, in the file's own elements, in sequences, in private groups and beside the data.
std::string fillWithCanaries(Elements& file, int) {
  using dicom_on_disk::element;
  using dicom_on_disk::sequence;
  using dicom_on_disk::text;
  // Types by tag of identifying elements of PS3.15 table E.1-1.
  const std::map<std::string, std::vector<std::uint32_t>> tags = {
      {"PN",
       {0x00080090, 0x00081048, 0x00081050, 0x00081060, 0x00081070, 0x00100010, 0x00101001, 0x00101005, 0x00101060,
        0x00102297, 0x00321032, 0x00402010, 0x0040a123}},
      {"LO", {0x00080080, 0x0008103e, 0x00081030, 0x00081040, 0x00100020, 0x00100021, 0x00101000, 0x00101040,
              0x00101090, 0x00102160, 0x00102180, 0x001021f0, 0x00180010, 0x00181000, 0x00181016, 0x00181030,
              0x00184000, 0x00321060, 0x00380010, 0x00380400, 0x00400254, 0x00401001}},
      {"SH",
       {0x00080050, 0x00080094, 0x00081010, 0x00102154, 0x00102203, 0x00200010, 0x00400011, 0x00400009, 0x00402016}},
      {"LT", {0x001021b0, 0x00104000, 0x00204000, 0x00324000, 0x00384000}},
      {"ST", {0x00080081, 0x00080092, 0x00082111, 0x00400280}},
      {"UI", {0x00080018, 0x0020000d, 0x0020000e, 0x00200052, 0x00080014, 0x00020003}},
      {"DA", {0x00080012, 0x00080021, 0x00080022, 0x00080023, 0x00100030, 0x00400244}},
      {"TM", {0x00080013, 0x00080030, 0x00080031, 0x00080032, 0x00100032}},
      {"CS", {0x00080064, 0x00180015, 0x00185100}},
      {"AE", {0x00080054, 0x00400001}},
      {"LO ", {0x00080070, 0x00081090}},
      {"SH ", {0x00181210}},
      {"UT", {0x00880140, 0x40080300}}};
  for (const auto& [type, list] : tags)
    for (const std::uint32_t tag : list)
      if (tag >> 16 != 0x0002) {
        std::string canary = "CANARY^" + std::to_string(tag);
        if (tag % 3 == 0) canary = inUtf16(canary);
        file[tag] = text(type.substr(0, 2), canary);
      }
  // And every other element of the groups that describe persons, places, dates and devices, whatever it is (E.1-1 and
  // more).
  for (const std::uint32_t group : {0x0008u, 0x0010u, 0x0018u, 0x0020u, 0x0032u, 0x0038u, 0x0040u, 0x0054u, 0x0070u,
                                    0x0088u, 0x0400u, 0x3006u, 0x300au, 0x300eu, 0x4000u, 0x4008u})
    for (std::uint32_t number = 0x0001; number < 0x0800; number += 1 + number / 0x0100) {
      const std::uint32_t tag = group << 16 | number;
      constexpr std::array kKinds = {"LO", "PN", "ST", "UC", "UN", "SH"};
      const std::string canary = number % 5 == 0   ? "\x1b$B"
                                                     "CANARY"
                                                     "\x1b(B"            // ISO 2022
                                 : number % 5 == 1 ? "C\xc3\xa4 CANARY"  // UTF-8
                                 : number % 5 == 2 ? inUtf16("CANARY")
                                                   : "CANARY-" + std::to_string(tag);
      if (!file.contains(tag)) file[tag] = text(kKinds[number % kKinds.size()], canary);
    }
  const std::string nested = element(0x00100010, text("PN", "CANARY^NESTED")) +
                             element(0x00081115, sequence({element(0x0008103e, text("LO", "CANARY DEEP"))}));
  file[0x00081140] = sequence({nested, nested});
  file[0x00400275] = sequence({nested});
  file[0x04000561] = sequence({nested});
  file[0x00880200] = sequence({element(0x7fe00010, {"OW", "CANARY ICON."})});
  file[0x00090010] = text("LO", "CANARY PRIVATE");
  file[0x00091001] = {"OB", inUtf16("CANARY")};
  file[0x00191002] = {"UN", "CANARY UNKNOWN"};
  file[0x60000022] = text("LO", "CANARY OVERLAY");
  file[0x60003000] = {"OW", "CANARY PLANE"};
  file[0xfffcfffc] = {"OB", "CANARY TRAIL"};
  std::string preamble = "CANARY PREAMBLE";
  preamble.resize(128, 'x');
  return preamble;
}

void ImportDicom::expectNothingOfAPersonIsLeft() {
  writeSeries("CANARY folder", "CANARY_Name_", fillWithCanaries);
  ASSERT_TRUE(deflates || holdsCanary(read("CANARY folder/CANARY_Name_3")));  // the check itself
  ASSERT_TRUE(holdsCanary("x" + inUtf16("Canary")));
  const std::string source = "'" + at("CANARY folder") + "'";
  std::vector<ProgramOutput> said = {molar("inspect " + source), molar("inspect " + source + " --json"),
                                     molar("import " + source + " --out " + at("patient") + " --json " + at("report")),
                                     molar("inspect " + at("patient") + " --json")};
  EXPECT_EQ(said[2].status, 0) << said[2].err;
  EXPECT_TRUE(fs::exists(at("patient") + "/volume.vdb"));
  EXPECT_THAT(read("patient/deidentified.toml"), HasSubstr("patient = "));
  EXPECT_THAT(read("patient/patient.toml"), HasSubstr("manufacturer = 'other'"));

  // Refusals name a file.
  const std::string name = "CANARY folder/CANARY_Name_9";
  const std::string whole = read(name);
  write(name, whole.substr(0, whole.size() - 3000));
  said.push_back(molar("import " + source + " --out " + at("other") + " --json " + at("refused")));
  EXPECT_EQ(said.back().status, 2);
  EXPECT_THAT(said.back().err, HasSubstr("scan/file 64: the file ends"));
  EXPECT_FALSE(fs::exists(at("other")));
  for (const ProgramOutput& one : said) {
    EXPECT_FALSE(holdsCanary(one.out)) << one.out;
    EXPECT_FALSE(holdsCanary(one.err)) << one.err;
  }
  fs::remove_all(at("CANARY folder"));
  std::size_t files = 0;
  for (const std::string& root : {folder_.string(), dataFolder()}) {
    if (!fs::exists(root)) continue;
    for (const auto& entry : fs::recursive_directory_iterator(root)) {
      EXPECT_FALSE(holdsCanary(entry.path().filename().string())) << entry.path();
      if (!entry.is_regular_file()) continue;
      ++files;
      EXPECT_FALSE(holdsCanary(read(entry.path().lexically_relative(folder_).string()))) << entry.path();
    }
  }
  EXPECT_GE(files, 5U);  // three of the patient, two reports
}

TEST_F(ImportDicom, LeavesNothingOfAPersonAnywhere) { expectNothingOfAPersonIsLeft(); }

TEST_F(ImportDicom, LeavesNothingOfAPersonOfDeflatedFiles) {
  deflates = true;
  expectNothingOfAPersonIsLeft();
}

TEST_F(ImportDicom, SaysEachDefectInOneLineAndWritesNothing) {
  writeSeries("scan", "IM", [](Elements& file, int) {
    file.erase(0x00280030);
    return std::string(128, '\0');
  });
  expectRefusal("import " + at("scan") + " --out " + at("patient"),
                "molar: scan: the size of a pixel is nowhere in the files");
  expectRefusal("import " + at("scan") + " --out " + at("patient") + " --spacing huge", "--spacing huge: give");
  EXPECT_FALSE(fs::exists(at("patient")));
  EXPECT_EQ(molar("import " + at("scan") + " --out " + at("patient") + " --spacing 0.5").status, 0);
  expectRefusal("import " + at("scan") + " --out " + at("b") + " --spacing 0.5 --scale 5,4,3", "--scale 5,4,3: give");
  expectRefusal("import " + at("scan") + " --out " + at("b") + " --without IM999 --spacing 0.5", "not in it");
}

TEST_F(ImportDicom, ReportsSeriesAndVerdictsWithoutImporting) {
  writeSeries("scan", "IM", [](Elements& file, int k) {
    if (k == 20) file[0x00200032] = dicom_on_disk::decimals({-10, 20, 300});
    return std::string(128, '\0');
  });
  const auto report = nlohmann::json::parse(molar("inspect " + at("scan") + " --json").out);
  EXPECT_EQ(report["kind"], "dicom");
  EXPECT_EQ(report["files"], 64);
  EXPECT_EQ(report["series"][0]["slices"], 64);
  EXPECT_EQ(report["series"][0]["packing"], "uncompressed");
  EXPECT_EQ(report["can_be_imported"], false);
  ASSERT_FALSE(report["verdicts"].empty());
  for (const auto& verdict : report["verdicts"]) {
    EXPECT_TRUE(verdict["code"].is_string());
    EXPECT_TRUE(verdict["sentence"].is_string());
    EXPECT_TRUE(verdict["files"].is_array());
  }
}

// A command that copies a label map that was made before: words, not a shell's line.
TEST_F(ImportDicom, TakesTheLabelsOfAnOutsideCommand) {
  writeSeries("scan", "IM", [](Elements&, int) { return std::string(128, '\0'); });
  std::vector<std::uint8_t> labels(64 * 72 * 64, 2);
  const std::string head = on_disk::nifti({{72, 64, 64}, glm::dmat3(0.5), {-10, 20, 30}}, 2, 8, "");
  write("made.nii", head + on_disk::bytesOf(labels));
  write("made.nii.gz", on_disk::packed(read("made.nii")));
  const std::string import = "import " + at("scan") + " --out " + at("patient");
  EXPECT_EQ(molar(import + " --label-set dentalsegmentator --segment-with \"cp '" + at("made.nii.gz") +
                  "' {labels} -- {ct}\"")
                .status,
            2);  // cp has too many files
  EXPECT_FALSE(fs::exists(at("patient")));
  write("copy.sh", "test -s \"$1\" && test -z \"$MOLAR_SECRET\" && cp '" + at("made.nii.gz") + "' \"$2\"\n");
  setenv("MOLAR_SECRET", "token", 1);
  const ProgramOutput said =
      molar(import + " --label-set dentalsegmentator --segment-with 'sh " + at("copy.sh") + " {ct} {labels}'");
  unsetenv("MOLAR_SECRET");
  EXPECT_EQ(said.status, 0) << said.err;
  const auto patient = nlohmann::json::parse(molar("inspect " + at("patient") + " --json").out);
  EXPECT_GT(patient["tissue_mm3"]["cortical"].get<double>(), 1000.0);
  EXPECT_TRUE(fs::is_empty(at("tmp")));
  expectRefusal(import + " --force --segment-with 'no_such_program {ct} {labels}'", "cannot be started");
  expectRefusal(import + " --force --segment-with 'sh {ct}'", "{ct} and {labels}");
  expectRefusal(import + " --force --labels made.nii --segment-with 'sh {ct} {labels}'", "give one of them");
  // A signal to the program ends what it started, too, and leaves nothing of the scan.
  write("stop.sh", "kill -INT $PPID\nsleep 600\n");
  expectRefusal(import + " --force --segment-with 'sh " + at("stop.sh") + " {ct} {labels}'", "stopped");
  EXPECT_TRUE(fs::is_empty(at("tmp")));
}

class ImportDicomRealData : public ImportDicom {};

TEST_F(ImportDicomRealData, APackedFolderIsImportedAndItsPatientLoads) {
  const std::string scan = tests::sharedData("dicom/synthetic/14_jpeg2000");
  MOLAR_NEEDS(scan);
  const ProgramOutput said = molar("import " + scan + " --out " + at("patient"));
  EXPECT_EQ(said.status, 0) << said.err;
  const auto patient = nlohmann::json::parse(molar("inspect " + at("patient") + " --json").out);
  EXPECT_EQ(patient["size"], (nlohmann::json{72, 80, 72}));
  EXPECT_NEAR(patient["spacing_mm"].get<double>(), 0.4, 1e-9);
}

TEST_F(ImportDicomRealData, AScanWithoutLabelsIsAPatientAtOnce) {
  const std::string scan = tests::sharedData("patients/right_third_molar/ct.nrrd");
  MOLAR_NEEDS(scan);
  const ProgramOutput said = molar("import " + scan + " --out " + at("patient") + " --json " + at("report"));
  EXPECT_EQ(said.status, 0) << said.err;
  EXPECT_NE(said.err.find("not confirmed"), std::string::npos) << said.err;
  const auto report = nlohmann::json::parse(read("report"));
  EXPECT_EQ(report["stages"].size(), 10u) << report["stages"];
  EXPECT_EQ(report["jaw"]["teeth"].front()["fdi"], 48);
  const auto patient = nlohmann::json::parse(molar("inspect " + at("patient") + " --json").out);
  EXPECT_EQ(patient["third_molar"]["fdi"], 48);
  const auto plan = nlohmann::json::parse(molar("plan " + at("patient") + " --json").out);
  EXPECT_TRUE(plan["winter_angle"]["value"].is_number());
  EXPECT_TRUE(plan["canal_distance"]["value"].is_number());
}

/// Clicked twice, as a technician would who has looked at the first result.
TEST_F(ImportDicomRealData, ClicksConfirmToothAndCanal) {
  const std::string scan = tests::sharedData("patients/right_third_molar/ct.nrrd");
  MOLAR_NEEDS(scan);
  const std::string import = "import " + scan + " --out " + at("patient");
  ASSERT_EQ(molar(import + " --json " + at("report")).status, 0);
  const auto found = nlohmann::json::parse(read("report"))["jaw"];
  const auto& line = found["canals"][0]["line_P_mm"];
  const nlohmann::json clicks = {{"clicks",
                                  {{{"edit", "number"}, {"fdi", 48}, {"at_P_mm", {found["teeth"][0]["centre_P_mm"]}}},
                                   {{"edit", "canal"}, {"at_P_mm", {line[3], line[line.size() - 4]}}}}}};
  write("clicks.json", clicks.dump());
  const ProgramOutput said = molar(import + " --force --clicks " + at("clicks.json"));
  EXPECT_EQ(said.status, 0) << said.err;
  EXPECT_EQ(said.err.find("not confirmed"), std::string::npos) << said.err;
  EXPECT_TRUE(nlohmann::json::parse(molar("inspect " + at("patient") + " --json").out)["confirmed"]);
  write("clicks.json", R"({"clicks": [{"edit": "no-tooth", "at_P_mm": [[0, 0, 0]]}]})");
  expectRefusal(import + " --force --clicks " + at("clicks.json"), "no tooth was found within 1.5 mm of it");
  EXPECT_TRUE(nlohmann::json::parse(molar("inspect " + at("patient") + " --json").out)["confirmed"]);
}

TEST_F(ImportDicom, AScanWithoutTeethIsRefusedUnlessItsGreyValuesAreEnough) {
  const on_disk::Scan scan{{80, 80, 80}, glm::dmat3(0.5), {0, 0, 0}};
  std::vector<std::int16_t> values(512000, -1000);
  for (std::size_t n = 0; n < values.size(); ++n)
    if (n % 80 > 20 && n % 80 < 60 && n / 80 % 80 > 30) values[n] = n / 6400 > 40 ? 900 : 40;
  write("jaw.nrrd", on_disk::nrrd(scan, "short", on_disk::bytesOf(values)));
  const std::string import = "import " + at("jaw.nrrd") + " --out " + at("patient");
  expectRefusal(import + " --json " + at("report"), "no teeth found: the lower jaw seems toothless");
  EXPECT_FALSE(fs::exists(at("patient")));
  EXPECT_EQ(nlohmann::json::parse(read("report"))["verdicts"][0]["code"], "J2");
  EXPECT_EQ(molar(import + " --grey-only").status, 0);
}

}  // namespace
}  // namespace app
