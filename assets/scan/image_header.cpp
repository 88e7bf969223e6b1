#include "assets/scan/image_header.h"

#include "assets/load_error.h"
#include "assets/scan/header_text.h"
#include "assets/scan/meta_header.h"
#include "assets/scan/nifti_header.h"
#include "assets/scan/nrrd_header.h"
#include "assets/scan/regular_file.h"

namespace assets {

namespace {

ImageHeader readByExtension(const RegularFile& file) {
  const std::string& path = file.path();
  const std::string name = lowerCase(path);
  if (name.ends_with(".nrrd") || name.ends_with(".nhdr")) return readNrrdHeader(file);
  if (name.ends_with(".nii") || name.ends_with(".nii.gz")) return readNiftiHeader(file);
  if (name.ends_with(".mha") || name.ends_with(".mhd")) return readMetaHeader(file);
  throw LoadError(path + ": its extension is not known; give a .nrrd, .nhdr, .nii, .nii.gz, .mha or .mhd file");
}

}  // namespace

ImageHeader readImageHeader(const std::string& path) {
  ImageHeader header = readByExtension(RegularFile(path));
  requireValidGeometry(header.geometry, path);
  return header;
}

}  // namespace assets
