#include "assets/import/dicom/dicom_values.h"

#include <bit>
#include <cmath>

#include "assets/scan/header_text.h"

namespace assets {
namespace {

constexpr std::uint32_t kLongest = 1 << 16;

std::string bytesOf(const DicomBytes& bytes, const DicomElement& element) {
  if (element.length > kLongest) return {};
  std::string text(element.length, '\0');
  return bytes.read(element.at, text) ? text : std::string();
}

bool isOf(const DicomElement& element, char first, char second) {
  return element.type[0] == first && element.type[1] == second;
}

template <class Real, class Bits>
std::vector<double> realsOf(const std::string& raw, bool is_big_endian) {
  std::vector<double> numbers;
  for (std::size_t at = 0; at + sizeof(Bits) <= raw.size(); at += sizeof(Bits)) {
    Bits bits = 0;
    for (std::size_t n = 0; n < sizeof(Bits); ++n)
      bits = bits << 8 | static_cast<unsigned char>(raw[at + (is_big_endian ? n : sizeof(Bits) - 1 - n)]);
    numbers.push_back(static_cast<double>(std::bit_cast<Real>(bits)));
  }
  return numbers;
}

}  // namespace

std::string textOf(const DicomBytes& bytes, const DicomElement& element) {
  const std::string raw = bytesOf(bytes, element);
  const std::size_t first = raw.find_first_not_of(std::string_view(" \0", 2));
  if (first == std::string::npos) return {};
  return raw.substr(first, raw.find_last_not_of(std::string_view(" \0", 2)) - first + 1);
}

std::vector<double> numbersOf(const DicomBytes& bytes, const DicomElement& element, bool is_big_endian) {
  std::vector<double> numbers;
  if (isOf(element, 'F', 'D')) {
    numbers = realsOf<double, std::uint64_t>(bytesOf(bytes, element), is_big_endian);
  } else if (isOf(element, 'F', 'L')) {
    numbers = realsOf<float, std::uint32_t>(bytesOf(bytes, element), is_big_endian);
  } else {
    const std::string text = textOf(bytes, element);
    for (std::size_t at = 0; at <= text.size() && !text.empty();) {
      const std::size_t end = std::min(text.find('\\', at), text.size());
      const auto number = parseReal(trimmed(std::string_view(text).substr(at, end - at)));
      if (!number) return {};
      numbers.push_back(*number);
      at = end + 1;
    }
  }
  for (const double number : numbers)
    if (!std::isfinite(number)) return {};
  return numbers;
}

std::optional<double> numberOf(const DicomBytes& bytes, const DicomElement& element, bool is_big_endian) {
  const std::vector<double> numbers = numbersOf(bytes, element, is_big_endian);
  return numbers.empty() ? std::nullopt : std::optional(numbers.front());
}

std::optional<std::int64_t> integerOf(const DicomBytes& bytes, const DicomElement& element, bool is_big_endian) {
  if (isOf(element, 'I', 'S') || isOf(element, 'D', 'S')) {
    const auto number = numberOf(bytes, element, is_big_endian);
    if (!number || std::abs(*number) > 2.0e9) return std::nullopt;
    return std::llround(*number);
  }
  if (element.length != 2 && element.length != 4) return std::nullopt;
  const std::uint32_t value = integerAt(bytes, element.at, element.length, is_big_endian);
  return static_cast<std::int64_t>(value);
}

std::uint64_t hashOf(const DicomBytes& bytes, const DicomElement& element) {
  const std::string text = textOf(bytes, element);
  if (text.empty()) return 0;
  std::uint64_t hash = 0xcbf29ce484222325;
  for (const char letter : text) hash = (hash ^ static_cast<unsigned char>(letter)) * 0x100000001b3;
  return hash;
}

}  // namespace assets
