#include "assets/import/dicom/dicom_walk.h"

#include <algorithm>
#include <string_view>

namespace assets {
namespace {

constexpr std::uint32_t kItem = 0xfffee000, kItemEnd = 0xfffee00d, kSequenceEnd = 0xfffee0dd;
constexpr std::uint32_t kPixelData = 0x7fe00010;
constexpr std::size_t kDeepest = 12;
constexpr std::uint64_t kMostElements = 2'000'000;
constexpr std::size_t kMostFragments = 1'000'000;

bool isType(std::array<char, 2> type) {
  return std::ranges::all_of(type, [](char letter) { return letter >= 'A' && letter <= 'Z'; });
}

/// Types with four bytes of length after two of nothing (PS3.5 table 7.1-1).
bool hasLongLength(std::array<char, 2> type) {
  constexpr std::string_view kLong = "OB OD OF OL OV OW SQ SV UC UN UR UT UV";
  return kLong.find(std::string_view(type.data(), 2)) != std::string_view::npos;
}

bool isSequence(const DicomElement& element) { return element.type == std::array{'S', 'Q'}; }

class Walk {
 public:
  Walk(const DicomBytes& bytes, const std::vector<std::uint32_t>& entered,
       const std::function<void(const DicomPath&, const DicomElement&)>& visit)
      : bytes_(bytes), entered_(entered), visit_(visit) {}

  WalkResult run(std::uint64_t from_byte, DicomCoding coding) {
    at_ = from_byte;
    WalkResult result;
    result.coding = corrected(coding);
    result.end = elements(bytes_.size(), result.coding, false, true);
    result.pixels = pixels_;
    result.at = at_;
    return result;
  }

 private:
  /// Some writers say one coding and use the other: the first element shows it.
  DicomCoding corrected(DicomCoding coding) const {
    std::array<char, 6> head{};
    if (!bytes_.read(at_, head)) return coding;
    coding.is_implicit = !isType({head[4], head[5]});
    return coding;
  }

  std::uint32_t number(std::uint64_t at, unsigned count, const DicomCoding& coding) const {
    return integerAt(bytes_, at, count, coding.is_big_endian);
  }

  /// The element at `at_`, which then points to its value. False: the file ends.
  bool next(const DicomCoding& coding, DicomElement& element) {
    std::array<char, 8> head{};
    if (!bytes_.read(at_, head)) return false;
    element = {};
    element.tag = number(at_, 2, coding) << 16 | number(at_ + 2, 2, coding);
    const bool is_delimiter = element.tag >> 16 == 0xfffe;
    std::uint64_t head_bytes = 8;
    if (is_delimiter || coding.is_implicit || !isType({head[4], head[5]})) {
      element.length = number(at_ + 4, 4, coding);
    } else {
      element.type = {head[4], head[5]};
      if (hasLongLength(element.type)) {
        head_bytes = 12;
        std::array<char, 4> length{};
        if (!bytes_.read(at_ + 8, length)) return false;
        element.length = number(at_ + 8, 4, coding);
      } else {
        element.length = number(at_ + 6, 2, coding);
      }
    }
    at_ += head_bytes;
    element.at = at_;
    return true;
  }

  /// Elements up to `end`, or in an item of undefined length to its delimiter.
  WalkEnd elements(std::uint64_t end, const DicomCoding& coding, bool until_delimiter, bool is_seen) {
    while (at_ < end) {
      if (++count_ > kMostElements) return WalkEnd::damaged;
      DicomElement element;
      const std::uint64_t begin = at_;
      if (!next(coding, element)) return WalkEnd::cut;
      if (element.tag == kItemEnd) {
        if (until_delimiter) return WalkEnd::end;
        continue;
      }
      if (element.tag == kSequenceEnd || element.tag == kItem) {
        if (begin == at_) return WalkEnd::damaged;
        continue;  // one delimiter too many: seen in the wild
      }
      if (element.tag == kPixelData && path_.empty() && is_seen) {
        pixels_ = element;
        return WalkEnd::pixels;
      }
      if (is_seen && visit_) visit_(path_, element);
      const bool is_wanted = is_seen && std::ranges::find(entered_, element.tag) != entered_.end();
      const bool is_fragments = element.length == kUndefinedLength &&
                                (element.type == std::array{'O', 'B'} || element.type == std::array{'O', 'W'});
      if (is_fragments) {
        if (const WalkEnd passed = fragments(coding); passed != WalkEnd::end) return passed;
      } else if (element.length == kUndefinedLength || (is_wanted && (isSequence(element) || coding.is_implicit))) {
        // An unknown type of undefined length holds a sequence of implicit little endian (PS3.5 6.2.2).
        const bool is_unknown = element.type == std::array{'U', 'N'};
        const DicomCoding inner = is_unknown ? DicomCoding{true, false} : coding;
        if (const WalkEnd passed = sequence(element, inner, is_wanted); passed != WalkEnd::end) return passed;
      } else {
        if (element.length > end - at_ || at_ > end) {
          at_ = end;
          return WalkEnd::cut;
        }
        at_ += element.length;
      }
    }
    return WalkEnd::end;
  }

