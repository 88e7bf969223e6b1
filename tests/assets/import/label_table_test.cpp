#include "assets/import/label_table.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <algorithm>

#include "assets/import/foreign_labels.h"
#include "assets/import/label_names.h"
#include "assets/load_error.h"
#include "tests/assets/scan_on_disk.h"
#include "tests/assets/segment/arch_phantom.h"
#include "tests/assets/segment/overlap.h"
#include "tests/refusal.h"

namespace {

using assets::LabelKind;
using assets::LabelMeaning;
using assets::LabelSet;
using assets::meaningOf;

LabelMeaning tooth(int fdi) { return {LabelKind::tooth, fdi, assets::Tissue::unlabelled}; }

TEST(LabelTable, UnderstandsTheNamesOfItsSources) {
  EXPECT_EQ(meaningOf("lower_left_second_premolar_fdi37"), tooth(37));  // the number is believed
  EXPECT_EQ(meaningOf("Lower Right Third Molar (Wisdom Tooth)"), tooth(48));
  EXPECT_EQ(meaningOf("Upper Left Canine"), tooth(23));
  EXPECT_EQ(meaningOf("lower_right_first_molar_pulp_fdi146"), (LabelMeaning{LabelKind::pulp, 46, {}}));
  for (const char* name : {"Mandible", "Lower Jawbone", "MAND", "mandible"})
    EXPECT_EQ(meaningOf(name).kind, LabelKind::mandible) << name;
  for (const char* name : {"Left Inferior Alveolar Canal", "Mandibular canal", "right_inferior_alveolar_canal"})
    EXPECT_EQ(meaningOf(name).kind, LabelKind::canal) << name;
  EXPECT_EQ(meaningOf("Lower Teeth").kind, LabelKind::teeth);
  for (const char* name : {"Upper Skull", "Maxilla", "Upper Teeth", "left_mandibular_incisive_canal", "lingual_canal",
                           "Root canal", "Bridge", "Left Maxillary Sinus", "", "background", "tooth_fdi99"})
    EXPECT_EQ(meaningOf(name).kind, LabelKind::nothing) << name;
}

TEST(LabelTable, TellsBothNumberingsOfToothFairyApart) {
  std::array<bool, 256> values{};
  values[1] = values[33] = true;
  EXPECT_FALSE(assets::labelTable(LabelSet::toothfairy, values));  // 33 in one, 37 in the other
  values[19] = true;
  EXPECT_EQ((*assets::labelTable(LabelSet::toothfairy, values))[33], tooth(37));
  EXPECT_EQ((*assets::labelTable(LabelSet::toothfairy, values))[19], tooth(21));
  values[19] = false, values[48] = true;
  EXPECT_EQ((*assets::labelTable(LabelSet::toothfairy, values))[33], tooth(33));
  EXPECT_EQ((*assets::labelTable(LabelSet::toothfairy_contiguous, values))[42], tooth(48));
  EXPECT_EQ((*assets::labelTable(LabelSet::dental_segmentator, values))[2].kind, LabelKind::mandible);
  EXPECT_EQ((*assets::labelTable(LabelSet::total_segmentator, values))[77].kind, LabelKind::pulp);
}

TEST(LabelNames, AreReadFromEachKindOfFile) {
  EXPECT_EQ(assets::namesInNrrdHeader("NRRD0004\ntype: uchar\nSegment0_LabelValue:=2\nSegment0_Name:=Mandible\r\n"
                                      "Segment1_Name:=Lower Teeth\nSegment1_LabelValue:=4\n\nSegment2_Name:=x"),
            (std::map<int, std::string>{{2, "Mandible"}, {4, "Lower Teeth"}}));
  EXPECT_EQ(assets::namesInLabelTable("<LabelTable><Label Key=\"1\" Red=\"0\"><![CDATA[mandible]]></Label>"
                                      "<Label Key=\"28\">x_fdi32</Label><Label Key=\"bad\">y</Label><Label Key=\"3\">"),
            (std::map<int, std::string>{{1, "mandible"}, {28, "x_fdi32"}}));
  EXPECT_EQ(assets::namesInDataset(R"({"labels": {"background": 0, "Mandible": 2, "nested": [1]}})"),
            (std::map<int, std::string>{{0, "background"}, {2, "Mandible"}}));
  EXPECT_EQ(assets::namesInDataset(R"({"labels": {"3": "Canal"}})"), (std::map<int, std::string>{{3, "Canal"}}));
  for (const char* bad : {"", "{", "[]", R"({"labels": 3})", R"({"labels": {"a": -1}})"})
    EXPECT_TRUE(assets::namesInDataset(bad).empty()) << bad;
}

TEST(FillHoles, FillsWhatASliceEncloses) {
  const glm::ivec3 size(9, 9, 9);
  std::vector<std::uint8_t> is_in(assets::countIn(size));
  assets::forVoxels(glm::ivec3(2), glm::ivec3(7), [&](glm::ivec3 ijk) {
    const bool is_wall = glm::any(glm::equal(ijk, glm::ivec3(2))) || glm::any(glm::equal(ijk, glm::ivec3(6)));
    is_in[assets::indexIn(size, ijk)] = is_wall ? 1 : 0;
  });
  is_in[assets::indexIn(size, {4, 4, 2})] = 0;  // a hole in the wall
  assets::fillHoles(size, is_in);
  EXPECT_EQ(std::ranges::count(is_in, 1), 125);
}

/// A jaw of shell and marrow with two teeth and a canal, half as fine as the scan and shifted by a voxel of it.
struct Labelled {
  assets::CtVolume ct;
  on_disk::Folder folder;
  std::vector<std::uint8_t> values;

