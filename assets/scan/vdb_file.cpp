#include "assets/scan/vdb_file.h"

#include <openvdb/openvdb.h>

#include <cassert>

#include "assets/load_error.h"
#include "assets/scan/file_checksum.h"
#include "assets/scan/vdb_leaf.h"
#include "assets/scan/vdb_parse.h"

namespace assets {

namespace {

constexpr float kAir = -1000.0F;

/// Sparse grid of the values that are not background.
template <class Grid, class Value, class Convert>
typename Grid::Ptr sparse(const char* name, const VolumeGrid& grid, const std::vector<Value>& values,
                          typename Grid::ValueType background, const Convert& convert) {
  using Leaf = typename Grid::TreeType::LeafNodeType;
  auto result = Grid::create(background);
  result->setName(name);
  result->setGridClass(openvdb::GRID_FOG_VOLUME);
  auto transform = openvdb::math::Transform::createLinearTransform(grid.spacing_mm);
  transform->postTranslate({grid.origin_P_mm.x, grid.origin_P_mm.y, grid.origin_P_mm.z});
  result->setTransform(transform);

  static_assert(Leaf::DIM == kLeafVoxels);
  for (int k = 0; k < grid.size.z; k += kLeafVoxels)
    for (int j = 0; j < grid.size.y; j += kLeafVoxels)
      for (int i = 0; i < grid.size.x; i += kLeafVoxels) {
        auto leaf = std::make_unique<Leaf>(openvdb::Coord(i, j, k), background);
        auto* buffer = leaf->buffer().data();
        forEachLeafVoxel({i, j, k}, grid, [&](std::uint32_t offset, std::size_t v) {
          const auto value = convert(values[v]);
          if (value == background) return;
          buffer[offset] = value;
          leaf->setValueOn(offset);
        });
        if (!leaf->isEmpty()) result->tree().addLeaf(leaf.release());
      }
  return result;
}

}  // namespace

void writeVdb(const CtVolume& volume, const std::string& path) {
  const std::size_t voxels = volume.grid.voxelCount();
  assert(volume.hounsfield.size() == voxels && volume.label.size() == voxels && volume.solid.size() == voxels);
  assert(volume.tooth.empty() || volume.tooth.size() == voxels);
  (void)voxels;
  try {
    openvdb::initialize();
    openvdb::GridCPtrVec grids = {
        sparse<openvdb::FloatGrid>("hu", volume.grid, volume.hounsfield, kAir,
                                   [](std::int16_t hu) { return static_cast<float>(hu); }),
        sparse<openvdb::Int32Grid>("label", volume.grid, volume.label, 0,
                                   [](std::uint8_t label) { return std::int32_t{label}; }),
        sparse<openvdb::FloatGrid>("solid", volume.grid, volume.solid, 0.0F,
                                   [](std::uint8_t solid) { return static_cast<float>(solid) / 255.0F; })};
    if (!volume.tooth.empty())
      grids.push_back(sparse<openvdb::Int32Grid>("tooth", volume.grid, volume.tooth, 0,
                                                 [](std::uint8_t fdi) { return std::int32_t{fdi}; }));
    openvdb::MetaMap metadata;
    metadata.insertMeta(kVdbSchemaName, openvdb::Int32Metadata(kVdbSchema));
    metadata.insertMeta("frame", openvdb::StringMetadata("P: LPS, mm"));
    const glm::ivec3 size = volume.grid.size;
    metadata.insertMeta(kVdbSizeName, openvdb::Vec3IMetadata({size.x, size.y, size.z}));
    openvdb::io::File file(path);
    file.write(grids, metadata);
    file.close();
  } catch (const std::exception&) {
    throw LoadError(path + ": writing failed; free some disk space or choose another folder");
  }
  appendChecksum(path);
}

std::unique_ptr<VolumeInChild> beginVdb(const std::string& path) {
  requireChecksum(path);
  return std::make_unique<VolumeInChild>(path);
}

CtVolume readVdb(const std::string& path) { return beginVdb(path)->take(); }

}  // namespace assets
