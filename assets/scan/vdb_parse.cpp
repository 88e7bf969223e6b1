#include "assets/scan/vdb_parse.h"

#include <openvdb/openvdb.h>

#include <algorithm>
#include <cmath>
#include <limits>
#include <new>

#include "assets/load_error.h"
#include "assets/scan/resampling.h"
#include "assets/scan/vdb_leaf.h"
#include "assets/tooth.h"

namespace assets {

namespace {

[[noreturn]] void refuse(const std::string& path, const std::string& reason) {
  throw LoadError(path + ": " + reason + "; import the scan again");
}

/// Dense values of a grid; `convert(value)` throws if out of range.
template <class Grid, class Value, class Convert>
std::vector<Value> dense(const Grid& source, const VolumeGrid& grid, const std::string& path, const Convert& convert) {
  using Tree = typename Grid::TreeType;
  std::vector<Value> values(grid.voxelCount(), convert(source.background()));

  // Tiles: boxes of one value above the leaves, made by pruning.
  auto tile = source.tree().cbeginValueOn();
  tile.setMaxDepth(Tree::ValueOnCIter::LEAF_DEPTH - 1);
  for (; tile; ++tile) {
    openvdb::CoordBBox box;
    tile.getBoundingBox(box);
    const glm::ivec3 low(box.min().x(), box.min().y(), box.min().z());
    const glm::ivec3 high(box.max().x(), box.max().y(), box.max().z());
    if (!grid.contains(low) || !grid.contains(high))
      refuse(path, "grid '" + source.getName() + "' reaches out of its volume");
    const Value value = convert(*tile);
    for (int k = low.z; k <= high.z; ++k)
      for (int j = low.y; j <= high.y; ++j)
        std::fill_n(values.begin() + static_cast<std::ptrdiff_t>(grid.index({low.x, j, k})), high.x - low.x + 1, value);
  }

  for (auto leaf = source.tree().cbeginLeaf(); leaf; ++leaf) {
    const openvdb::CoordBBox box = leaf->getNodeBoundingBox();
    const bool is_inside = box.min().x() > -8 && box.min().y() > -8 && box.min().z() > -8 &&
                           box.min().x() < grid.size.x && box.min().y() < grid.size.y && box.min().z() < grid.size.z;
    if (!is_inside) refuse(path, "grid '" + source.getName() + "' reaches out of its volume");
    const auto* buffer = leaf->buffer().data();
    forEachLeafVoxel({box.min().x(), box.min().y(), box.min().z()}, grid,
                     [&](std::uint32_t offset, std::size_t v) { values[v] = convert(buffer[offset]); });
  }
  return values;
}

template <class Grid>
typename Grid::Ptr gridNamed(const openvdb::GridPtrVec& grids, const char* name, const std::string& path) {
  openvdb::GridBase::Ptr found = openvdb::findGridByName(grids, name);
  if (!found) refuse(path, std::string("it has no grid '") + name + "'");
  auto typed = openvdb::gridPtrCast<Grid>(found);
  if (!typed) refuse(path, std::string("its grid '") + name + "' is of type " + found->type());
  return typed;
}

/// Spacing and origin of a transform that must be a uniform scale and a translation.
void readTransform(const openvdb::math::Transform& transform, VolumeGrid& grid, const std::string& path) {
  const openvdb::Vec3d origin = transform.indexToWorld(openvdb::Vec3d(0.0));
  const openvdb::Vec3d spacing = transform.indexToWorld(openvdb::Vec3d(1.0)) - origin;
  grid.origin_P_mm = {origin.x(), origin.y(), origin.z()};
  const openvdb::Vec3d voxel_mm = transform.voxelSize();
  const bool is_uniform = transform.isLinear() && voxel_mm.x() == voxel_mm.y() && voxel_mm.x() == voxel_mm.z() &&
                          openvdb::math::isApproxEqual(spacing, voxel_mm, openvdb::Vec3d(1.0e-9 * voxel_mm.x()));
  grid.spacing_mm = voxel_mm.x();
  if (!is_uniform) refuse(path, "its voxels are not cubes along the axes");
}

VolumeGrid volumeGridOf(const openvdb::MetaMap& metadata, const openvdb::math::Transform& transform,
                        const std::string& path) {
  const auto schema = metadata.getMetadata<openvdb::Int32Metadata>(kVdbSchemaName);
  if (!schema) refuse(path, "it is not a volume of this program");
  if (schema->value() != kVdbSchema)
    refuse(path, "its schema is " + std::to_string(schema->value()) + ", this program reads 1");
  const auto size = metadata.getMetadata<openvdb::Vec3IMetadata>(kVdbSizeName);
  if (!size) refuse(path, "it does not state its size");
  VolumeGrid grid;
  grid.size = {size->value().x(), size->value().y(), size->value().z()};
  readTransform(transform, grid, path);

  requireValidGeometry({grid.size, glm::dmat3(grid.spacing_mm), grid.origin_P_mm}, path);
  return grid;
}

template <class Value>
Value inRange(double value, const std::string& path) {
  const double nearest = std::round(value);
  if (!(nearest >= std::numeric_limits<Value>::min() && nearest <= std::numeric_limits<Value>::max()))
    refuse(path, "a value of " + std::to_string(value) + " is out of range");
  return static_cast<Value>(nearest);
}

std::uint8_t toothNumber(std::int32_t value, const std::string& path) {
  if (value != 0 && !isToothNumber(value)) refuse(path, std::to_string(value) + " is not a tooth number");
  return static_cast<std::uint8_t>(value);
}

}  // namespace

CtVolume parseVdb(const std::string& path) {
  openvdb::GridPtrVecPtr grids;
  openvdb::MetaMap::Ptr metadata;
  try {
    openvdb::initialize();
    openvdb::io::File file(path);
    file.open(false);
    metadata = file.getMetadata();
    grids = file.getGrids();
  } catch (const std::bad_alloc&) {
    throw;
  } catch (const std::exception&) {
    refuse(path, "it cannot be read as OpenVDB");
  }

  const auto hu = gridNamed<openvdb::FloatGrid>(*grids, "hu", path);
  const auto label = gridNamed<openvdb::Int32Grid>(*grids, "label", path);
  const auto solid = gridNamed<openvdb::FloatGrid>(*grids, "solid", path);
  if (label->transform() != hu->transform() || solid->transform() != hu->transform())
    refuse(path, "its grids have different transforms");

  CtVolume volume;
  volume.grid = volumeGridOf(*metadata, hu->transform(), path);
  volume.hounsfield = dense<openvdb::FloatGrid, std::int16_t>(
      *hu, volume.grid, path, [&](float value) { return inRange<std::int16_t>(value, path); });
  volume.label = dense<openvdb::Int32Grid, std::uint8_t>(
      *label, volume.grid, path, [&](std::int32_t value) { return inRange<std::uint8_t>(value, path); });
  volume.solid = dense<openvdb::FloatGrid, std::uint8_t>(
      *solid, volume.grid, path, [&](float fraction) { return inRange<std::uint8_t>(255.0 * fraction, path); });
  // Volumes older than tooth numbers have none.
  if (openvdb::findGridByName(*grids, "tooth")) {
    const auto tooth = gridNamed<openvdb::Int32Grid>(*grids, "tooth", path);
    if (tooth->transform() != hu->transform()) refuse(path, "its grids have different transforms");
    volume.tooth = dense<openvdb::Int32Grid, std::uint8_t>(
        *tooth, volume.grid, path, [&](std::int32_t value) { return toothNumber(value, path); });
  }
  return volume;
}

}  // namespace assets