  Labelled() {
    ct.grid = {{40, 40, 40}, 0.5, {0, 0, 0}};
    ct.hounsfield.assign(ct.grid.voxelCount(), 60);
    values.assign(20 * 20 * 20, 0);
    assets::forVoxels(glm::ivec3(0), glm::ivec3(20), [&](glm::ivec3 c) {
      const bool is_jaw = c.x >= 3 && c.x < 17 && c.y >= 3 && c.y < 17 && c.z >= 3 && c.z < 10;
      const bool is_marrow = c.x >= 4 && c.x < 16 && c.y >= 4 && c.y < 16 && c.z >= 4 && c.z < 9;
      std::uint8_t value = is_jaw && !is_marrow ? 2 : 0;
      if (c.y == 10 && c.z == 5 && is_marrow) value = 5;
      if (c.z >= 8 && c.z < 14 && c.y >= 8 && c.y < 11) {
        if (c.x >= 4 && c.x < 7) value = 48;
        if (c.x >= 13 && c.x < 16) value = 38;
      }
      values[assets::indexIn(glm::ivec3(20), c)] = value;
    });
    assets::forVoxels(ct.grid, [&](glm::ivec3 ijk, std::size_t v) {
      const std::uint8_t value = values[assets::indexIn(glm::ivec3(20), ijk / 2)];
      ct.hounsfield[v] = value == 2 ? 1250 : value == 48 || value == 38 ? (ijk.z > 24 ? 2500 : 1650) : 300;
    });
  }

