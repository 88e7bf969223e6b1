#include "assets/scan/nrrd_header.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>
#include <map>
#include <optional>

#include "assets/scan/header_text.h"
#include "assets/scan/voxel_files.h"

namespace assets {

namespace {

constexpr std::string_view kExport = "; export the volume again";

/// What the lines say, by field; and where the voxels begin if they follow.
struct Fields {
  std::map<std::string, std::string> value;  ///< names in lower case without spaces
  std::vector<std::string> listed_files;     ///< the lines behind "data file: LIST"
  std::uint64_t end_byte = 0;

  bool has(const std::string& name) const { return value.contains(name); }
  std::string operator[](const std::string& name) const {
    const auto found = value.find(name);
    return found == value.end() ? std::string() : found->second;
  }
};

std::string fieldName(std::string_view text) {
  std::string name = lowerCase(std::string(text));
  std::erase(name, ' ');
  return name;
}

bool isField(const std::string& name) {
  static constexpr std::array<std::string_view, 29> kNames = {
      "content",        "number",      "type",     "dimension", "space",       "spacedimension", "sizes",
      "spacings",       "thicknesses", "axismins", "axismaxs",  "centers",     "centerings",     "kinds",
      "labels",         "units",       "min",      "max",       "oldmin",      "oldmax",         "blocksize",
      "endian",         "encoding",    "lineskip", "byteskip",  "sampleunits", "spaceunits",     "spaceorigin",
      "spacedirections"};
  return name == "datafile" || name == "measurementframe" ||
         std::find(kNames.begin(), kNames.end(), name) != kNames.end();
}

void readListedFiles(HeaderText& text, Fields& fields) {
  while (const auto line = text.line())
    if (const std::string name = trimmed(*line); !name.empty()) fields.listed_files.push_back(name);
}

Fields fieldsOf(const PlainFile& file) {
  HeaderText text(file);
  const std::string magic = text.line().value_or("");
  if (magic.size() != 8 || !magic.starts_with("NRRD000") || magic[7] < '1' || magic[7] > '5')
    refuseScan(file.path(), "it is no NRRD file; export it as NRRD");

  Fields fields;
  while (const auto line = text.line()) {
    if (line->empty()) break;
    if (line->starts_with('#')) continue;
    const std::size_t colon = line->find(": ");
    if (line->find(":=") < colon) continue;
    const std::string name = colon == std::string::npos ? "" : fieldName(line->substr(0, colon));
    if (!isField(name))
      refuseScan(file.path(), "line " + std::to_string(text.lineNumber()) +
                                  " is no field of an NRRD header, or the blank line before the voxels is missing" +
                                  std::string(kExport));
    if (!fields.value.emplace(name, trimmed(line->substr(colon + 2))).second)
      refuseScan(file.path(), "its header has '" + name + "' twice" + std::string(kExport));
    if (name == "datafile" && isList(fields["datafile"])) {
      readListedFiles(text, fields);
      break;
    }
  }
  fields.end_byte = text.nextByte();
  return fields;
}

VoxelType typeNamed(const std::string& name, const std::string& path) {
  static const std::map<std::string, VoxelType> kTypes = [] {
    std::map<std::string, VoxelType> types;
    const auto add = [&](VoxelType type, std::initializer_list<const char*> names) {
      for (const char* each : names) types[each] = type;
    };
    add(VoxelType::int8, {"signed char", "int8", "int8_t"});
    add(VoxelType::uint8, {"uchar", "unsigned char", "uint8", "uint8_t"});
    add(VoxelType::int16, {"short", "short int", "signed short", "signed short int", "int16", "int16_t"});
    add(VoxelType::uint16, {"ushort", "unsigned short", "unsigned short int", "uint16", "uint16_t"});
    add(VoxelType::int32, {"int", "signed int", "int32", "int32_t"});
    add(VoxelType::uint32, {"uint", "unsigned int", "uint32", "uint32_t"});
    add(VoxelType::int64,
        {"longlong", "long long", "long long int", "signed long long", "signed long long int", "int64", "int64_t"});
    add(VoxelType::uint64, {"ulonglong", "unsigned long long", "unsigned long long int", "uint64", "uint64_t"});
    add(VoxelType::float32, {"float"});
    add(VoxelType::float64, {"double"});
    return types;
  }();
  const auto found = kTypes.find(lowerCase(name));
  if (found == kTypes.end())
    refuseScan(path, "its voxels are of type " + asShown(name) + ", which can not be read; store integers or floats");
  return found->second;
}

VoxelCoding codingNamed(const std::string& name, const std::string& path) {
  const std::string word = lowerCase(name);
  if (word == "raw") return VoxelCoding::raw;
  if (word == "gzip" || word == "gz") return VoxelCoding::gzip;
  if (word == "ascii" || word == "text" || word == "txt") return VoxelCoding::text;
  if (word == "hex") return VoxelCoding::hex;
  if (word == "bzip2" || word == "bz2")
    refuseScan(path, "its voxels are packed with bzip2, which is not read; export it with gzip or raw");
  refuseScan(path, "its encoding " + asShown(name) + " is not known; export it with gzip or raw");
}

struct Axis {
  std::int64_t size = 0;
  bool is_spatial = true;
  double spacing = std::numeric_limits<double>::quiet_NaN();  ///< in `unit`
  std::optional<glm::dvec3> step;                             ///< along the axes of the file's space
  double mm_per_unit = 1.0;
  double first = 0.0;  ///< centre of the first voxel, without directions
};

/// The text's words; a vector "(1,0,0)" or a quoted text is one word.
std::vector<std::string> itemsOf(const std::string& text) {
  std::vector<std::string> items;
  for (std::size_t at = text.find_first_not_of(" \t"); at != std::string::npos;
       at = at < text.size() ? text.find_first_not_of(" \t", at) : std::string::npos) {
    const char end = text[at] == '(' ? ')' : text[at] == '"' ? '"' : ' ';
    std::size_t last = text.find(end, at + 1);
    if (end != ' ' && last != std::string::npos) ++last;
    last = std::min(last, text.size());
    items.push_back(trimmed(std::string_view(text).substr(at, last - at)));
    at = last;
  }
  return items;
}

class NrrdHeader {
 public:
  explicit NrrdHeader(const PlainFile& file) : path_(file.path()), fields_(fieldsOf(file)) {}

