#include "assets/image_file.h"

#include <itkMetaImageIO.h>
#include <itkNiftiImageIO.h>
#include <itkNrrdImageIO.h>

#include <algorithm>
#include <cassert>
#include <cctype>
#include <cmath>
#include <iostream>
#include <limits>
#include <memory>
#include <sstream>
#include <type_traits>

#include "assets/image_header.h"
#include "assets/load_error.h"
#include "assets/regrid.h"

namespace assets {

namespace {

using Component = itk::CommonEnums::IOComponent;

[[noreturn]] void refuse(const std::string& path, const std::string& reason) { throw LoadError(path + ": " + reason); }

/// ITK's warnings go nowhere; nor does what MetaIO prints on std::cout and std::cerr while this
/// lives.
class Silence {
 public:
  Silence() : cout_(std::cout.rdbuf(nothing_.rdbuf())), cerr_(std::cerr.rdbuf(nothing_.rdbuf())) {
    itk::Object::SetGlobalWarningDisplay(false);
  }
  ~Silence() {
    std::cout.rdbuf(cout_);
    std::cerr.rdbuf(cerr_);
  }
  Silence(const Silence&) = delete;
  Silence& operator=(const Silence&) = delete;

 private:
  std::ostringstream nothing_;
  std::streambuf* cout_;
  std::streambuf* cerr_;
};

/// Runs a step of the library; whatever it throws becomes our one line.
template <class Step>
auto readingOf(const std::string& path, const Step& step) {
  try {
    const Silence silence;
    return step();
  } catch (const std::bad_alloc&) {
    refuse(path, "there is not enough memory for it; crop it");
  } catch (const std::exception&) {
    refuse(path, "it is truncated, damaged or of a kind that can not be read; export the volume again");
  }
}

std::string lowerCase(std::string text) {
  std::transform(text.begin(), text.end(), text.begin(),
                 [](unsigned char c) { return static_cast<char>(std::tolower(c)); });
  return text;
}

itk::ImageIOBase::Pointer readerOf(ImageFormat format) {
  if (format == ImageFormat::nrrd) return itk::NrrdImageIO::New().GetPointer();
  if (format == ImageFormat::nifti) return itk::NiftiImageIO::New().GetPointer();
  return itk::MetaImageIO::New().GetPointer();
}

/// A file opened as far as its header; nothing allocated for its voxels yet.
class Scan {
 public:
  explicit Scan(const std::string& path) : path_(path) {
    const ImageHeader header(path);
    reader_ = readerOf(header.format());
    reader_->SetFileName(path);
    readingOf(path, [&] {
      if (!reader_->CanReadFile(path.c_str())) throw std::runtime_error("not of this format");
      reader_->ReadImageInformation();
    });
    refuseUnlessScalarVolume();
    header.refuseWithoutPlace();
    readGeometry();
    const glm::dvec3 size(geometry_.size);
    if (!header.holds(size.x * size.y * size.z * reader_->GetComponentSize()))
      refuse(path,
             "it is truncated or damaged: it holds fewer voxels than its header promises; export the volume again");
  }

  const ScanGeometry& geometry() const { return geometry_; }

  /// All values as whole numbers of type `Value`, range-checked.
  template <class Value>
  std::vector<Value> values(const std::string& advice) const;

 private:
  void refuseUnlessScalarVolume() const {
    using Pixel = itk::CommonEnums::IOPixel;
    if (reader_->GetPixelType() != Pixel::SCALAR || reader_->GetNumberOfComponents() != 1)
      refuse(path_, "its voxels are vectors, colours or complex numbers; give a volume with one value per voxel");
    const unsigned int dimensions = reader_->GetNumberOfDimensions();
    bool is_volume = dimensions >= 3;
    for (unsigned int a = 3; a < dimensions; ++a) is_volume = is_volume && reader_->GetDimensions(a) == 1;
    if (!is_volume) refuse(path_, "it has " + std::to_string(dimensions) + " axes; give a volume with three");
  }

