#include "assets/import/dicom/dicom_header.h"

#include <algorithm>
#include <array>
#include <cctype>
#include <cmath>
#include <cstring>
#include <string_view>
#include <utility>

#include "assets/import/dicom/dicom_values.h"
#include "assets/import/dicom/known_scanner.h"
#include "assets/scan/header_text.h"

namespace assets {
namespace {

constexpr std::uint32_t kShared = 0x52009229, kPerFrame = 0x52009230;  // functional groups (PS3.3 C.7.6.16)
constexpr std::uint32_t kMeasures = 0x00289110, kPlanePosition = 0x00209113, kPlaneOrientation = 0x00209116,
                        kValueTransform = 0x00289145;
constexpr int kMostFrames = 20'000;

/// Pieces of at least three letters or digits, in lower case.
std::vector<std::string> piecesOf(const std::string& text) {
  std::vector<std::string> pieces(1);
  for (const char letter : text) {
    const auto c = static_cast<unsigned char>(letter);
    if (std::isalnum(c) != 0 || c >= 0x80)
      pieces.back() += static_cast<char>(std::tolower(c));
    else if (!pieces.back().empty())
      pieces.emplace_back();
  }
  std::erase_if(pieces, [](const std::string& piece) { return piece.size() < 3; });
  return pieces;
}

/// Elements whose values are kept, as they are or as a word of a list.
constexpr std::array<std::uint32_t, 32> kKept = {
    0x00080008, 0x00080016, 0x00080060, 0x00080070, 0x00081090, 0x00180050, 0x00180060, 0x00181152,
    0x00181210, 0x00200013, 0x00200032, 0x00200037, 0x00280002, 0x00280004, 0x00280008, 0x00280010,
    0x00280011, 0x00280030, 0x00280100, 0x00280101, 0x00280102, 0x00280103, 0x00280120, 0x00280121,
    0x00280301, 0x00281052, 0x00281053, 0x52009229, 0x52009230, 0x7fe00008, 0x7fe00009, 0x7fe00010};

/// In kDroppedGroups.
std::size_t dropGroup(std::uint32_t tag) {
  const std::uint32_t group = tag >> 16;
  if (group % 2 != 0) return 5;
  switch (group) {
    case 0x0002:
      return 0;
    case 0x0008:
      return 1;
    case 0x0010:
      return 2;
    case 0x0018:
      return 3;
    case 0x0020:
    case 0x0028:
      return 4;
    default:
      return 6;
  }
}

/// Copies the values on the list into a header.
class HeaderFiller {
 public:
  HeaderFiller(const DicomBytes& bytes, bool is_big_endian, std::string file_name, DicomHeader& header)
      : bytes_(bytes), is_big_endian_(is_big_endian), file_name_(lowerCase(std::move(file_name))), header_(header) {}

  void take(const DicomPath& path, const DicomElement& element) {
    if (path.empty() && std::ranges::find(kKept, element.tag) == kKept.end())
      ++header_.dropped_elements[dropGroup(element.tag)];
    if (path.empty())
      takeOfFile(element);
    else if (path.size() == 2 && path[0].sequence == kShared)
      takeOfPlane(element, shared_);
    else if (path.size() == 2 && path[0].sequence == kPerFrame && path[0].item < kMostFrames) {
      if (per_frame_.size() <= path[0].item) per_frame_.resize(path[0].item + 1);
      takeOfPlane(element, per_frame_[path[0].item]);
    }
  }

  /// One plane a frame: of its own, else of all, else of the file. Of a file that does not hold its pixels the first.
  void finishPlanes() {
    const auto first_of = [](const auto& a, const auto& b, const auto& c) { return a ? a : b ? b : c; };
    const std::size_t count = header_.fault != DicomFault::none ? 1 : static_cast<std::size_t>(header_.frames);
    for (std::size_t frame = 0; frame < count; ++frame) {
      const Plane own = frame < per_frame_.size() ? per_frame_[frame] : Plane{};
      DicomPlane plane;
      plane.row_column = first_of(own.row_column, shared_.row_column, file_.row_column);
      plane.spacing_mm = first_of(own.spacing_mm, shared_.spacing_mm, file_.spacing_mm);
      plane.thickness_mm = first_of(own.thickness_mm, shared_.thickness_mm, file_.thickness_mm);
      // A position that all frames share says nothing of a frame.
      plane.position_P_mm = header_.frames == 1
                                ? first_of(own.position_P_mm, shared_.position_P_mm, file_.position_P_mm)
                                : own.position_P_mm;
      plane.slope = first_of(own.slope, shared_.slope, file_.slope).value_or(1.0);
      plane.intercept = first_of(own.intercept, shared_.intercept, file_.intercept).value_or(0.0);
      header_.planes.push_back(plane);
    }
  }

