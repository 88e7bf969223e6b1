// Writes small DICOM files byte by byte (PS3.5, PS3.10), explicit little endian, so that the reader is tested against
// the format and not against a library. Elements lie in a map by tag: a test adds, changes or erases any of them.
#pragma once

#include <cmath>
#include <cstdint>
#include <cstring>
#include <functional>
#include <map>
#include <sstream>
#include <string>
#include <vector>

#include <glm/glm.hpp>

namespace dicom_on_disk {

struct Value {
  std::string type;
  std::string bytes;
};

template <class Number>
std::string raw(Number number) {
  std::string bytes(sizeof number, '\0');
  std::memcpy(bytes.data(), &number, sizeof number);
  return bytes;
}
inline Value shortValue(int number) { return {"US", raw(static_cast<std::uint16_t>(number))}; }
inline Value text(const std::string& type, std::string value) {
  if (value.size() % 2 != 0) value += type == "UI" ? '\0' : ' ';
  return {type, value};
}
inline Value decimals(const std::vector<double>& numbers) {
  std::ostringstream joined;
  joined.precision(10);
  for (std::size_t n = 0; n < numbers.size(); ++n) joined << (n == 0 ? "" : "\\") << numbers[n];
  return text("DS", joined.str());
}

/// Tag, type, length, value.
inline std::string element(std::uint32_t tag, const Value& value) {
  std::string bytes = raw(static_cast<std::uint16_t>(tag >> 16)) + raw(static_cast<std::uint16_t>(tag)) + value.type;
  const bool is_long = value.type == "OB" || value.type == "OW" || value.type == "SQ" || value.type == "UN" ||
                       value.type == "UT" || value.type == "UC";
  if (is_long)
    bytes += std::string(2, '\0') + raw(static_cast<std::uint32_t>(value.bytes.size()));
  else
    bytes += raw(static_cast<std::uint16_t>(value.bytes.size()));
  return bytes + value.bytes;
}

inline std::string item(const std::string& elements) {
  return raw(std::uint16_t{0xfffe}) + raw(std::uint16_t{0xe000}) + raw(static_cast<std::uint32_t>(elements.size())) +
         elements;
}
/// A sequence of items, each already of elements.
inline Value sequence(const std::vector<std::string>& items) {
  std::string bytes;
  for (const std::string& one : items) bytes += item(one);
  return {"SQ", bytes};
}

using Elements = std::map<std::uint32_t, Value>;

/// A plain CT slice.
inline Elements slice(int rows, int columns, const std::vector<std::int16_t>& stored) {
  Elements file;
  file[0x00080008] = text("CS", "ORIGINAL\\PRIMARY\\AXIAL");
  file[0x00080016] = text("UI", "1.2.840.10008.5.1.4.1.1.2");
  file[0x00080060] = text("CS", "CT");
  file[0x00100010] = text("PN", "Example^Person");
  file[0x0020000d] = text("UI", "1.2.3");
  file[0x0020000e] = text("UI", "1.2.3.1");
  file[0x00200052] = text("UI", "1.2.3.9");
  file[0x00200037] = decimals({1, 0, 0, 0, 1, 0});
  file[0x00280002] = shortValue(1);
  file[0x00280004] = text("CS", "MONOCHROME2");
  file[0x00280010] = shortValue(rows);
  file[0x00280011] = shortValue(columns);
  file[0x00280030] = decimals({0.5, 0.5});
  file[0x00280100] = shortValue(16);
  file[0x00280101] = shortValue(16);
  file[0x00280102] = shortValue(15);
  file[0x00280103] = shortValue(1);
  file[0x00281052] = decimals({0});
  file[0x00281053] = decimals({1});
  file[0x7fe00010] = {"OW", std::string(reinterpret_cast<const char*>(stored.data()), stored.size() * 2)};
  return file;
}

inline std::string bytesOf(const Elements& elements, const std::string& syntax = "1.2.840.10008.1.2.1",
                           const std::string& preamble = std::string(128, '\0')) {
  std::string facts =
      element(0x00020002, text("UI", "1.2.840.10008.5.1.4.1.1.2")) + element(0x00020010, text("UI", syntax));
  facts = element(0x00020000, {"UL", raw(static_cast<std::uint32_t>(facts.size()))}) + facts;
  std::string bytes = preamble + "DICM" + facts;
  for (const auto& [tag, value] : elements) bytes += element(tag, value);
  return bytes;
}

/// A field of grey values, sampled by slices.
using Field = std::function<double(const glm::dvec3& p_P_mm)>;

struct Series {
  int rows = 64, columns = 72, slices = 64;
  glm::dvec3 row_P{1, 0, 0}, column_P{0, 1, 0};
  glm::dvec3 step_P_mm{0, 0, 0.5};  ///< from slice to slice
  glm::dvec3 origin_P_mm{-10, 20, 30};
  glm::dvec2 spacing_mm{0.5, 0.5};  ///< between rows, between columns

  glm::dvec3 position_P_mm(int k) const { return origin_P_mm + static_cast<double>(k) * step_P_mm; }
};

inline Elements sliceOf(const Series& series, int k, const Field& field) {
  std::vector<std::int16_t> stored;
  for (int r = 0; r < series.rows; ++r)
    for (int c = 0; c < series.columns; ++c)
      stored.push_back(static_cast<std::int16_t>(
          std::lround(field(series.position_P_mm(k) + series.row_P * (series.spacing_mm.y * c) +
                            series.column_P * (series.spacing_mm.x * r)))));
  Elements file = slice(series.rows, series.columns, stored);
  const glm::dvec3 p = series.position_P_mm(k), x = series.row_P, y = series.column_P;
  file[0x00200032] = decimals({p.x, p.y, p.z});
  file[0x00200037] = decimals({x.x, x.y, x.z, y.x, y.y, y.z});
  file[0x00280030] = decimals({series.spacing_mm.x, series.spacing_mm.y});
  file[0x00200013] = text("IS", std::to_string(k + 1));
  return file;
}

}  // namespace dicom_on_disk
