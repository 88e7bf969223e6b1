#include "assets/scan/nrrd_write.h"

#include <zlib.h>

#include <algorithm>
#include <bit>
#include <cassert>
#include <charconv>
#include <fstream>

#include "assets/load_error.h"

namespace assets {

namespace {

static_assert(std::endian::native == std::endian::little, "voxels are written in memory order");

const char* nameOf(VoxelType type) {
  switch (type) {
    case VoxelType::uint8:
      return "unsigned char";
    case VoxelType::int16:
      return "short";
    default:
      assert(type == VoxelType::float32);
      return "float";
  }
}

/// The shortest text that reads back as the same number.
std::string exact(double value) {
  std::array<char, 32> text{};
  return {text.data(), std::to_chars(text.data(), text.data() + text.size(), value).ptr};
}

/// "(1,0,0)".
std::string vectorText(const std::vector<double>& values) {
  std::string text = "(";
  for (std::size_t a = 0; a < values.size(); ++a) text += (a == 0 ? "" : ",") + exact(values[a]);
  return text + ")";
}

std::string headerOf(const NrrdArray& array) {
  const std::size_t axes = array.size.size();
  std::string sizes, directions, kinds;
  std::vector<double> origin;
  for (std::size_t a = 0; a < axes; ++a) {
    std::vector<double> step(axes, 0.0);
    step[a] = array.spacing_mm;
    sizes += " " + std::to_string(array.size[a]);
    directions += " " + vectorText(step);
    kinds += " domain";
    origin.push_back(array.origin_P_mm[static_cast<int>(a)]);
  }
  const bool is_volume = axes == 3;
  return "NRRD0004\n# teem.sourceforge.net/nrrd/format.html\ntype: " + std::string(nameOf(array.type)) +
         "\ndimension: " + std::to_string(axes) +
         (is_volume ? "\nspace: left-posterior-superior" : "\nspace dimension: " + std::to_string(axes)) +
         "\nsizes:" + sizes + "\nspace directions:" + directions + "\nkinds:" + kinds +
         "\nendian: little\nencoding: gzip\nspace origin: " + vectorText(origin) + "\n\n";
}

/// Level 2 compresses within 10 % of level 9, several times faster.
void writeCompressed(std::span<const std::byte> voxels, std::ostream& file) {
  constexpr int kLevel = 2, kGzip = 15 + 16, kMemory = 8;
  z_stream stream{};
  if (deflateInit2(&stream, kLevel, Z_DEFLATED, kGzip, kMemory, Z_DEFAULT_STRATEGY) != Z_OK) throw std::bad_alloc();
  std::vector<char> compressed(1 << 18);
  constexpr std::size_t kBlock = 1 << 24;
  int state = Z_OK;
  while (state != Z_STREAM_END && file) {
    if (stream.avail_in == 0 && !voxels.empty()) {
      const std::size_t step = std::min(voxels.size(), kBlock);
      stream.next_in = reinterpret_cast<Bytef*>(const_cast<std::byte*>(voxels.data()));  // zlib only reads it
      stream.avail_in = static_cast<uInt>(step);
      voxels = voxels.subspan(step);
    }
    stream.next_out = reinterpret_cast<Bytef*>(compressed.data());
    stream.avail_out = static_cast<uInt>(compressed.size());
    state = deflate(&stream, voxels.empty() ? Z_FINISH : Z_NO_FLUSH);
    file.write(compressed.data(), static_cast<std::streamsize>(compressed.size() - stream.avail_out));
  }
  deflateEnd(&stream);
}

}  // namespace

void writeNrrd(const NrrdArray& array, calibration::OutputFile& file) {
  std::ofstream output(file.temporaryPath(), std::ios::binary | std::ios::trunc);
  output << headerOf(array);
  writeCompressed(array.voxels, output);
  output.close();
  if (!output) throw LoadError(file.path() + ": writing failed; free some disk space or choose another folder");
  file.commit();
}

}  // namespace assets
