#include "assets/scan/vdb_file.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>
#include <openvdb/openvdb.h>

#include <cmath>
#include <cstdlib>
#include <functional>

#include "assets/load_error.h"
#include "assets/scan/file_checksum.h"
#include "tests/assets/scan_on_disk.h"
#include "tests/refusal.h"
#include "tests/shared_data.h"

namespace {

using assets::CtVolume;
using testing::HasSubstr;
using testing::Not;

std::string refusalOf(const std::string& path) {
  return tests::refusalOf<assets::LoadError>([&] { assets::readVdb(path); });
}

/// Air around a block with every grey value; its size leaves the last leaves partly outside.
CtVolume manyValued() {
  CtVolume volume;
  volume.grid = {{37, 45, 51}, 0.4, {41.95, -39.95, 19.95}};
  volume.hounsfield.assign(volume.grid.voxelCount(), -1000);
  volume.label.assign(volume.grid.voxelCount(), 0);
  volume.solid.assign(volume.grid.voxelCount(), 0);
  int hu = -32768;
  for (std::size_t v = 9000; v < volume.grid.voxelCount() && hu < 32768; ++v, ++hu) {
    volume.hounsfield[v] = static_cast<std::int16_t>(hu);
    volume.label[v] = static_cast<std::uint8_t>(v % 256);
    volume.solid[v] = static_cast<std::uint8_t>(v / 7 % 256);
  }
  return volume;
}

void expectEqual(const CtVolume& a, const CtVolume& b) {
  EXPECT_EQ(a.grid, b.grid);
  EXPECT_EQ(a.hounsfield, b.hounsfield);
  EXPECT_EQ(a.label, b.label);
  EXPECT_EQ(a.solid, b.solid);
}

TEST(VdbFile, RoundTripsEveryValueExactly) {
  const on_disk::Folder folder;
  const CtVolume volume = manyValued();
  assets::writeVdb(volume, folder.at("v.vdb"));
  expectEqual(assets::readVdb(folder.at("v.vdb")), volume);
}

TEST(VdbFile, IsAnOpenVdbFileForAnyTool) {
  const on_disk::Folder folder;
  const CtVolume volume = manyValued();
  assets::writeVdb(volume, folder.at("v.vdb"));
  openvdb::io::File file(folder.at("v.vdb"));
  file.open();
  const auto hu = openvdb::gridPtrCast<openvdb::FloatGrid>(file.readGrid("hu"));
  const auto label = openvdb::gridPtrCast<openvdb::Int32Grid>(file.readGrid("label"));
  const auto solid = openvdb::gridPtrCast<openvdb::FloatGrid>(file.readGrid("solid"));
  ASSERT_TRUE(hu && label && solid);
  EXPECT_EQ(hu->background(), -1000.0F);
  const openvdb::Coord ijk(20, 30, 40);
  const std::size_t v = volume.grid.index({20, 30, 40});
  EXPECT_EQ(hu->tree().getValue(ijk), volume.hounsfield[v]);
  EXPECT_EQ(label->tree().getValue(ijk), volume.label[v]);
  EXPECT_FLOAT_EQ(solid->tree().getValue(ijk), static_cast<float>(volume.solid[v]) / 255.0F);
  const openvdb::Vec3d p_P_mm = hu->indexToWorld(ijk);
  EXPECT_NEAR(p_P_mm.x(), 41.95 + 20 * 0.4, 1e-12);
  EXPECT_NEAR(p_P_mm.z(), 19.95 + 40 * 0.4, 1e-12);
  EXPECT_EQ(hu->tree().activeVoxelCount(), 65535u);  // all but the one that is -1000
}

TEST(VdbFileRealData, RefusesFilesOfOtherPrograms) {
  const std::filesystem::path folder = tests::sharedData("vdb");
  MOLAR_NEEDS(folder);
  int files = 0;
  for (const auto& entry : std::filesystem::directory_iterator(folder)) {
    if (entry.path().extension() != ".vdb") continue;
    ++files;
    EXPECT_THAT(refusalOf(entry.path().string()), HasSubstr("import the scan again"));
  }
  EXPECT_GE(files, 8);
}

// Each writes a file with a valid checksum and one error.
std::string refusalWith(const std::function<void(openvdb::GridPtrVec&, openvdb::MetaMap&)>& spoil) {
  const on_disk::Folder folder;
  assets::writeVdb(manyValued(), folder.at("v.vdb"));
  openvdb::io::File file(folder.at("v.vdb"));
  file.open(false);
  openvdb::GridPtrVec grids = *file.getGrids();
  openvdb::MetaMap metadata(*file.getMetadata());
  file.close();
  spoil(grids, metadata);
  openvdb::io::File spoilt(folder.at("spoilt.vdb"));
  spoilt.write(grids, metadata);
  spoilt.close();
  assets::appendChecksum(folder.at("spoilt.vdb"));
  return refusalOf(folder.at("spoilt.vdb"));
}

openvdb::FloatTree& hu(const openvdb::GridPtrVec& grids) {
  return openvdb::gridPtrCast<openvdb::FloatGrid>(grids[0])->tree();
}

TEST(VdbFile, ValidatesItsContent) {
  using Grids = openvdb::GridPtrVec;
  using Meta = openvdb::MetaMap;
  EXPECT_EQ(refusalWith([](Grids&, Meta&) {}), "accepted");
  EXPECT_THAT(refusalWith([](Grids& grids, Meta&) { grids.erase(grids.begin() + 1); }), HasSubstr("no grid 'label'"));
  EXPECT_THAT(refusalWith([](Grids& grids, Meta&) { grids[0]->setName("density"); }), HasSubstr("no grid 'hu'"));
  EXPECT_THAT(refusalWith([](Grids& grids, Meta&) {
                grids[0] = openvdb::Int32Grid::create();
                grids[0]->setName("hu");
              }),
              HasSubstr("type"));
  EXPECT_THAT(refusalWith([](Grids& grids, Meta&) {
                grids[2]->setTransform(openvdb::math::Transform::createLinearTransform(0.5));
              }),
              HasSubstr("different transforms"));
  EXPECT_THAT(refusalWith([](Grids& grids, Meta&) {
                auto uneven = openvdb::math::Transform::createLinearTransform(0.4);
                uneven->preScale(openvdb::Vec3d(1, 1, 2));
                for (auto& grid : grids) grid->setTransform(uneven);
              }),
              HasSubstr("not cubes"));
  EXPECT_THAT(refusalWith([](Grids& grids, Meta&) {
                auto turned = openvdb::math::Transform::createLinearTransform(0.4);
                turned->postRotate(0.3);
                for (auto& grid : grids) grid->setTransform(turned);
              }),
              HasSubstr("not cubes"));
  EXPECT_THAT(refusalWith([](Grids&, Meta& metadata) { metadata.removeMeta("molar_volume_schema"); }),
              HasSubstr("not a volume of this program"));
  EXPECT_THAT(refusalWith([](Grids&, Meta& metadata) {
                metadata.removeMeta("molar_volume_schema");
                metadata.insertMeta("molar_volume_schema", openvdb::Int32Metadata(2));
              }),
              HasSubstr("schema is 2"));
  const auto sized = [](openvdb::Vec3i size) {
    return [size](Grids&, Meta& metadata) {
      metadata.removeMeta("size_ijk");
      metadata.insertMeta("size_ijk", openvdb::Vec3IMetadata(size));
    };
  };
  EXPECT_THAT(refusalWith(sized({0, 10, 10})), HasSubstr("no voxels"));
  EXPECT_THAT(refusalWith(sized({-5, 10, 10})), HasSubstr("no voxels"));
  EXPECT_THAT(refusalWith(sized({2000000000, 2000000000, 2})), HasSubstr("too large"));
  EXPECT_THAT(refusalWith(sized({37, 45, 20})), HasSubstr("reaches out"));
  EXPECT_THAT(refusalWith([](Grids& grids, Meta&) {
                hu(grids).setValueOn({1, 2, 3}, 40000.0F);
              }),
              HasSubstr("out of range"));
  EXPECT_THAT(refusalWith([](Grids& grids, Meta&) {
                hu(grids).setValueOn({1, 2, 3}, std::nanf(""));
              }),
              HasSubstr("out of range"));
  EXPECT_THAT(refusalWith([](Grids& grids, Meta&) {
                hu(grids).setValueOn({1, 2, -30}, 4.0F);
              }),
              HasSubstr("reaches out"));
  EXPECT_THAT(refusalWith([](Grids& grids, Meta&) {
                hu(grids).addTile(1, {4096, 0, 0}, 4.0F, true);
              }),
              HasSubstr("reaches out"));
}

TEST(VdbFile, ReadsTilesThatOtherToolsMake) {
  const on_disk::Folder folder;
  CtVolume volume;
  volume.grid = {{40, 40, 40}, 0.4, {0, 0, 0}};
  volume.hounsfield.assign(64000, 1250);
  volume.label.assign(64000, 1);
  volume.solid.assign(64000, 255);
  assets::writeVdb(volume, folder.at("v.vdb"));
  openvdb::io::File file(folder.at("v.vdb"));
  file.open(false);
  const auto grids = file.getGrids();
  const auto metadata = file.getMetadata();
  file.close();
  for (auto& grid : *grids) grid->pruneGrid();
  ASSERT_EQ(hu(*grids).leafCount(), 0u);
  openvdb::io::File pruned(folder.at("pruned.vdb"));
  pruned.write(*grids, *metadata);
  pruned.close();
  assets::appendChecksum(folder.at("pruned.vdb"));
  expectEqual(assets::readVdb(folder.at("pruned.vdb")), volume);
}

TEST(VdbFile, RefusesAMissingFile) {
  const on_disk::Folder folder;
  EXPECT_THAT(refusalOf(folder.at("none.vdb")), HasSubstr("no such file"));
}

}  // namespace
