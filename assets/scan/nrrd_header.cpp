#include "assets/scan/nrrd_header.h"

#include <cstdint>
#include <map>
#include <optional>
#include <set>
#include <string>
#include <vector>

#include "assets/scan/header_text.h"
#include "assets/scan/nrrd_axes.h"
#include "assets/scan/nrrd_fields.h"
#include "assets/scan/voxel_files.h"

namespace assets {

namespace {

VoxelType typeNamed(const std::string& name, const std::string& path) {
  static const std::map<VoxelType, std::set<std::string>> kNames = {
      {VoxelType::int8, {"signed char", "int8", "int8_t"}},
      {VoxelType::uint8, {"uchar", "unsigned char", "uint8", "uint8_t"}},
      {VoxelType::int16, {"short", "short int", "signed short", "signed short int", "int16", "int16_t"}},
      {VoxelType::uint16, {"ushort", "unsigned short", "unsigned short int", "uint16", "uint16_t"}},
      {VoxelType::int32, {"int", "signed int", "int32", "int32_t"}},
      {VoxelType::uint32, {"uint", "unsigned int", "uint32", "uint32_t"}},
      {VoxelType::int64,
       {"longlong", "long long", "long long int", "signed long long", "signed long long int", "int64", "int64_t"}},
      {VoxelType::uint64, {"ulonglong", "unsigned long long", "unsigned long long int", "uint64", "uint64_t"}},
      {VoxelType::float32, {"float"}},
      {VoxelType::float64, {"double"}}};
  for (const auto& [type, names] : kNames)
    if (names.contains(lowerCase(name))) return type;
  refuseScan(path,
             "its voxels are of type " + printableExcerpt(name) + ", which is not supported; store integers or floats");
}

VoxelCoding codingNamed(const std::string& name, const std::string& path) {
  const std::string word = lowerCase(name);
  if (word == "raw") return VoxelCoding::raw;
  if (word == "gzip" || word == "gz") return VoxelCoding::gzip;
  if (word == "ascii" || word == "text" || word == "txt") return VoxelCoding::text;
  if (word == "hex") return VoxelCoding::hex;
  if (word == "bzip2" || word == "bz2")
    refuseScan(path, "its voxels are compressed with bzip2, which is not supported; export it with gzip or raw");
  refuseScan(path, "its encoding " + printableExcerpt(name) + " is not supported; export it with gzip or raw");
}

bool isBigEndian(const NrrdFields& fields, const ImageHeader& header) {
  const std::string endian = lowerCase(fields["endian"]);
  if (fields.has("endian") && endian != "big" && endian != "little") fields.refuseField("endian");
  const bool matters = bytesOf(header.type) > 1 && header.coding != VoxelCoding::text;
  if (matters && endian.empty()) fields.refuse("it states no byte order (endian)");
  return matters && endian == "big";
}

std::int64_t skip(const NrrdFields& fields, const std::string& field, std::int64_t lowest) {
  if (!fields.has(field)) return 0;
  const auto number = parseInteger(fields[field]);
  if (!number || *number < lowest) fields.refuseField(field);
  return *number;
}

/// Number of files if each holds `file_axes` of the axes in the header.
std::uint64_t filesNeeded(const NrrdFields& fields, std::optional<std::int64_t> file_axes, std::size_t given) {
  const std::vector<std::string> sizes = fields.items("sizes");
  const auto all = static_cast<std::int64_t>(sizes.size());
  const std::int64_t axes = file_axes.value_or(all - 1);
  if (axes < 1 || axes > all) fields.refuseField("datafile");
  const auto size_of = [&](std::int64_t a) {
    return static_cast<std::uint64_t>(parseInteger(sizes[static_cast<std::size_t>(a)]).value_or(0));
  };

  // Files with all axes are slabs of the last one.
  if (axes == all) return given > 0 && size_of(all - 1) % given == 0 ? given : size_of(all - 1);
  std::uint64_t files = 1;
  for (std::int64_t a = axes; a < all; ++a) files *= size_of(a);
  return files;
}

std::vector<VoxelFile> filesOf(const NrrdFields& fields) {
  if (!fields.has("datafile")) return {{fields.path(), fields.endByte()}};
  const std::string name = fields["datafile"];
  const std::vector<std::string> words = wordsOf(name);
  if (words.empty()) fields.refuseField("datafile");
  const auto axes_word = [&](std::size_t w) { return words.size() > w ? parseInteger(words[w]) : std::nullopt; };
  if (isList(name)) {
    if (words.size() > 2 || (words.size() == 2 && !axes_word(1))) fields.refuseField("datafile");
    return listedDataFiles(fields.path(), fields.listedFiles(),
                           filesNeeded(fields, axes_word(1), fields.listedFiles().size()));
  }
  if (words[0].find('%') == std::string::npos) return {dataFile(fields.path(), name)};

  const auto first = axes_word(1), last = axes_word(2), step = axes_word(3), file_axes = axes_word(4);
  if (words.size() < 4 || words.size() > 5 || !first || !last || !step || (words.size() == 5 && !file_axes) ||
      *step == 0)
    fields.refuseField("datafile");
  const NumberedNames names{words[0], *first, *last, *step};
  return numberedDataFiles(fields.path(), names, filesNeeded(fields, file_axes, names.count()));
}

}  // namespace

ImageHeader readNrrdHeader(const RegularFile& file) {
  const NrrdFields fields(file);
  ImageHeader header;
  header.path = fields.path();
  header.geometry = nrrdGeometry(fields);
  header.orientation_known = fields.has("space");
  header.type = typeNamed(fields.required("type"), fields.path());
  header.coding = codingNamed(fields.required("encoding"), fields.path());
  header.is_big_endian = isBigEndian(fields, header);
  header.skipped_lines = skip(fields, "lineskip", 0);
  header.skipped_bytes = skip(fields, "byteskip", kVoxelsAtFileEnd);
  header.files = filesOf(fields);
  return header;
}

}  // namespace assets
