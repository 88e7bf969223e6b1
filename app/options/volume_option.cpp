#include "app/options/volume_option.h"

#include "app/text/command_line.h"
#include "app/text/usage_error.h"
#include "assets/patient.h"
#include "assets/scan/image_file.h"
#include "assets/scan/solid_fraction.h"

namespace app {

void VolumeOption::addTo(CommandLine& command) {
  command.option("--volume", path_, "Volume: .nrrd, .nhdr, .nii, .nii.gz or .mha, frame P = LPS mm").valueNamed("FILE");
  command.option("--field", field_, "What it holds: hu (Hounsfield) or solid (0..255 = solid fraction)")
      .oneOf({"hu", "solid"});
  command.option("--iso", iso_hu_, "hu: grey value of the surface, HU (default 300)");
  command.option("--sigma", sigma_hu_,
                 "hu: width of the soft transition, HU, taken as given (default 75, widened to at least a voxel)");
  command.option("--labels", labels_, "Tissue labels on the same grid").valueNamed("FILE");
}

SolidVolume VolumeOption::load() const {
  if (!given()) throw UsageError("--volume: no volume is given, name an NRRD file");
  SolidVolume volume;
  if (field_ == "solid") {
    if (iso_hu_ || sigma_hu_)
      throw UsageError("--iso and --sigma: they mean nothing for --field solid, leave them out");
    assets::ByteImage image = assets::readSolid(path_);
    volume.grid = image.grid;
    volume.solid = std::move(image.values);
  } else {
    const assets::Classification standard;
    const assets::HounsfieldImage image = assets::readHounsfield(path_);
    volume.grid = image.grid;
    const assets::Classification requested{iso_hu_.value_or(standard.iso_hu), sigma_hu_.value_or(standard.sigma_hu)};
    volume.solid = sigma_hu_ ? assets::solidFromHounsfield(image.hounsfield, requested)
                             : assets::classify(image.grid, image.hounsfield, requested);
  }
  if (!labels_.empty()) {
    assets::ByteImage labels = assets::readLabels(labels_);
    if (!assets::isSameGrid(labels.grid, volume.grid))
      throw UsageError("--labels " + labels_ + ": its grid is not that of the volume, resample it");
    volume.label = std::move(labels.values);
  }
  return volume;
}

}  // namespace app
