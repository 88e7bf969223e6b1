// Files on which scan readers have failed, each with the correct answer (data/hostile/README.md).
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <algorithm>
#include <filesystem>
#include <map>
#include <set>

#include "assets/load_error.h"
#include "assets/scan/image_file.h"
#include "tests/shared_data.h"

namespace {

using testing::HasSubstr;
using testing::Not;

const std::map<std::string, std::string> kRefusals = {
    {"no_blank_line.nrrd", "blank line before the voxels is missing"},
    {"long_line.nrrd", "is not a field of an NRRD header"},
    {"nansrow.nii", "its sform holds a value that is not finite"},
    {"nanoff.nii", "its spacing, directions or origin are not finite numbers"},
    {"h6.nii", "its origin is more than 1 km away"},
    {"fmt.mhd", "needs one number, as in 'slice%03d.raw'"},
    {"l2d.mhd", "it lists 1 data files where it needs 24"},
    {"list_empty.mhd", "it lists 0 data files where it needs 24"},
    {"nd.mhd", "its 'ndims' '65536' is not valid"},
    {"nd3.mhd", "its 'ndims' '-3' is not valid"},
    {"half.mhd", "it holds fewer voxels than its header states"},
    {"em.mhd", "it holds fewer voxels than its header states"},
    {"missing_slices.mhd", "its data file 'v001.raw' is not there"},
    {"dot.mhd", "its data file '.' is not a regular file"},
    {"passwd.mhd", "is outside its folder"},
    {"zt.mha", "it is truncated or damaged"},
    {"zc.mha", "damaged"},
    {"zr.mhd", "damaged"},
    {"spacing_nan.nrrd", "its spacings 'nan 0.5 0.5' are not finite numbers"},
    {"spacing_nan3.nrrd", "its spacings"},
    {"dirs_nan.nrrd", "not finite numbers"},
    {"dirs_1e300.nrrd", "mm is outside 0.001 to 50 mm"},
    {"zeropix.nii", "its voxel sizes (pixdim) are not all positive and finite"},
    {"nanpix.nii", "its voxel sizes (pixdim) are not all positive and finite"},
    {"q_inf.nii", "its voxel sizes (pixdim) are not all positive and finite"},
    {"spacing_neg.nrrd", "its spacings '-0.5 0.5 0.5' are not all positive"},
    {"negpix.nii", "its voxel sizes (pixdim) are not all positive and finite"},
    {"vox_offset512.nii", "it holds fewer voxels than its header states"},
    {"u8_255.nrrd", "its values are 8-bit greys"},
    {"units_m.nrrd", "a voxel spacing of 500.000000 mm is outside 0.001 to 50 mm"}};
const std::set<std::string> kRead = {"u16_m1024.nii", "nibscaled.nii.gz"};

TEST(HostileScanRealData, EachIsRefusedInOneLineOrReadCorrectly) {
  const std::filesystem::path folder = tests::sharedData("hostile");
  MOLAR_NEEDS(folder);
  const std::set<std::string> voxels_of_others = {"empty.raw", "half.raw", "v.raw", "zr.zraw"};
  for (const auto& entry : std::filesystem::directory_iterator(folder)) {
    const std::string name = entry.path().filename().string();
    if (name == "README.md" || name == "v.nrrd" || voxels_of_others.contains(name)) continue;
    if (kRead.contains(name)) {
      EXPECT_NO_THROW(assets::readHounsfield(entry.path().string())) << name;
      continue;
    }
    ASSERT_TRUE(kRefusals.contains(name)) << name << ": add the correct answer";
    try {
      assets::readHounsfield(entry.path().string());
      ADD_FAILURE() << name << " was read";
    } catch (const assets::LoadError& error) {
      EXPECT_THAT(error.what(), HasSubstr(kRefusals.at(name)));
      EXPECT_THAT(error.what(), HasSubstr(folder.string()));
      EXPECT_THAT(error.what(), Not(HasSubstr("\n")));
    }
  }
}

TEST(HostileScanRealData, ARescaledNiftiHoldsTheSameBoneAsThePlainFile) {
  const std::filesystem::path folder = tests::sharedData("hostile");
  MOLAR_NEEDS(folder);
  const auto plain = assets::readHounsfield((folder / "v.nrrd").string());
  for (const char* name : {"u16_m1024.nii", "nibscaled.nii.gz"}) {
    const auto rescaled = assets::readHounsfield((folder / name).string());
    const auto [lowest, highest] = std::minmax_element(rescaled.hounsfield.begin(), rescaled.hounsfield.end());
    EXPECT_EQ(rescaled.grid.size, plain.grid.size) << name;
    EXPECT_LT(*lowest, 0) << name;
    EXPECT_GT(*highest, 300) << name;
  }
}

}  // namespace
