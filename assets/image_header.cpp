#include "assets/image_header.h"

#include <fcntl.h>
#include <unistd.h>
#include <zlib.h>

#include <algorithm>
#include <array>
#include <cctype>
#include <filesystem>
#include <fstream>
#include <vector>

#include "assets/load_error.h"

namespace assets {

namespace {

namespace fs = std::filesystem;

constexpr double kDeflateAtBest = 1040.0;  // deflate packs 1032:1 at most (RFC 1951: 258 bytes in 2 bits)
constexpr double kNiftiHeaderBytes = 348.0;

[[noreturn]] void refuse(const std::string& path, const std::string& reason) { throw LoadError(path + ": " + reason); }

std::string lowerCase(std::string text) {
  std::transform(text.begin(), text.end(), text.begin(),
                 [](unsigned char c) { return static_cast<char>(std::tolower(c)); });
  return text;
}

ImageFormat formatOf(const std::string& path) {
  const std::string name = lowerCase(path);
  if (name.ends_with(".nrrd") || name.ends_with(".nhdr")) return ImageFormat::nrrd;
  if (name.ends_with(".nii") || name.ends_with(".nii.gz")) return ImageFormat::nifti;
  if (name.ends_with(".mha") || name.ends_with(".mhd")) return ImageFormat::meta;
  refuse(path, "its name ends in nothing known; give a .nrrd, .nhdr, .nii, .nii.gz, .mha or .mhd file");
}

bool isGzip(const std::string& path) {
  std::ifstream file(path, std::ios::binary);
  return file.get() == 0x1f && file.get() == 0x8b;
}

}  // namespace

ImageHeader::ImageHeader(const std::string& path) : path_(path) {
  std::error_code error;
  if (!fs::exists(path, error)) refuse(path, "there is no such file; check the name");
  if (!fs::is_regular_file(path, error)) refuse(path, "it is not a file; give one volume file");
  format_ = formatOf(path);
  if (!std::ifstream(path)) refuse(path, "it may not be read; check its permissions");
  file_bytes_ = static_cast<double>(fs::file_size(path, error));
  if (format_ == ImageFormat::nifti)
    readNifti();
  else
    readText();
}

void ImageHeader::readNifti() {
  // Byte offsets of NIfTI-1: sizeof_hdr 0, dim[8] 40, datatype 70, qform_code 252, sform_code 254.
  std::array<unsigned char, 348> bytes{};
  gzFile file = gzopen(path_.c_str(), "rb");  // takes packed and plain
  const int got = file == nullptr ? 0 : gzread(file, bytes.data(), bytes.size());
  if (file != nullptr) gzclose_r(file);
  const bool is_little = bytes[0] == 0x5c && bytes[1] == 0x01;
  const bool is_big = bytes[3] == 0x5c && bytes[2] == 0x01;
  if (got != static_cast<int>(bytes.size()) || is_little == is_big)
    refuse(path_, "it is no NIfTI-1 file; export it as NIfTI-1");
  const auto short_at = [&](std::size_t at) {
    const int low = bytes[is_little ? at : at + 1];
    const int high = bytes[is_little ? at + 1 : at];
    return static_cast<std::int16_t>(high << 8 | low);
  };

  const int dimensions = short_at(40);
  bool is_volume = dimensions >= 3 && dimensions <= 7;
  for (int d = 1; is_volume && d <= dimensions; ++d) {
    const int size = short_at(40 + 2 * static_cast<std::size_t>(d));
    is_volume = d <= 3 ? size >= 1 : size == 1;
  }
  if (!is_volume) refuse(path_, "it is no volume of three axes; give one");

  // uint8 2, int16 4, int32 8, float 16, double 64, int8 256, uint16 512, uint32 768, int64 1024, uint64 1280.
  constexpr std::array<int, 10> kScalarTypes = {2, 4, 8, 16, 64, 256, 512, 768, 1024, 1280};
  if (std::find(kScalarTypes.begin(), kScalarTypes.end(), short_at(70)) == kScalarTypes.end())
    refuse(path_, "its voxels are vectors, colours or complex numbers; give a volume with one value per voxel");

  is_oriented_ = short_at(252) > 0 || short_at(254) > 0;
}

void ImageHeader::readText() {
  constexpr std::size_t kLongestText = 1 << 16;
  std::ifstream file(path_, std::ios::binary);
  std::string line;
  while (text_.size() < kLongestText && std::getline(file, line)) {
    data_byte_ += static_cast<std::int64_t>(line.size()) + 1;
    if (!line.empty() && line.back() == '\r') line.pop_back();
    if (format_ == ImageFormat::nrrd && line.empty()) break;
    text_ += '\n' + lowerCase(line);
    if (format_ == ImageFormat::meta && lowerCase(line).starts_with("elementdatafile")) break;
  }
}

/// The value of the line that begins with `name`, or nothing.
std::string ImageHeader::field(const std::string& name) const {
  const std::size_t at = text_.find('\n' + name);
  if (at == std::string::npos) return {};
  const std::size_t from = text_.find_first_not_of(" =:", at + 1 + name.size());
  const std::size_t end = std::min(text_.find('\n', at + 1), text_.size());
  return from < end ? text_.substr(from, end - from) : std::string();
}

void ImageHeader::refuseWithoutPlace() const {
  if (!is_oriented_)
    refuse(path_, "it does not say how it is oriented (qform and sform codes are 0); export it with orientation");
  if (format_ == ImageFormat::nifti) return;

  bool states_spacing = false;
  if (format_ == ImageFormat::meta) {
    states_spacing = !field("elementspacing").empty() || !field("elementsize").empty();
  } else {
    const std::string directions = field("space directions");
    states_spacing =
        !field("spacings").empty() || (!directions.empty() && directions.find("none") == std::string::npos);
  }
  if (!states_spacing) refuse(path_, "it does not say how large its voxels are; export it with spacing");

  // Of NRRD's spaces ITK turns these two into LPS; a file that names none is LPS as ours are.
  const std::string space = format_ == ImageFormat::nrrd ? field("space:") : "";
  if (!space.empty() && space != "left-posterior-superior" && space != "lps" && space != "right-anterior-superior" &&
      space != "ras")
    refuse(path_, "its space '" + space + "' is not understood; export it as left-posterior-superior");
}

bool ImageHeader::holds(double voxel_bytes) const {
  if (format_ == ImageFormat::nifti) {
    const double bytes = kNiftiHeaderBytes + voxel_bytes;
    return isGzip(path_) ? holdsPacked(0, bytes) : file_bytes_ >= bytes;
  }

  const double after_text = static_cast<double>(data_byte_) + voxel_bytes;
  if (format_ == ImageFormat::meta) {
    if (field("elementdatafile") != "local") return true;
    return field("compresseddata") == "true" ? voxel_bytes <= kDeflateAtBest * file_bytes_ : file_bytes_ >= after_text;
  }

  if (!field("data file").empty() || !field("datafile").empty()) return true;
  const std::string encoding = field("encoding");
  if (encoding == "raw") return file_bytes_ >= after_text;
  const bool is_packed = encoding == "gzip" || encoding == "gz";
  const bool follows_text = field("line skip").empty() && field("byte skip").empty();
  return is_packed && follows_text ? holdsPacked(data_byte_, voxel_bytes) : true;
}

/// Unpacks a gzip stream to its end, checksum included.
bool ImageHeader::holdsPacked(std::int64_t from_byte, double bytes) const {
  if (bytes > kDeflateAtBest * file_bytes_) return false;
  const int descriptor = ::open(path_.c_str(), O_RDONLY | O_CLOEXEC);
  if (descriptor < 0) return false;
  ::lseek(descriptor, from_byte, SEEK_SET);
  gzFile stream = gzdopen(descriptor, "rb");
  if (stream == nullptr) {
    ::close(descriptor);
    return false;
  }
  std::vector<char> block(1 << 18);
  double unpacked = 0.0;
  int got = 0;
  while ((got = gzread(stream, block.data(), static_cast<unsigned int>(block.size()))) > 0) unpacked += got;
  return gzclose(stream) == Z_OK && got == 0 && unpacked >= bytes;
}

}  // namespace assets
