// A damaged scan is refused in one line or read exactly as stored.
#include <gtest/gtest.h>

#include <cstring>
#include <functional>
#include <map>

#include "assets/load_error.h"
#include "assets/scan/image_file.h"
#include "tests/assets/scan_on_disk.h"
#include "tests/mutants.h"
#include "tests/refusal.h"

namespace {

const on_disk::Scan kSmall{{5, 6, 7}, glm::dmat3(0.5), {10, -20, 30}};

std::vector<std::int16_t> greys() {
  std::vector<std::int16_t> values(210);
  for (std::size_t v = 0; v < values.size(); ++v) values[v] = static_cast<std::int16_t>(37 * v % 2200 - 1000);
  return values;
}

std::string asText() {
  std::string text;
  for (const std::int16_t value : greys()) text += std::to_string(value) + ' ';
  return text;
}

/// A valid file: its header, the coding of its voxels, and its data files.
struct Seed {
  std::string name;
  std::string header;
  std::string voxels;
  bool is_raw = true;
  std::map<std::string, std::string> beside = {};
};

std::vector<Seed> nrrdSeeds() {
  const std::string raw = on_disk::bytesOf(greys());
  const std::string head = on_disk::nrrd(kSmall, "short", "");
  const std::string detached = head.substr(0, head.size() - 1);
  std::map<std::string, std::string> slices;
  std::string list;
  for (int k = 0; k < 7; ++k) {
    const std::string name = "s" + std::to_string(k) + ".raw";
    slices[name] = raw.substr(static_cast<std::size_t>(k) * 60, 60);
    list += name + "\n";
  }
  return {{"a.nrrd", head, raw},
          {"gz.nrrd", on_disk::replaced(head, "raw", "gzip"), on_disk::packed(raw, on_disk::kGzip), false},
          {"txt.nrrd", on_disk::replaced(head, "raw", "ascii"), asText(), false},
          {"one.nhdr", detached + "data file: v.raw\n", "", false, {{"v.raw", raw}}},
          {"list.nhdr", detached + "data file: LIST\n" + list, "", false, slices},
          {"numbered.nhdr", detached + "data file: s%d.raw 0 6 1\n", "", false, slices},
          {"plain.nrrd",
           "NRRD0001\ntype: short\ndimension: 4\nsizes: 1 5 6 7\nspacings: nan 0.5 0.5 0.5\nunits: \"\" \"mm\" \"mm\" "
           "\"mm\"\nendian: little\nencoding: raw\n\n",
           raw}};
}

std::vector<Seed> niftiSeeds() {
  const std::string raw = on_disk::bytesOf(greys());
  const std::string whole = on_disk::nifti(kSmall, 4, 16, raw);
  std::string turned = whole;
  turned[252] = 1, turned[254] = 0;  // the qform alone: half a turn about z, from RAS to LPS
  const float half_a_turn = 1.0F;
  std::memcpy(turned.data() + 264, &half_a_turn, sizeof half_a_turn);
  std::string rescaled = whole;
  const float slope = 2.0F;
  std::memcpy(rescaled.data() + 112, &slope, sizeof slope);
  return {{"a.nii", whole.substr(0, 352), raw},
          {"q.nii", turned.substr(0, 352), raw},
          {"rescaled.nii", rescaled, "", false},
          {"a.nii.gz", on_disk::packed(whole, on_disk::kGzip), "", false}};
}

std::vector<Seed> metaSeeds() {
  const std::string raw = on_disk::bytesOf(greys());
  const std::string head = on_disk::meta(kSmall, "MET_SHORT", "");
  std::map<std::string, std::string> slices;
  std::string list;
  for (int k = 0; k < 7; ++k) {
    const std::string name = "s" + std::to_string(k) + ".raw";
    slices[name] = raw.substr(static_cast<std::size_t>(k) * 60, 60);
    list += name + "\n";
  }
  return {{"a.mha", head, raw},
          {"z.mha", on_disk::replaced(head, "CompressedData = False", "CompressedData = True"),
           on_disk::packed(raw, on_disk::kZlib), false},
          {"txt.mha", on_disk::replaced(head, "BinaryData = True", "BinaryData = False"), asText(), false},
          {"one.mhd", on_disk::replaced(head, "LOCAL", "v.raw"), "", false, {{"v.raw", raw}}},
          {"list.mhd", on_disk::replaced(head, "LOCAL", "LIST 2D") + list, "", false, slices},
          {"numbered.mhd", on_disk::replaced(head, "LOCAL", "s%d.raw 0 6 1"), "", false, slices}};
}

/// Whether the voxels are those after the unchanged header.
void expectTrue(const Seed& seed, const std::string& mutant, const assets::HounsfieldImage& image) {
  ASSERT_EQ(image.hounsfield.size(), image.grid.voxelCount());
  if (seed.header.empty() || !mutant.starts_with(seed.header) || seed.name == "rescaled.nii") return;
  std::vector<std::int16_t> expected = greys();
  if (seed.is_raw) {
    ASSERT_GE(mutant.size(), seed.header.size() + 420);
    std::memcpy(expected.data(), mutant.data() + seed.header.size(), 420);
  } else if (seed.name.starts_with("txt")) {
    return;
  }
  EXPECT_EQ(image.hounsfield, expected) << seed.name;
}

void check(const std::vector<Seed>& seeds) {
  const on_disk::Folder folder;
  std::vector<std::string> good;
  for (const Seed& seed : seeds) {
    for (const auto& [name, bytes] : seed.beside) on_disk::write(folder.at(name), bytes);
    good.push_back(seed.header + seed.voxels);
    on_disk::write(folder.at(seed.name), good.back());
    EXPECT_EQ(tests::refusalOf<assets::LoadError>([&] { assets::readHounsfield(folder.at(seed.name)); }), "accepted")
        << seed.name;
  }
  std::uint64_t refused = 0, tried = 0;
  mutants::forEachMutant(good, 1000, [&](const std::string& mutant, std::size_t which, std::uint64_t) {
    on_disk::write(folder.at(seeds[which].name), mutant);
    const std::string refusal = tests::refusalOf<assets::LoadError>([&] {
      const auto image = assets::readHounsfield(folder.at(seeds[which].name));
      expectTrue(seeds[which], mutant, image);
    });
    ++tried;
    refused += refusal == "accepted" ? 0 : 1;
  });
  if (tried >= mutants::kEnoughToJudge) {
    EXPECT_GT(refused, tried / 4);
    EXPECT_LT(refused, tried);
  }
}

TEST(ScanMutants, NrrdIsReadAsStoredOrRefused) { check(nrrdSeeds()); }
TEST(ScanMutants, NiftiIsReadAsStoredOrRefused) { check(niftiSeeds()); }
TEST(ScanMutants, MetaImageIsReadAsStoredOrRefused) { check(metaSeeds()); }

// Damage in the file with the voxels, not in the header.
TEST(ScanMutants, ADetachedDataFileIsReadAsStoredOrRefused) {
  const on_disk::Folder folder;
  const std::string raw = on_disk::bytesOf(greys());
  on_disk::write(folder.at("a.mhd"), on_disk::replaced(on_disk::meta(kSmall, "MET_SHORT", ""), "LOCAL", "v.raw"));
  mutants::forEachMutant({raw}, 500, [&](const std::string& mutant, std::size_t, std::uint64_t) {
    on_disk::write(folder.at("v.raw"), mutant);
    const std::string refusal = tests::refusalOf<assets::LoadError>([&] {
      const auto image = assets::readHounsfield(folder.at("a.mhd"));
      EXPECT_EQ(on_disk::bytesOf(image.hounsfield), mutant.substr(0, raw.size()));
    });
    if (mutant.size() == raw.size()) {
      EXPECT_EQ(refusal, "accepted");
    }
    if (mutant.size() < raw.size() || mutant.size() > raw.size() + 2) {
      EXPECT_NE(refusal, "accepted");
    }
  });
}

}  // namespace