  ImageHeader header() {
    readAxes();
    keepThreeAxes();
    ImageHeader header;
    header.path = path_;
    header.geometry = geometry();
    header.states_sides = fields_.has("space");
    header.type = typeNamed(needed("type"), path_);
    header.coding = codingNamed(needed("encoding"), path_);
    header.is_big_endian = isBigEndian(header);
    header.skipped_lines = skip("lineskip", 0);
    header.skipped_bytes = skip("byteskip", kVoxelsEndTheFile);
    header.files = files();
    return header;
  }

 private:
  std::string needed(const std::string& name) const {
    if (!fields_.has(name)) refuseScan(path_, "its header has no '" + name + "'" + std::string(kExport));
    return fields_[name];
  }

  [[noreturn]] void refuseField(const std::string& name) const {
    refuseScan(path_, "its '" + name + "' " + asShown(fields_[name]) + " can not be understood" + std::string(kExport));
  }

  /// One item for each axis, or none at all.
  std::vector<std::string> perAxis(const std::string& name) const {
    std::vector<std::string> items = itemsOf(fields_[name]);
    if (fields_.has(name) && items.size() != axes_.size()) refuseField(name);
    return items;
  }

  void readAxes() {
    const auto dimension = wholeNumber(needed("dimension"));
    if (!dimension || *dimension < 1 || *dimension > 16) refuseField("dimension");
    axes_.resize(static_cast<std::size_t>(*dimension));
    const std::vector<std::string> sizes = (needed("sizes"), perAxis("sizes"));
    const std::vector<std::string> spacings = perAxis("spacings"), kinds = perAxis("kinds"), units = perAxis("units");
    const std::vector<std::string> directions = perAxis("spacedirections");
    for (std::size_t a = 0; a < axes_.size(); ++a) {
      Axis& axis = axes_[a];
      axis.size = wholeNumber(sizes[a]).value_or(0);
      if (axis.size < 1 || axis.size > std::numeric_limits<int>::max()) refuseField("sizes");
      if (!spacings.empty()) {
        const auto spacing = realNumber(spacings[a]);
        if (!spacing) refuseField("spacings");
        axis.spacing = *spacing;
      }
      if (!units.empty()) axis.mm_per_unit = unit(units[a]);
      if (!kinds.empty()) axis.is_spatial = isSpatial(lowerCase(kinds[a]));
      if (!directions.empty() && lowerCase(directions[a]) != "none")
        axis.step = vector("spacedirections", directions[a]);
      if (directions.empty() ? !spacings.empty() && std::isnan(axis.spacing) : !axis.step) axis.is_spatial = false;
    }
    readAxisMins();
  }

