// The patient of a tooth preparation: one tooth with its pulp on a fine grid, its neighbours and the bone around beside
// it, in the head it belongs to. The roots' lower part is left out. Neighbours come from the scan itself and are of
// tissue other_teeth, whatever they consist of: what is cut of them counts as a mistake. Frame P, mm. Start-up only;
// some seconds, 6 bytes a voxel.
#pragma once

#include <optional>
#include <string>

#include "assets/patient.h"
#include "assets/synthetic/jaw.h"

namespace app {

/// Of voxels: a margin of 0.5 mm is six of them, and the row fits into 100 MB.
inline constexpr double kPreparedVoxel_mm = 0.08;

struct Restoration {
  std::string ideal;   ///< name of what it is measured against
  std::string caries;  ///< a site of cariesSites(), where a lesion is placed; empty: none
};

/// `jaw`: of the built-in patient; none: a scan. Throws UsageError, beginning with `option`, where the patient has no
/// such tooth, with --caries where no lesion can be placed.
assets::Patient preparedTooth(const assets::Patient& whole, const std::optional<assets::JawParameters>& jaw, int fdi,
                              const Restoration& restoration, const std::string& option);

}  // namespace app