  void readGeometry() {
    constexpr auto kLargest = static_cast<itk::SizeValueType>(std::numeric_limits<int>::max());
    for (unsigned int a = 0; a < 3; ++a) {
      const auto size = reader_->GetDimensions(a);
      if (size > kLargest)
        refuse(path_, "it is too large: one of its axes has " + std::to_string(size) + " voxels; crop it");
      const int axis = static_cast<int>(a);
      geometry_.size[axis] = static_cast<int>(size);
      geometry_.origin_P_mm[axis] = reader_->GetOrigin(a);
      const std::vector<double> direction = reader_->GetDirection(a);
      for (int p = 0; p < 3; ++p)
        geometry_.step_P_mm[axis][p] = reader_->GetSpacing(a) * direction.at(static_cast<std::size_t>(p));
    }
  }

  std::string path_;
  itk::ImageIOBase::Pointer reader_;
  ScanGeometry geometry_;
};

/// Rounds to whole numbers; stops at the first value that does not fit.
template <class Value, class Stored>
std::vector<Value> converted(const Stored* stored, std::size_t count, const std::string& path,
                             const std::string& advice) {
  constexpr auto kLowest = std::numeric_limits<Value>::min();
  constexpr auto kHighest = std::numeric_limits<Value>::max();
  std::vector<Value> values(count);
  for (std::size_t v = 0; v < count; ++v) {
    bool fits;
    if constexpr (std::is_floating_point_v<Stored>) {
      if (!std::isfinite(stored[v]))
        refuse(path, "it holds values that are no finite numbers; export the volume again");
      const Stored nearest = std::round(stored[v]);
      fits = nearest >= static_cast<Stored>(kLowest) && nearest <= static_cast<Stored>(kHighest);
      if (fits) values[v] = static_cast<Value>(nearest);
    } else {
      fits = std::in_range<Value>(stored[v]);
      if (fits) values[v] = static_cast<Value>(stored[v]);
    }
    if (!fits)
      refuse(path, "the value " + std::to_string(stored[v]) + " lies outside " + std::to_string(kLowest) + ".." +
                       std::to_string(kHighest) + "; " + advice);
  }
  return values;
}

template <class Value>
std::vector<Value> Scan::values(const std::string& advice) const {
  const std::size_t count = static_cast<std::size_t>(geometry_.size.x) * static_cast<std::size_t>(geometry_.size.y) *
                            static_cast<std::size_t>(geometry_.size.z);
  const std::size_t components = count * reader_->GetComponentSize();
  std::unique_ptr<std::byte[]> bytes;
  readingOf(path_, [&] {
    bytes = std::make_unique_for_overwrite<std::byte[]>(components);
    itk::ImageIORegion whole(reader_->GetNumberOfDimensions());
    for (unsigned int a = 0; a < reader_->GetNumberOfDimensions(); ++a) whole.SetSize(a, reader_->GetDimensions(a));
    reader_->SetIORegion(whole);
    reader_->Read(bytes.get());
  });

  const auto as = [&]<class Stored>(Stored) {
    return converted<Value>(reinterpret_cast<const Stored*>(bytes.get()), count, path_, advice);
  };
  switch (reader_->GetComponentType()) {
    case Component::UCHAR:
      return as(static_cast<unsigned char>(0));
    case Component::CHAR:
      return as(static_cast<signed char>(0));
    case Component::USHORT:
      return as(static_cast<unsigned short>(0));
    case Component::SHORT:
      return as(static_cast<short>(0));
    case Component::UINT:
      return as(0U);
    case Component::INT:
      return as(0);
    case Component::ULONG:
      return as(0UL);
    case Component::LONG:
      return as(0L);
    case Component::ULONGLONG:
      return as(0ULL);
    case Component::LONGLONG:
      return as(0LL);
    case Component::FLOAT:
      return as(0.0F);
    case Component::DOUBLE:
      return as(0.0);
    default:
      refuse(path_, "its voxels are of a type that can not be read; store integers or floats");
  }
}

/// Writes one array as NRRD and puts the file in place.
void writeNrrd(const std::vector<int>& size, double spacing_mm, const glm::dvec3& origin_P_mm, Component component,
               const void* values, OutputFile& file) {
  const std::string& path = file.temporaryPath();
  if (!lowerCase(path).ends_with(".nrrd"))
    refuse(path, "volumes are written as NRRD; choose a name that ends in .nrrd");
  try {
    const Silence silence;
    const auto writer = itk::NrrdImageIO::New();
    const auto dimensions = static_cast<unsigned int>(size.size());
    writer->SetFileName(path);
    writer->SetNumberOfDimensions(dimensions);
    writer->SetPixelType(itk::CommonEnums::IOPixel::SCALAR);
    writer->SetNumberOfComponents(1);
    writer->SetComponentType(component);
    itk::ImageIORegion whole(dimensions);
    for (unsigned int a = 0; a < dimensions; ++a) {
      writer->SetDimensions(a, static_cast<itk::SizeValueType>(size[a]));
      writer->SetSpacing(a, spacing_mm);
      writer->SetOrigin(a, origin_P_mm[static_cast<int>(a)]);
      std::vector<double> direction(dimensions, 0.0);
      direction[a] = 1.0;
      writer->SetDirection(a, direction);
      whole.SetSize(a, static_cast<itk::SizeValueType>(size[a]));
    }
    writer->SetIORegion(whole);

    // The second level of nine packs within a tenth of the best, several times faster.
    writer->SetUseCompression(true);
    writer->SetCompressionLevel(2);
    writer->Write(values);
  } catch (const std::exception&) {
    refuse(path, "writing failed; make room on the disk or choose another place");
  }
  file.commit();
}

std::vector<int> sizeOf(const VolumeGrid& grid) { return {grid.size.x, grid.size.y, grid.size.z}; }

}  // namespace

HounsfieldImage readHounsfield(const std::string& path) {
  const Scan scan(path);
  const Regrid regrid(scan.geometry(), path);
  return {regrid.grid(), regrid.linear(scan.values<std::int16_t>("rescale it to Hounsfield"), kAirHu)};
}

ByteImage readSolid(const std::string& path) {
  const Scan scan(path);
  const Regrid regrid(scan.geometry(), path);
  return {regrid.grid(), regrid.linear(scan.values<std::uint8_t>("store solid as 0..255, or read it as hu"), 0)};
}

ByteImage readLabels(const std::string& path) {
  const Scan scan(path);
  const Regrid regrid(scan.geometry(), path);
  return {regrid.grid(), regrid.nearest(scan.values<std::uint8_t>("store labels as 0..255"), 0)};
}

bool isSameGrid(const VolumeGrid& a, const VolumeGrid& b) {
  if (a.size != b.size) return false;
  const double tolerance_mm = 0.01 * a.spacing_mm;
  const glm::dvec3 first_mm = glm::abs(a.origin_P_mm - b.origin_P_mm);
  const glm::dvec3 last_mm = glm::abs(a.centre_P_mm(a.size - 1) - b.centre_P_mm(b.size - 1));
  return std::max({first_mm.x, first_mm.y, first_mm.z, last_mm.x, last_mm.y, last_mm.z}) <= tolerance_mm;
}

OutputFile nrrdOutput(const std::string& path, bool overwrite) {
  if (!lowerCase(path).ends_with(".nrrd"))
    refuse(path, "volumes are written as NRRD; choose a name that ends in .nrrd");
  return OutputFile(path, overwrite);
}

void writeHounsfield(const VolumeGrid& grid, const std::vector<std::int16_t>& hounsfield, OutputFile& file) {
  assert(hounsfield.size() == grid.voxelCount());
  writeNrrd(sizeOf(grid), grid.spacing_mm, grid.origin_P_mm, Component::SHORT, hounsfield.data(), file);
}

void writeSolid(const VolumeGrid& grid, const std::vector<std::uint8_t>& solid, OutputFile& file) {
  assert(solid.size() == grid.voxelCount());
  writeNrrd(sizeOf(grid), grid.spacing_mm, grid.origin_P_mm, Component::UCHAR, solid.data(), file);
}

void writeDepth(int width_px, int height_px, const std::vector<float>& depth_mm, OutputFile& file) {
  assert(depth_mm.size() == static_cast<std::size_t>(width_px) * static_cast<std::size_t>(height_px));
  writeNrrd({width_px, height_px}, 1.0, glm::dvec3(0.0), Component::FLOAT, depth_mm.data(), file);
}

}  // namespace assets