  int samples() const { return samples_; }
  bool isGrey() const { return photometric_.starts_with("MONOCHROME"); }
  bool hasOtherPixels() const { return has_other_pixels_; }

 private:
  struct Plane {
    std::optional<glm::dvec3> position_P_mm;
    std::optional<glm::dmat2x3> row_column;
    std::optional<glm::dvec2> spacing_mm;
    std::optional<double> thickness_mm, slope, intercept;
  };

  std::vector<double> numbers(const DicomElement& element) const { return numbersOf(bytes_, element, is_big_endian_); }
  std::optional<double> number(const DicomElement& element) const { return numberOf(bytes_, element, is_big_endian_); }
  std::string text(const DicomElement& element) const { return textOf(bytes_, element); }
  int integer(const DicomElement& element, int otherwise) const {
    const auto value = integerOf(bytes_, element, is_big_endian_);
    return value && *value >= 0 && *value <= 0xffff ? static_cast<int>(*value) : otherwise;
  }

  void takeOfPlane(const DicomElement& element, Plane& plane) {
    switch (element.tag) {
      case 0x00200032:
        if (const auto p = numbers(element); p.size() == 3) plane.position_P_mm = glm::dvec3(p[0], p[1], p[2]);
        break;
      case 0x00200037:
        if (const auto d = numbers(element); d.size() == 6)
          plane.row_column = glm::dmat2x3(glm::dvec3(d[0], d[1], d[2]), glm::dvec3(d[3], d[4], d[5]));
        break;
      case 0x00280030:
        if (const auto s = numbers(element); s.size() == 2) plane.spacing_mm = glm::dvec2(s[0], s[1]);
        break;
      case 0x00180050:
        plane.thickness_mm = number(element);
        break;
      case 0x00281053:
        plane.slope = number(element);
        break;
      case 0x00281052:
        plane.intercept = number(element);
        break;
      default:
        break;
    }
  }

  void takeOfFile(const DicomElement& element) {
    takeOfPlane(element, file_);
    takeOfPicture(element);
    takeOfScan(element);
    takeOfPerson(element);
  }

  void takeOfPicture(const DicomElement& element) {
    DicomPixelFormat& format = header_.format;
    switch (element.tag) {
      case 0x00280002:
        samples_ = integer(element, 0);
        break;
      case 0x00280004:
        photometric_ = text(element);
        format.is_inverted = photometric_ == "MONOCHROME1";
        break;
      case 0x00280008:
        header_.frames = integer(element, 0);
        break;
      case 0x00280010:
        header_.rows = integer(element, 0);
        break;
      case 0x00280011:
        header_.columns = integer(element, 0);
        break;
      case 0x00280100:
        format.bits_allocated = integer(element, 0);
        break;
      case 0x00280101:
        format.bits_stored = integer(element, 0);
        break;
      case 0x00280102:
        format.high_bit = integer(element, 0);
        break;
      case 0x00280103:
        format.is_signed = integer(element, 0) == 1;
        break;
      case 0x00280120:
        format.padding = padding(element);
        break;
      case 0x00280121:
        format.padding_limit = padding(element);
        break;
      case 0x7fe00008:
      case 0x7fe00009:
        has_other_pixels_ = true;
        break;
      default:
        break;
    }
  }

  std::optional<std::uint32_t> padding(const DicomElement& element) const {
    const auto value = integerOf(bytes_, element, is_big_endian_);
    return value ? std::optional(static_cast<std::uint32_t>(*value & 0xffff)) : std::nullopt;
  }

  void takeOfScan(const DicomElement& element) {
    switch (element.tag) {
      case 0x00080008:
        image_type_ = text(element);
        if (image_type_.find("LOCALIZER") != std::string::npos || image_type_.find("SCOUT") != std::string::npos)
          header_.kind = DicomKind::localizer;
        break;
      case 0x00080016:
        // Secondary capture, single frame: screenshots and report pages.
        is_capture_ = text(element) == "1.2.840.10008.5.1.4.1.1.7";
        break;
      case 0x00080020:
        if (const std::string date = text(element); date.size() >= 4)
          if (const auto year = parseInteger(date.substr(0, 4)); year && *year >= 1970 && *year < 2200)
            header_.year_band = static_cast<int>((*year + 2) / 5 * 5);
        break;
      case 0x00080060:
        header_.modality = knownModality(text(element));
        break;
      case 0x00080070:
        header_.manufacturer = knownManufacturer(text(element));
        break;
      case 0x00081090:
        header_.model = knownModel(text(element));
        break;
      case 0x00181210:
        header_.kernel = knownKernel(text(element));
        break;
      case 0x00180060:
        header_.tube_kv = number(element);
        break;
      case 0x00181152:
        header_.exposure_mas = number(element);
        break;
      case 0x0020000d:
        header_.study_key = hashOf(bytes_, element);
        break;
      case 0x0020000e:
        header_.series_key = hashOf(bytes_, element);
        break;
      case 0x00200052:
        header_.frame_of_reference_key = hashOf(bytes_, element);
        break;
      case 0x00200013:
        if (const auto n = number(element); n && std::abs(*n) < 1.0e9) header_.instance = static_cast<int>(*n);
        break;
      case 0x00280301:
        header_.has_burnt_in_text = text(element) == "YES";
        break;
      default:
        break;
    }
  }