  /// Without directions: where an axis begins, by its lowest edge, or by its first sample if it is centred on nodes.
  void readAxisMins() {
    const std::vector<std::string> mins = perAxis("axismins");
    const std::vector<std::string> centers = perAxis(fields_.has("centers") ? "centers" : "centerings");
    bool is_placed = !mins.empty();
    for (std::size_t a = 0; a < mins.size(); ++a) {
      const auto lowest = realNumber(mins[a]);
      if (!lowest) refuseField("axismins");
      const bool is_node = !centers.empty() && lowerCase(centers[a]) == "node";
      axes_[a].first = *lowest + (is_node ? 0.0 : 0.5 * axes_[a].spacing);
      is_placed = is_placed && (!axes_[a].is_spatial || std::isfinite(*lowest));
    }
    if (!is_placed)
      for (Axis& axis : axes_) axis.first = 0.0;
  }

  static bool isSpatial(const std::string& kind) {
    return kind == "domain" || kind == "space" || kind == "time" || kind == "none" || kind == "???" ||
           kind == "unknown";
  }

  double unit(std::string word) const {
    std::erase(word, '"');
    const auto mm = millimetresPer(trimmed(word));
    if (!mm) refuseScan(path_, "its unit " + asShown(word) + " is no length that is understood; export it in mm");
    return *mm;
  }

  glm::dvec3 vector(const std::string& field, std::string text) const {
    if (!text.starts_with('(') || !text.ends_with(')')) refuseField(field);
    text = text.substr(1, text.size() - 2);
    if (std::count(text.begin(), text.end(), ',') != 2) refuseField(field);
    std::replace(text.begin(), text.end(), ',', ' ');
    const auto numbers = realNumbers(text, 3);
    if (!numbers) refuseField(field);
    return {(*numbers)[0], (*numbers)[1], (*numbers)[2]};
  }

  /// Drops axes that are none of space, then others of size 1 from the end, until three are left.
  void keepThreeAxes() {
    const std::string axes = "it has " + std::to_string(axes_.size()) + " axes; give a volume with three";
    for (const Axis& axis : axes_)
      if (!axis.is_spatial && axis.size > 1 && std::isnan(axis.spacing) && fields_.has("spacings"))
        refuseScan(path_,
                   "its spacings " + asShown(fields_["spacings"]) + " are no finite numbers" + std::string(kExport));
      else if (!axis.is_spatial && axis.size > 1)
        refuseScan(path_, "its voxels are vectors, colours or complex numbers; give a volume with one value per voxel");
    std::erase_if(axes_, [](const Axis& axis) { return !axis.is_spatial; });
    while (axes_.size() > 3) {
      const auto single = std::find_if(axes_.rbegin(), axes_.rend(), [](const Axis& axis) { return axis.size == 1; });
      if (single == axes_.rend()) refuseScan(path_, axes);
      axes_.erase(std::next(single).base());
    }
    if (axes_.size() < 3) refuseScan(path_, axes);
  }

  /// LPS from the file's space: the signs of x, y and z.
  glm::dvec3 signsOfSpace() const {
    const std::string space = lowerCase(fields_["space"]);
    if (fields_.has("spacedimension") && (!space.empty() || fields_["spacedimension"] != "3"))
      refuseField("spacedimension");
    if (space.empty() || space == "left-posterior-superior" || space == "lps") return glm::dvec3(1.0);
    if (space == "right-anterior-superior" || space == "ras") return {-1.0, -1.0, 1.0};
    refuseScan(path_, "its space " + asShown(space) + " is not understood; export it as left-posterior-superior");
  }

  glm::dvec3 millimetresPerSpaceUnit() const {
    glm::dvec3 mm(1.0);
    const std::vector<std::string> units = itemsOf(fields_["spaceunits"]);
    if (fields_.has("spaceunits") && units.size() != 3) refuseField("spaceunits");
    for (std::size_t p = 0; p < units.size(); ++p) mm[static_cast<int>(p)] = unit(units[p]);
    return mm;
  }

  ScanGeometry geometry() const {
    ScanGeometry result;
    const glm::dvec3 signs = signsOfSpace();
    const glm::dvec3 mm = signs * millimetresPerSpaceUnit();
    for (int a = 0; a < 3; ++a) {
      const Axis& axis = axes_[static_cast<std::size_t>(a)];
      result.size[a] = static_cast<int>(axis.size);
      if (axis.step) {
        if (!std::isnan(axis.spacing)) refuseField("spacings");
        if (axis.mm_per_unit != 1.0)
          refuseScan(path_, "its units " + asShown(fields_["units"]) +
                                " stand at axes with directions, whose unit is that of the space; export it in mm");
        result.step_P_mm[a] = mm * *axis.step;
        continue;
      }
      if (!fields_.has("spacings"))
        refuseScan(path_, "it does not say how large its voxels are; export it with spacing");
      if (!(axis.spacing > 0.0) || !std::isfinite(axis.spacing))
        refuseScan(path_,
                   "its spacings " + asShown(fields_["spacings"]) + " are not all above 0" + std::string(kExport));
      if (signs != glm::dvec3(1.0))
        refuseScan(path_, "it does not say how its axes lie in its space; export it with space directions");
      result.step_P_mm[a] = glm::dvec3(0.0);
      result.step_P_mm[a][a] = axis.mm_per_unit * axis.spacing;
      result.origin_P_mm[a] = axis.mm_per_unit * axis.first;
    }
    if (fields_.has("spacedirections") && !fields_.has("space") && !fields_.has("spacedimension"))
      refuseScan(path_, "it has directions but names no space; export it as left-posterior-superior");
    if (fields_.has("spaceorigin")) result.origin_P_mm = mm * vector("spaceorigin", fields_["spaceorigin"]);
    return result;
  }

