// The input volume: `--volume F.nrrd [--field hu/solid] [--iso HU --sigma HU] [--labels L.nrrd]`. Solid fraction: as
// stored, or Phi((HU - iso) / sigma); without --sigma the transition is widened to at least a voxel, as for patients
// (assets::classify). Start-up only.
#pragma once

#include <optional>
#include <string>
#include <vector>

#include "assets/volume_grid.h"

namespace app {

class CommandLine;

struct SolidVolume {
  assets::VolumeGrid grid;
  std::vector<std::uint8_t> solid;
  std::vector<std::uint8_t> label;  ///< empty: unlabelled
};

class VolumeOption {
 public:
  void addTo(CommandLine& command);
  bool given() const { return !path_.empty(); }
  const std::string& path() const { return path_; }
  /// Throws UsageError or assets::LoadError.
  SolidVolume load() const;

 private:
  std::string path_, field_ = "hu", labels_;
  std::optional<double> iso_hu_, sigma_hu_;
};

}  // namespace app
