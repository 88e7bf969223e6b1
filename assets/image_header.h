// What a volume file says and holds, looked at before a library reads it: the libraries assume 1 mm where no spacing is
// given, fill up missing voxels with zeros, and do not check a packed stream to its end. We refuse such files.
// NRRD (teem.sourceforge.net/nrrd/format.html), MetaImage (itk.org/Wiki/MetaIO), NIfTI-1 (nifti.nimh.nih.gov), by
// extension. Any thread. Reading a header is quick; `holds` unpacks a gzip stream once (about 300 MB/s). Not a reader
// of voxels (image_file.h).
#pragma once

#include <cstdint>
#include <string>

namespace assets {

enum class ImageFormat { nrrd, nifti, meta };

class ImageHeader {
 public:
  /// Throws LoadError: no such file, not readable, an extension we do not know, a NIfTI-1 header of no scalar volume.
  explicit ImageHeader(const std::string& path);

  ImageFormat format() const { return format_; }

  /// Throws LoadError if the file states no voxel spacing, no orientation, or a space that can not be turned into LPS.
  void refuseWithoutPlace() const;

  /// Are there as many bytes of voxels as the header promises? Files whose voxels lie in another file are taken at
  /// their word.
  bool holds(double voxel_bytes) const;

 private:
  std::string field(const std::string& name) const;
  void readText();
  void readNifti();
  bool holdsPacked(std::int64_t from_byte, double bytes) const;

  std::string path_;
  ImageFormat format_;
  std::string text_;            ///< lower case, each line after a newline; empty for NIfTI
  std::int64_t data_byte_ = 0;  ///< where the voxels begin if they follow the text
  bool is_oriented_ = true;     ///< NIfTI: has a qform or an sform
  double file_bytes_ = 0.0;
};

}  // namespace assets