  WalkEnd sequence(const DicomElement& element, const DicomCoding& coding, bool is_wanted) {
    if (++depth_ > kDeepest) return WalkEnd::damaged;
    const bool is_open = element.length == kUndefinedLength;
    const std::uint64_t end = is_open ? bytes_.size() : element.at + element.length;
    if (end > bytes_.size()) return WalkEnd::cut;
    if (is_wanted) path_.push_back({element.tag, 0});
    while (at_ < end) {
      if (++count_ > kMostElements) return WalkEnd::damaged;
      DicomElement item;
      if (!next(coding, item)) return WalkEnd::cut;
      if (item.tag == kSequenceEnd) break;
      if (item.tag != kItem) return WalkEnd::damaged;
      const bool is_open_item = item.length == kUndefinedLength;
      const std::uint64_t item_end = is_open_item ? end : at_ + item.length;
      if (item_end > end) return WalkEnd::cut;
      if (!is_open_item && !is_wanted)
        at_ = item_end;
      else if (const WalkEnd passed = elements(item_end, coding, is_open_item, is_wanted); passed != WalkEnd::end)
        return passed;
      if (is_wanted) ++path_.back().item;
    }
    if (is_wanted) path_.pop_back();
    --depth_;
    return WalkEnd::end;
  }

  WalkEnd fragments(const DicomCoding& coding) {
    while (true) {
      if (++count_ > kMostElements) return WalkEnd::damaged;
      DicomElement item;
      if (!next(coding, item)) return WalkEnd::cut;
      if (item.tag == kSequenceEnd) return WalkEnd::end;
      if (item.tag != kItem || item.length == kUndefinedLength) return WalkEnd::damaged;
      at_ += item.length;
    }
  }

  const DicomBytes& bytes_;
  const std::vector<std::uint32_t>& entered_;
  const std::function<void(const DicomPath&, const DicomElement&)>& visit_;
  DicomPath path_;
  DicomElement pixels_;
  std::uint64_t at_ = 0, count_ = 0;
  std::size_t depth_ = 0;
};

}  // namespace

std::uint32_t integerAt(const DicomBytes& bytes, std::uint64_t at, unsigned count, bool is_big_endian) {
  std::array<char, 4> read{};
  if (count > read.size() || !bytes.read(at, std::span(read).first(count))) return 0;
  std::uint32_t value = 0;
  for (unsigned n = 0; n < count; ++n) {
    const unsigned from = is_big_endian ? n : count - 1 - n;
    value = value << 8 | static_cast<unsigned char>(read[from]);
  }
  return value;
}

WalkResult walkDataSet(const DicomBytes& bytes, std::uint64_t from_byte, DicomCoding coding,
                       const std::vector<std::uint32_t>& entered,
                       const std::function<void(const DicomPath&, const DicomElement&)>& visit) {
  return Walk(bytes, entered, visit).run(from_byte, coding);
}

DicomFragments fragmentsAt(const DicomBytes& bytes, std::uint64_t from_byte, bool is_big_endian) {
  DicomFragments found;
  std::uint64_t at = from_byte;
  while (found.parts.size() < kMostFragments) {
    std::array<char, 8> head{};
    if (!bytes.read(at, head)) {
      found.is_whole = at == bytes.size();  // the delimiter alone is missing
      return found;
    }
    const std::uint32_t tag = integerAt(bytes, at, 2, is_big_endian) << 16 | integerAt(bytes, at + 2, 2, is_big_endian);
    const std::uint32_t length = integerAt(bytes, at + 4, 4, is_big_endian);
    at += head.size();
    if (tag == kSequenceEnd) {
      found.is_whole = true;
      return found;
    }
    if (tag != kItem || length == kUndefinedLength) return found;
    found.parts.push_back({at, length});
    if (length > bytes.size() - at) {
      found.missing_bytes = length - (bytes.size() - at);
      return found;
    }
    at += length;
  }
  return found;
}

}  // namespace assets
