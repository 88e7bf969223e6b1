#include "assets/scan/meta_header.h"

#include <algorithm>
#include <array>
#include <cctype>
#include <cmath>
#include <limits>
#include <map>
#include <optional>

#include "assets/scan/header_text.h"
#include "assets/scan/voxel_files.h"

namespace assets {

namespace {

class MetaHeader {
 public:
  explicit MetaHeader(const RegularFile& file) : path_(file.path()) { readFields(file); }

  ImageHeader header() {
    readSizes();
    ImageHeader header;
    header.path = path_;
    header.geometry = geometry();
    header.orientation_known = has("transformmatrix") || has("rotation") || has("orientation");
    header.type = type();
    header.coding = coding();
    header.is_big_endian = header.coding != VoxelCoding::text && bytesOf(header.type) > 1 && isBigEndian();
    header.files = files();
    skipHeader(header);
    return header;
  }

 private:
  void readFields(const RegularFile& file) {
    HeaderText text(file);
    while (const auto line = text.line()) {
      if (trimmed(*line).empty()) continue;
      const std::size_t sign = line->find_first_of("=:");
      const std::string name = lowerCase(trimmed(line->substr(0, sign)));
      if (sign == std::string::npos || !isName(name))
        refuseScan(path_, "line " + std::to_string(text.lineNumber()) + " is not a field of a MetaImage header" +
                              kExportAgain);
      if (!value_.emplace(name, trimmed(line->substr(sign + 1))).second)
        refuseScan(path_, "its header has " + printableExcerpt(name) + " twice" + kExportAgain);
      if (name != "elementdatafile") continue;
      end_byte_ = text.nextByte();
      if (isList(value_[name]))
        while (const auto listed = text.line())
          if (const std::string each = trimmed(*listed); !each.empty()) listed_files_.push_back(each);
      return;
    }
    refuseScan(path_, std::string("it is not a MetaImage file, or its header has no ElementDataFile") + kExportAgain);
  }

  static bool isName(const std::string& name) {
    constexpr std::size_t kMaxName = 128;
    return !name.empty() && name.size() <= kMaxName &&
           std::all_of(name.begin(), name.end(), [](char c) { return c > ' ' && c <= '~'; });
  }

  bool has(const std::string& name) const { return value_.contains(name); }
  std::string value(const std::string& name) const {
    const auto found = value_.find(name);
    return found == value_.end() ? std::string() : found->second;
  }
  /// Value of the first of these names that is present.
  std::string value(std::initializer_list<const char*> names) const {
    for (const char* name : names)
      if (has(name)) return value(name);
    return {};
  }

  [[noreturn]] void refuseField(const std::string& name) const {
    refuseScan(path_, "its '" + name + "' " + printableExcerpt(value(name)) + " is not valid" + kExportAgain);
  }

  bool flag(const std::string& name, bool fallback) const {
    if (!has(name)) return fallback;
    const std::string word = lowerCase(value(name));
    if (word == "true" || word == "t" || word == "1") return true;
    if (word != "false" && word != "f" && word != "0") refuseField(name);
    return false;
  }

  void readSizes() {
    if (has("objecttype") && lowerCase(value("objecttype")) != "image") refuseField("objecttype");
    const auto axes = parseInteger(value("ndims"));
    constexpr std::int64_t kMaxAxes = 10;
    if (!axes || *axes < 1 || *axes > kMaxAxes) refuseField("ndims");
    const std::vector<std::string> words = wordsOf(value("dimsize"));
    if (words.size() != static_cast<std::size_t>(*axes)) refuseField("dimsize");
    for (const std::string& word : words) {
      sizes_.push_back(parseInteger(word).value_or(0));
      if (sizes_.back() < 1 || sizes_.back() > std::numeric_limits<int>::max()) refuseField("dimsize");
    }
    const bool is_volume = sizes_.size() >= 3 && std::all_of(sizes_.begin() + std::min<long>(3, *axes), sizes_.end(),
                                                             [](std::int64_t size) { return size == 1; });
    if (!is_volume) refuseScan(path_, "it has " + std::to_string(*axes) + " axes; give a volume with three");
    const auto channels = has("elementnumberofchannels") ? parseInteger(value("elementnumberofchannels")) : 1;
    if (channels != 1 || lowerCase(value("elementtype")).ends_with("_array")) refuseSeveralValues(path_);
  }

  ScanGeometry geometry() const {
    const std::size_t axes = sizes_.size();
    if (!has("elementspacing") && !has("elementsize"))
      refuseScan(path_, "it states no voxel size; export it with spacing");
    const auto numbers = [&](std::initializer_list<const char*> names, std::size_t count) {
      const std::string text = value(names);
      if (text.empty()) return std::optional(std::vector<double>());
      const auto found = parseReals(text, count);
      if (!found)
        refuseScan(path_, "its " + std::string(*names.begin()) + " " + printableExcerpt(text) + " is not " +
                              std::to_string(count) + " numbers" + kExportAgain);
      return found;
    };
    const std::vector<double> spacing = *numbers({"elementspacing", "elementsize"}, axes);
    const std::vector<double> axis = *numbers({"transformmatrix", "rotation", "orientation"}, axes * axes);
    const std::vector<double> origin = *numbers({"offset", "position", "origin"}, axes);
    if (spacing.empty()) refuseField(has("elementspacing") ? "elementspacing" : "elementsize");
    const auto mm = millimetresPer(value("distanceunits"));
    if (!mm) refuseField("distanceunits");

    ScanGeometry result;
    for (std::size_t a = 0; a < 3; ++a) {
      const int i = static_cast<int>(a);
      if (!(spacing[a] > 0.0) || !std::isfinite(spacing[a]))
        refuseScan(path_, std::string("its ElementSpacing is not positive and finite") + kExportAgain);
      result.size[i] = static_cast<int>(sizes_[a]);
      if (!axis.empty()) result.step_P_mm[i] = {axis[a * axes], axis[a * axes + 1], axis[a * axes + 2]};
      constexpr double kUnit = 1.0e-3;
      if (!(std::abs(glm::length(result.step_P_mm[i]) - 1.0) <= kUnit))
        refuseScan(path_, std::string("the axes of its TransformMatrix are not of length 1") + kExportAgain);
      result.step_P_mm[i] *= *mm * spacing[a];
      if (!origin.empty()) result.origin_P_mm[i] = *mm * origin[a];
    }
    return result;
  }

