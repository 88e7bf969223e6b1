// Writes small volume files byte by byte, so that the readers are tested against the formats and not against our
// writers. NRRD 4 (teem.sourceforge.net/nrrd/format.html), NIfTI-1 (nifti.nimh.nih.gov), MetaImage
// (itk.org/Wiki/MetaIO). Little endian.
#pragma once

#include <unistd.h>
#include <zlib.h>

#include <array>
#include <cstdint>
#include <cstring>
#include <filesystem>
#include <fstream>
#include <sstream>
#include <string>
#include <vector>

#include <gtest/gtest.h>

#include <glm/glm.hpp>

namespace on_disk {

/// A temporary folder, removed at the end.
class Folder {
 public:
  Folder() { std::filesystem::create_directory(path_); }
  ~Folder() { std::filesystem::remove_all(path_); }
  Folder(const Folder&) = delete;
  Folder& operator=(const Folder&) = delete;
  std::string at(const std::string& name) const { return (path_ / name).string(); }

 private:
  static std::string ownName() {
    const auto* test = testing::UnitTest::GetInstance()->current_test_info();
    return "molar_" + std::to_string(::getpid()) + "_" + test->name();
  }
  std::filesystem::path path_ = std::filesystem::temp_directory_path() / ownName();
};

/// Windows of zlib.
constexpr int kGzip = 15 + 16, kZlib = 15;

/// Through zlib.
inline std::string packed(const std::string& bytes, int window = kGzip) {
  z_stream stream{};
  deflateInit2(&stream, 6, Z_DEFLATED, window, 8, Z_DEFAULT_STRATEGY);
  std::string out(bytes.size() + 200, '\0');
  stream.next_in = reinterpret_cast<Bytef*>(const_cast<char*>(bytes.data()));
  stream.avail_in = static_cast<uInt>(bytes.size());
  stream.next_out = reinterpret_cast<Bytef*>(out.data());
  stream.avail_out = static_cast<uInt>(out.size());
  EXPECT_EQ(deflate(&stream, Z_FINISH), Z_STREAM_END);
  out.resize(stream.total_out);
  deflateEnd(&stream);
  return out;
}

/// First occurrence, which must exist.
inline std::string replaced(std::string text, const std::string& from, const std::string& to) {
  const std::size_t at = text.find(from);
  EXPECT_NE(at, std::string::npos) << from;
  return text.replace(at, from.size(), to);
}

inline void write(const std::string& path, const std::string& bytes) { std::ofstream(path, std::ios::binary) << bytes; }

inline std::string read(const std::string& path) {
  std::ostringstream bytes;
  bytes << std::ifstream(path, std::ios::binary).rdbuf();
  return bytes.str();
}

/// A scan in LPS: column a of `step` is the file's axis a.
struct Scan {
  glm::ivec3 size{0};
  glm::dmat3 step{1.0};
  glm::dvec3 origin{0.0};
};

template <class Value>
std::string bytesOf(const std::vector<Value>& values) {
  return {reinterpret_cast<const char*>(values.data()), values.size() * sizeof(Value)};
}

/// `sign` maps LPS to the named space: {-1,-1,1} for RAS.
inline std::string nrrd(const Scan& scan, const std::string& type, const std::string& data,
                        const std::string& space = "left-posterior-superior", const glm::dvec3& sign = {1, 1, 1}) {
  std::ostringstream text;
  text.precision(17);
  const auto vector = [&](const glm::dvec3& v) {
    text << '(' << v.x * sign.x << ',' << v.y * sign.y << ',' << v.z * sign.z << ')';
  };
  text << "NRRD0004\ntype: " << type << "\ndimension: 3\nspace: " << space << "\nsizes: " << scan.size.x << ' '
       << scan.size.y << ' ' << scan.size.z << "\nspace directions:";
  for (int a = 0; a < 3; ++a) {
    text << ' ';
    vector(scan.step[a]);
  }
  text << "\nkinds: domain domain domain\nendian: little\nencoding: raw\nspace origin: ";
  vector(scan.origin);
  text << "\n\n" << data;
  return text.str();
}

/// MetaIO separates directions and spacing.
inline std::string meta(const Scan& scan, const std::string& type, const std::string& data) {
  std::ostringstream text;
  text.precision(17);
  text << "ObjectType = Image\nNDims = 3\nBinaryData = True\nBinaryDataByteOrderMSB = False\nCompressedData = "
          "False\nTransformMatrix =";
  for (int a = 0; a < 3; ++a) {
    const glm::dvec3 unit = glm::normalize(scan.step[a]);
    text << ' ' << unit.x << ' ' << unit.y << ' ' << unit.z;
  }
  text << "\nOffset = " << scan.origin.x << ' ' << scan.origin.y << ' ' << scan.origin.z
       << "\nElementSpacing = " << glm::length(scan.step[0]) << ' ' << glm::length(scan.step[1]) << ' '
       << glm::length(scan.step[2]) << "\nDimSize = " << scan.size.x << ' ' << scan.size.y << ' ' << scan.size.z
       << "\nElementType = " << type << "\nElementDataFile = LOCAL\n"
       << data;
  return text.str();
}

/// NIfTI-1 single file with an sform; datatype 4 int16, 2 uint8, 16 float, 128 RGB, 32 complex.
inline std::string nifti(const Scan& scan, std::int16_t datatype, std::int16_t bits, const std::string& data,
                         std::int16_t sform_code = 1) {
  std::string header(352, '\0');
  const auto put = [&](std::size_t at, auto value) { std::memcpy(header.data() + at, &value, sizeof value); };
  put(0, std::int32_t{348});
  const std::array<std::int16_t, 8> dim = {3,
                                           static_cast<std::int16_t>(scan.size.x),
                                           static_cast<std::int16_t>(scan.size.y),
                                           static_cast<std::int16_t>(scan.size.z),
                                           1,
                                           1,
                                           1,
                                           1};
  for (std::size_t d = 0; d < 8; ++d) put(40 + 2 * d, dim[d]);
  put(70, datatype);
  put(72, bits);
  put(76, 1.0F);
  for (int a = 0; a < 3; ++a) put(80 + 4 * static_cast<std::size_t>(a), static_cast<float>(glm::length(scan.step[a])));
  put(108, 352.0F);
  put(112, 1.0F);
  header[123] = 2;  // mm
  put(254, sform_code);
  const glm::dvec3 ras(-1, -1, 1);
  for (int p = 0; p < 3; ++p) {
    const std::size_t row = 280 + 16 * static_cast<std::size_t>(p);
    for (int a = 0; a < 3; ++a)
      put(row + 4 * static_cast<std::size_t>(a), static_cast<float>(ras[p] * scan.step[a][p]));
    put(row + 12, static_cast<float>(ras[p] * scan.origin[p]));
  }
  std::memcpy(header.data() + 344, "n+1", 4);
  return header + data;
}

}  // namespace on_disk