  std::string file(const std::string& keys, double shift_mm = 0.0) const {
    const on_disk::Scan scan{{20, 20, 20}, glm::dmat3(1.0), glm::dvec3(0.25 + shift_mm)};
    on_disk::write(folder.at("labels.nrrd"), on_disk::replaced(on_disk::nrrd(scan, "uchar", on_disk::bytesOf(values)),
                                                               "encoding: raw\n", "encoding: raw\n" + keys));
    return folder.at("labels.nrrd");
  }
};

constexpr const char* kNames =
    "Segment0_Name:=Mandible\nSegment0_LabelValue:=2\nSegment1_Name:=tooth fdi48\nSegment1_LabelValue:=48\n"
    "Segment2_Name:=tooth fdi38\nSegment2_LabelValue:=38\nSegment3_Name:=Mandibular canal\nSegment3_LabelValue:=5\n";

TEST(ForeignLabels, BecomeTissuesAndTeethOfTheScan) {
  Labelled jaw;
  const std::string path = jaw.file(kNames);
  const auto remarks = assets::takeForeignLabels(path, assets::foreignLabelTable(path, {}), jaw.ct);
  EXPECT_TRUE(remarks.empty());
  const auto at = [&](glm::ivec3 coarse) { return jaw.ct.grid.index(2 * coarse); };
  using assets::Tissue;
  EXPECT_EQ(Tissue{jaw.ct.label[at({3, 3, 5})]}, Tissue::cortical);
  EXPECT_EQ(Tissue{jaw.ct.label[at({8, 6, 6})]}, Tissue::trabecular);  // marrow that the file leaves out
  EXPECT_EQ(Tissue{jaw.ct.label[at({8, 10, 5})]}, Tissue::mandibular_canal);
  EXPECT_EQ(Tissue{jaw.ct.label[at({5, 9, 9})]}, Tissue::dentine);
  EXPECT_EQ(Tissue{jaw.ct.label[at({5, 9, 13})]}, Tissue::enamel);
  EXPECT_EQ(jaw.ct.tooth[at({5, 9, 9})], 48);
  EXPECT_EQ(jaw.ct.tooth[at({14, 9, 9})], 38);
  EXPECT_EQ(jaw.ct.label[at({1, 1, 1})], 0);
}

/// Both numberings of ToothFairy, and every other map of one jaw, make the same teeth.
TEST(ForeignLabels, EveryTableMakesTheSameTeethOfOneJaw) {
  const auto toothfairy = [](std::uint8_t fdi) -> int {
    return fdi == 0 ? 0 : fdi == 2 ? 1 : fdi == 5 ? 4 : fdi;  // as Labelled has mandible and canal
  };
  const auto contiguous = [&](std::uint8_t value) -> int {
    return value == 48 ? 42 : value == 38 ? 34 : toothfairy(value);
  };
  const auto molar = [](std::uint8_t value) -> int { return value == 2 ? 1 : value == 5 ? 7 : value > 30 ? 3 : 0; };
  const auto made = [](LabelSet set, const auto& value_of) {
    Labelled jaw;
    for (std::uint8_t& value : jaw.values) value = static_cast<std::uint8_t>(value_of(value));
    const std::string path = jaw.file("");
    assets::takeForeignLabels(path, assets::foreignLabelTable(path, set), jaw.ct);
    return jaw.ct;
  };
  const assets::CtVolume fdi = made(LabelSet::toothfairy_fdi, toothfairy);
  EXPECT_GT(std::ranges::count(fdi.tooth, std::uint8_t{48}), 100);
  EXPECT_GT(std::ranges::count(fdi.tooth, std::uint8_t{38}), 100);
  for (const LabelSet set : {LabelSet::toothfairy_contiguous, LabelSet::total_segmentator}) {
    const assets::CtVolume other = made(set, contiguous);
    EXPECT_TRUE(other.tooth == fdi.tooth);
    EXPECT_TRUE(other.label == fdi.label);
  }
  const auto bone = [](const assets::CtVolume& ct) {
    return std::ranges::count_if(ct.label, [](std::uint8_t label) { return label == 1 || label == 2; });
  };
  for (const LabelSet set : {LabelSet::dental_segmentator, LabelSet::craniofacial, LabelSet::amasss}) {
    const assets::CtVolume other = made(set, [&](std::uint8_t value) {
      return value != 2 ? 0 : set == LabelSet::dental_segmentator ? 2 : 1;
    });
    EXPECT_NEAR(static_cast<double>(bone(other)), static_cast<double>(bone(fdi)), 0.2 * static_cast<double>(bone(fdi)))
        << static_cast<int>(set);
  }
  EXPECT_GT(std::ranges::count(made(LabelSet::molar, molar).label, std::uint8_t{7}), 20);
}

/// DentalSegmentator's teeth are one value: 16 of a whole arch are told apart and have their numbers.
TEST(ForeignLabels, TeethOfOneLabelAreDividedAndNumbered) {
  const tests::ArchPhantom phantom = tests::archPhantom({.missing = {36}, .spacing_mm = 0.8});
  assets::CtVolume ct;
  ct.grid = phantom.grid, ct.hounsfield = phantom.hounsfield;
  std::vector<std::uint8_t> values(ct.hounsfield.size(), 0);
  for (std::size_t v = 0; v < values.size(); ++v)
    values[v] = phantom.tooth[v] != 0 ? std::uint8_t{4} : phantom.jaw[v] != 0 ? std::uint8_t{2} : std::uint8_t{0};
  const on_disk::Folder folder;
  const on_disk::Scan scan{ct.grid.size, glm::dmat3(ct.grid.spacing_mm), ct.grid.origin_P_mm};
  on_disk::write(folder.at("labels.nrrd"), on_disk::nrrd(scan, "uchar", on_disk::bytesOf(values)));
  const std::string path = folder.at("labels.nrrd");
  const auto remarks =
      assets::takeForeignLabels(path, assets::foreignLabelTable(path, LabelSet::dental_segmentator), ct);
  ASSERT_FALSE(remarks.empty());
  EXPECT_THAT(remarks.front(), testing::HasSubstr("divided into 15"));
  for (const auto& [fdi, overlap] : tests::toothOverlaps(ct.tooth, phantom.tooth)) {
    EXPECT_EQ(overlap.found_fdi, fdi);
    EXPECT_GT(overlap.dice, 0.9) << fdi;
  }
}

std::string refusalOf(Labelled& jaw, const std::string& path, const std::optional<LabelSet>& set = {}) {
  return tests::refusalOf<assets::LoadError>(
      [&] { assets::takeForeignLabels(path, assets::foreignLabelTable(path, set), jaw.ct); });
}

TEST(ForeignLabels, AreRefusedWhereTheyCannotBeMeant) {
  Labelled jaw;
  EXPECT_THAT(refusalOf(jaw, jaw.file("")), testing::HasSubstr("--label-set: molar, dentalsegmentator"));
  EXPECT_THAT(refusalOf(jaw, jaw.file(kNames, 15.0)), testing::HasSubstr("less than half"));
  EXPECT_THAT(refusalOf(jaw, jaw.file("Segment0_Name:=Skull\nSegment0_LabelValue:=2\n")),
              testing::HasSubstr("nothing of a lower jaw"));
  EXPECT_EQ(refusalOf(jaw, jaw.file(""), LabelSet::toothfairy), "accepted");
  for (std::uint8_t& value : jaw.values) value = value == 48 ? 38 : value == 38 ? 48 : value;
  EXPECT_THAT(refusalOf(jaw, jaw.file(kNames)), testing::HasSubstr("left lie on the right"));
}

}  // namespace
