#include "assets/scan/image_header.h"

#include "assets/load_error.h"
#include "assets/scan/header_text.h"
#include "assets/scan/meta_header.h"
#include "assets/scan/nifti_header.h"
#include "assets/scan/nrrd_header.h"
#include "assets/scan/regular_file.h"

namespace assets {

ImageHeader readImageHeader(const std::string& path) {
  const std::string name = lowerCase(path);
  const auto read = name.ends_with(".nrrd") || name.ends_with(".nhdr")    ? readNrrdHeader
                    : name.ends_with(".nii") || name.ends_with(".nii.gz") ? readNiftiHeader
                    : name.ends_with(".mha") || name.ends_with(".mhd")    ? readMetaHeader
                                                                          : nullptr;
  const RegularFile file(path);
  if (!read)
    throw LoadError(path + ": its extension is not known; give a .nrrd, .nhdr, .nii, .nii.gz, .mha or .mhd file");
  ImageHeader header = read(file);
  requireValidGeometry(header.geometry, path);
  return header;
}

}  // namespace assets