  /// Looked at, not kept.
  void takeOfPerson(const DicomElement& element) {
    switch (element.tag) {
      case 0x00100010:  // name, number, birth date, other numbers and names
      case 0x00100020:
      case 0x00100030:
      case 0x00101000:
      case 0x00101001:
      case 0x00080050:
        for (const std::string& piece : piecesOf(text(element)))
          if (file_name_.find(piece) != std::string::npos) header_.name_is_telling = true;
        break;
      case 0x00100040:
        if (const std::string sex = text(element); sex == "M" || sex == "F" || sex == "O") header_.sex = sex[0];
        break;
      case 0x00101010:
        if (const std::string age = text(element); age.size() == 4 && age[3] == 'Y')
          if (const auto years = parseInteger(age.substr(0, 3)); years && *years >= 0 && *years < 130)
            header_.age_decade = static_cast<int>(*years / 10 * 10);
        break;
      default:
        break;
    }
  }

 public:
  bool isCapture() const { return is_capture_; }

 private:
  const DicomBytes& bytes_;
  bool is_big_endian_;
  std::string file_name_, photometric_, image_type_;
  DicomHeader& header_;
  Plane file_, shared_;
  std::vector<Plane> per_frame_;
  int samples_ = 1;
  bool is_capture_ = false, has_other_pixels_ = false;
};

struct DataSetStart {
  std::uint64_t at = 0;
  bool has_preamble = false;
  std::string syntax_uid;           ///< empty: not stated
  std::uint32_t dropped_facts = 0;  ///< elements of the file's own facts but the syntax
};

/// Behind the preamble and the group of the file's own facts (PS3.10 7.1); none: no DICOM file.
std::optional<DataSetStart> startOf(const DicomBytes& bytes) {
  std::array<char, 4> mark{};
  DataSetStart start;
  const bool has_preamble = bytes.read(128, mark) && std::string_view(mark.data(), 4) == "DICM";
  start.has_preamble = has_preamble;
  if (has_preamble) start.at = 132;
  // Without a preamble: a low even group, as every data set begins.
  const std::uint32_t group = integerAt(bytes, start.at, 2, false);
  const bool is_big_endian = group == 0x0800;
  if (!has_preamble && group != 0x0002 && group != 0x0008 && !is_big_endian) return std::nullopt;
  if (!has_preamble && integerAt(bytes, start.at + 2, 2, is_big_endian) > 0x0060) return std::nullopt;
  if (is_big_endian) start.syntax_uid = "1.2.840.10008.1.2.2";
  while (integerAt(bytes, start.at, 2, false) == 0x0002) {
    DicomElement element;
    std::array<char, 8> head{};
    if (!bytes.read(start.at, head)) return start;
    const std::string_view type(head.data() + 4, 2);
    const bool is_long = type == "OB" || type == "UN" || type == "OW" || type == "SQ" || type == "UT";
    element.tag = 0x00020000 | integerAt(bytes, start.at + 2, 2, false);
    element.length = is_long ? integerAt(bytes, start.at + 8, 4, false) : integerAt(bytes, start.at + 6, 2, false);
    element.at = start.at + (is_long ? 12 : 8);
    if (element.tag == 0x00020010)
      start.syntax_uid = textOf(bytes, element);
    else
      ++start.dropped_facts;
    if (element.length == kUndefinedLength || element.at + element.length > bytes.size()) return start;
    start.at = element.at + element.length;
  }
  return start;
}

bool isReadable(const DicomPixelFormat& format) {
  const bool is_depth = format.bits_allocated == 8 || format.bits_allocated == 16;
  return is_depth && format.bits_stored >= 1 && format.bits_stored <= format.bits_allocated &&
         format.high_bit >= format.bits_stored - 1 && format.high_bit < format.bits_allocated;
}

/// Whether all pixels are in the file, by lengths alone.
void judgeLength(const DicomBytes& bytes, const WalkResult& walk, DicomHeader& header) {
  header.pixels_at = walk.pixels.at;
  if (walk.pixels.length == kUndefinedLength) {
    DicomFragments fragments = fragmentsAt(bytes, walk.pixels.at, header.is_big_endian);
    for (std::size_t n = 1; n < fragments.parts.size(); ++n) header.expected_bytes += fragments.parts[n].length;
    header.held_bytes = header.expected_bytes - std::min(header.expected_bytes, fragments.missing_bytes);
    header.fragments = std::move(fragments.parts);
    const bool has_all = header.fragments.size() > static_cast<std::size_t>(header.frames);
    if (header.syntax->packing == PixelPacking::plain)
      header.fault = DicomFault::damaged;
    else if (!fragments.is_whole || !has_all)
      header.fault = fragments.missing_bytes > 0 ? DicomFault::cut : DicomFault::damaged;
    return;
  }
  header.expected_bytes = header.frameBytes() * static_cast<unsigned>(header.frames);
  header.held_bytes = std::min<std::uint64_t>(
      {header.expected_bytes, walk.pixels.length, bytes.size() - std::min(bytes.size(), walk.pixels.at)});
  if (header.syntax->packing != PixelPacking::plain)
    header.fault = DicomFault::damaged;
  else if (header.held_bytes < header.expected_bytes)
    header.fault = DicomFault::cut;
}

}  // namespace

OpenedDicom openDicom(const std::string& path, const std::string& file_name) {
  return openDicom(DicomBytes(path), file_name);
}

DicomBytes pixelBytes(DicomBytes bytes, const DicomHeader& header) {
  if (header.syntax->is_deflated) bytes.inflateFrom(header.data_set_at);
  return bytes;
}

OpenedDicom openDicom(DicomBytes bytes, const std::string& file_name) {
  OpenedDicom opened{{}, std::move(bytes)};
  DicomHeader& header = opened.header;
  // Without a preamble only what has a scan's values is taken for DICOM.
  bool has_preamble = false;
  const auto refused = [&](DicomFault fault) -> OpenedDicom&& {
    header.fault = !has_preamble && header.modality.empty() ? DicomFault::not_dicom : fault;
    return std::move(opened);
  };

  const auto start = startOf(opened.bytes);
  if (!start) return refused(DicomFault::not_dicom);
  const TransferSyntax* known = transferSyntax(start->syntax_uid);
  has_preamble = start->has_preamble;
  header.dropped_elements[dropGroup(0x00020000)] = start->dropped_facts;
  header.data_set_at = start->at;
  // Its elements may still be readable: explicit little endian, as every syntax but the three old ones.
  header.syntax = known != nullptr ? known : &kTransferSyntaxes[1];
  header.is_big_endian = header.syntax->is_big_endian;
  if (header.syntax->is_deflated && !opened.bytes.inflateFrom(start->at)) return refused(DicomFault::damaged);

  HeaderFiller filler(opened.bytes, header.is_big_endian, file_name, header);
  const WalkResult walk =
      walkDataSet(opened.bytes, start->at, {header.syntax->is_implicit, header.syntax->is_big_endian},
                  {kShared, kPerFrame, kMeasures, kPlanePosition, kPlaneOrientation, kValueTransform},
                  [&](const DicomPath& path, const DicomElement& element) { filler.take(path, element); });
  if (walk.end == WalkEnd::damaged) return refused(DicomFault::damaged);
  if (walk.end == WalkEnd::cut) {
    header.held_bytes = header.expected_bytes = opened.bytes.size();
    return refused(DicomFault::damaged);
  }
  if (header.kind == DicomKind::no_image && walk.end == WalkEnd::pixels) header.kind = DicomKind::image;
  if (walk.end == WalkEnd::end) header.kind = DicomKind::no_image;
  if (header.kind == DicomKind::no_image) {
    if (filler.hasOtherPixels()) return refused(DicomFault::unread_pixels);
    if (header.modality.empty() && !has_preamble) return refused(DicomFault::not_dicom);
    return opened;
  }
  if (filler.isCapture() && header.frames <= 1) header.kind = DicomKind::capture;
  if (known == nullptr && !start->syntax_uid.empty()) {
    header.unread_name = unreadSyntaxName(start->syntax_uid);
    return refused(DicomFault::unread_packing);
  }
  if (filler.samples() != 1 || !filler.isGrey() || !isReadable(header.format) || header.pixelCount() == 0 ||
      header.frames < 1 || header.frames > kMostFrames)
    return refused(DicomFault::unread_pixels);
  judgeLength(opened.bytes, walk, header);
  filler.finishPlanes();
  return opened;
}

}  // namespace assets
