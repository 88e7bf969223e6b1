#include "app/case/soft_tissue_source.h"

#include <filesystem>
#include <stdexcept>

#include <fmt/core.h>

#include "app/case/cache_folder.h"
#include "app/text/message.h"
#include "assets/load_error.h"
#include "assets/patient/soft_tissue_file.h"
#include "assets/scenery/soft_tissue_distance.h"

namespace app {

assets::SoftTissueField softTissueAround(const assets::MeshModel& gingiva_P, const assets::MeshModel& face_P,
                                         const assets::SoftTissueRegion& region) {
  const std::uint64_t fingerprint = assets::softTissueFingerprint(gingiva_P, face_P, region);
  const std::filesystem::path file = cacheFolder() / fmt::format("soft-tissue-{:016x}", fingerprint);
  std::error_code ignored;
  if (std::filesystem::exists(file, ignored)) {
    try {
      return assets::readSoftTissue(file.string(), fingerprint);
    } catch (const assets::LoadError&) {
      printMessage("the cached soft tissue cannot be read, computing it again");
    }
  }
  assets::SoftTissueField field =
      assets::softTissueField(assets::softTissueSurfaces(gingiva_P, face_P, region), region);
  try {
    std::filesystem::create_directories(file.parent_path(), ignored);
    assets::writeSoftTissue(field, fingerprint, file.string());
  } catch (const std::runtime_error& error) {
    printMessage(fmt::format("the soft tissue is not cached: {}", error.what()));
  }
  return field;
}

}  // namespace app