  /// MET_LONG has 4 bytes, whatever the machine.
  VoxelType type() const {
    static const std::map<std::string, VoxelType> kTypes = {
        {"met_char", VoxelType::int8},         {"met_uchar", VoxelType::uint8},   {"met_short", VoxelType::int16},
        {"met_ushort", VoxelType::uint16},     {"met_int", VoxelType::int32},     {"met_uint", VoxelType::uint32},
        {"met_long", VoxelType::int32},        {"met_ulong", VoxelType::uint32},  {"met_long_long", VoxelType::int64},
        {"met_ulong_long", VoxelType::uint64}, {"met_float", VoxelType::float32}, {"met_double", VoxelType::float64}};
    const auto found = kTypes.find(lowerCase(value("elementtype")));
    if (found == kTypes.end())
      refuseScan(path_, "its voxels are of type " + printableExcerpt(value("elementtype")) +
                            ", which is not supported; store integers or floats");
    return found->second;
  }

  VoxelCoding coding() const {
    const bool is_compressed = flag("compresseddata", false);
    if (flag("binarydata", true)) return is_compressed ? VoxelCoding::gzip : VoxelCoding::raw;
    if (is_compressed) refuseField("compresseddata");
    return VoxelCoding::text;
  }

  bool isBigEndian() const {
    return flag(has("elementbyteordermsb") ? "elementbyteordermsb" : "binarydatabyteordermsb", false);
  }

  bool isLocal() const { return lowerCase(value("elementdatafile")) == "local"; }

  /// HeaderSize counts bytes of the stored file, compressed or not.
  void skipHeader(ImageHeader& header) const {
    if (!has("headersize")) return;
    const auto size = parseInteger(value("headersize"));
    if (!size || *size < kVoxelsAtFileEnd || (isLocal() && *size > 0)) refuseField("headersize");
    if (*size == kVoxelsAtFileEnd)
      header.skipped_bytes = *size;
    else if (*size > 0)
      for (VoxelFile& each : header.files) each.from_byte = static_cast<std::uint64_t>(*size);
  }

  /// Number of files if each holds the first `file_axes` axes.
  std::uint64_t filesNeeded(std::int64_t file_axes) const {
    std::uint64_t files = 1;
    for (auto a = static_cast<std::size_t>(file_axes); a < sizes_.size(); ++a)
      files *= static_cast<std::uint64_t>(sizes_[a]);
    return files;
  }

  std::vector<VoxelFile> files() const {
    if (isLocal()) return {{path_, end_byte_}};
    const std::string name = value("elementdatafile");
    const std::vector<std::string> words = wordsOf(name);
    if (words.empty()) refuseField("elementdatafile");
    if (isList(name)) return listedFiles(words);
    if (name.find('%') == std::string::npos) return {dataFile(path_, name)};

    // "NAME%03d.raw first last step", each slice of the last axis in a file.
    const auto all = static_cast<std::int64_t>(sizes_.size());
    const std::uint64_t needed = filesNeeded(all - 1);
    const auto number = [&](std::size_t w, std::int64_t fallback) {
      if (words.size() <= w) return fallback;
      const auto found = parseInteger(words[w]);
      if (!found) refuseField("elementdatafile");
      return *found;
    };
    if (words.size() > 4) refuseField("elementdatafile");
    const std::int64_t first = number(1, 1);
    if (std::abs(first) > std::numeric_limits<int>::max()) refuseField("elementdatafile");
    const std::int64_t last = number(2, first + static_cast<std::int64_t>(needed) - 1);
    return numberedDataFiles(path_, {words[0], first, last, number(3, 1)}, needed);
  }

  std::vector<VoxelFile> listedFiles(const std::vector<std::string>& words) const {
    const auto all = static_cast<std::int64_t>(sizes_.size());
    std::int64_t file_axes = all - 1;
    if (words.size() > 1) {
      const std::string axes = lowerCase(words[1]);
      const auto number = parseInteger(axes.ends_with('d') ? axes.substr(0, axes.size() - 1) : axes);
      if (words.size() > 2 || !number || *number < 1 || *number > all) refuseField("elementdatafile");
      file_axes = *number;
    }
    return listedDataFiles(path_, listed_files_, filesNeeded(file_axes));
  }

  std::string path_;
  std::map<std::string, std::string> value_;  ///< names in lower case
  std::vector<std::string> listed_files_;
  std::uint64_t end_byte_ = 0;
  std::vector<std::int64_t> sizes_;
};

}  // namespace

ImageHeader readMetaHeader(const RegularFile& file) { return MetaHeader(file).header(); }

}  // namespace assets