  bool isBigEndian(const ImageHeader& header) const {
    const std::string endian = lowerCase(fields_["endian"]);
    if (fields_.has("endian") && endian != "big" && endian != "little") refuseField("endian");
    const bool matters = bytesOf(header.type) > 1 && header.coding != VoxelCoding::text;
    if (matters && endian.empty()) refuseScan(path_, "it does not say its byte order (endian)" + std::string(kExport));
    return matters && endian == "big";
  }

  std::int64_t skip(const std::string& field, std::int64_t lowest) const {
    if (!fields_.has(field)) return 0;
    const auto number = wholeNumber(fields_[field]);
    if (!number || *number < lowest) refuseField(field);
    return *number;
  }

  /// How many files hold the voxels if each holds `file_axes` of the axes that the header states.
  std::uint64_t filesNeeded(std::optional<std::int64_t> file_axes, std::size_t given) const {
    const std::vector<std::string> sizes = perAxisAsStated("sizes");
    const auto all = static_cast<std::int64_t>(sizes.size());
    const std::int64_t axes = file_axes.value_or(all - 1);
    if (axes < 1 || axes > all) refuseField("datafile");
    const auto size_of = [&](std::int64_t a) {
      return static_cast<std::uint64_t>(wholeNumber(sizes[static_cast<std::size_t>(a)]).value_or(0));
    };

    // Files with all the axes are slabs of the last one.
    if (axes == all) return given > 0 && size_of(all - 1) % given == 0 ? given : size_of(all - 1);
    std::uint64_t files = 1;
    for (std::int64_t a = axes; a < all; ++a) files *= size_of(a);
    return files;
  }

  std::vector<std::string> perAxisAsStated(const std::string& name) const { return itemsOf(fields_[name]); }

  std::vector<VoxelFile> files() const {
    if (!fields_.has("datafile")) return {{path_, fields_.end_byte}};
    const std::string name = fields_["datafile"];
    const std::vector<std::string> words = wordsOf(name);
    if (words.empty()) refuseField("datafile");
    const auto axes_word = [&](std::size_t w) { return words.size() > w ? wholeNumber(words[w]) : std::nullopt; };
    if (isList(name)) {
      if (words.size() > 2 || (words.size() == 2 && !axes_word(1))) refuseField("datafile");
      const std::uint64_t needed_files = filesNeeded(axes_word(1), fields_.listed_files.size());
      if (fields_.listed_files.size() != needed_files)
        refuseScan(path_, "it lists " + std::to_string(fields_.listed_files.size()) + " data files where it needs " +
                              std::to_string(needed_files) + std::string(kExport));
      std::vector<VoxelFile> listed;
      for (const std::string& each : fields_.listed_files) listed.push_back(fileBeside(path_, each));
      return listed;
    }
    if (words[0].find('%') == std::string::npos) return {fileBeside(path_, name)};

    const auto first = axes_word(1), last = axes_word(2), step = axes_word(3), file_axes = axes_word(4);
    if (words.size() < 4 || words.size() > 5 || !first || !last || !step || (words.size() == 5 && !file_axes) ||
        *step == 0)
      refuseField("datafile");
    const std::int64_t far = 1'000'000'000;
    const bool is_sane = std::max({std::abs(*first), std::abs(*last), std::abs(*step)}) <= far;
    const std::size_t given =
        is_sane ? static_cast<std::size_t>(std::max<std::int64_t>((*last - *first) / *step + 1, 0)) : 0;
    return numberedFilesBeside(path_, {words[0], *first, *last, *step}, filesNeeded(file_axes, given));
  }

  std::string path_;
  Fields fields_;
  std::vector<Axis> axes_;
};

}  // namespace

ImageHeader readNrrdHeader(const PlainFile& file) { return NrrdHeader(file).header(); }

}  // namespace assets
