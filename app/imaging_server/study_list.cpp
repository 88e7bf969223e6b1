#include "app/imaging_server/study_list.h"

#include <algorithm>
#include <tuple>

#include <nlohmann/json.hpp>

#include "app/text/usage_error.h"
#include "assets/json_depth.h"

namespace app {
namespace {

using Json = nlohmann::json;

Json listOf(std::string_view json, const std::string& where) {
  Json list = assets::isNestedTooDeep(json) ? Json() : Json::parse(json, nullptr, false);
  if (!list.is_array()) throw UsageError(where + ": its list of studies cannot be read; check that this is DICOMweb");
  return list;
}

/// Values of an attribute; none where it has none.
const Json& valuesOf(const Json& one, const char* tag) {
  static const Json kNone = Json::array();
  if (!one.is_object()) return kNone;
  const auto attribute = one.find(tag);
  if (attribute == one.end() || !attribute->is_object()) return kNone;
  const auto values = attribute->find("Value");
  return values != attribute->end() && values->is_array() ? *values : kNone;
}

std::string textOf(const Json& one, const char* tag) {
  const Json& values = valuesOf(one, tag);
  return !values.empty() && values.front().is_string() ? values.front().get<std::string>() : std::string();
}

}  // namespace

bool isIdentifier(std::string_view text) {
  constexpr std::size_t kLongest = 64;
  return !text.empty() && text.size() <= kLongest &&
         std::ranges::all_of(text, [](char c) { return (c >= '0' && c <= '9') || c == '.'; });
}

std::string printable(std::string_view text) {
  constexpr std::size_t kLongest = 60;
  std::string kept;
  for (std::size_t n = 0; n < text.size() && kept.size() < kLongest; ++n) {
    const auto c = static_cast<unsigned char>(text[n]);
    // Two bytes of UTF-8 are control letters too.
    const bool is_control = c < ' ' || c == 0x7f || c == 0x9b ||
                            (c == 0xc2 && n + 1 < text.size() && static_cast<unsigned char>(text[n + 1]) < 0xa0);
    if (is_control)
      n += c == 0xc2 ? 1 : 0;
    else
      kept += text[n];
  }
  return kept;
}

std::string shownDate(std::string_view text) {
  const bool is_date = text.size() == 8 && std::ranges::all_of(text, [](char c) { return c >= '0' && c <= '9'; });
  if (!is_date) return {};
  return std::string(text.substr(0, 4)) + "-" + std::string(text.substr(4, 2)) + "-" + std::string(text.substr(6));
}

void sortStudies(std::vector<FoundStudy>& studies) {
  std::ranges::sort(studies, [](const FoundStudy& a, const FoundStudy& b) {
    return std::tie(a.date, a.uid) < std::tie(b.date, b.uid);
  });
}

std::vector<FoundStudy> studiesOf(std::string_view json, const std::string& where) {
  std::vector<FoundStudy> studies;
  for (const Json& one : listOf(json, where)) {
    FoundStudy study;
    study.uid = textOf(one, "0020000D");
    if (!isIdentifier(study.uid)) throw UsageError(where + ": a study in its list has no identifier");
    study.date = shownDate(textOf(one, "00080020"));
    study.description = printable(textOf(one, "00081030"));
    for (const Json& modality : valuesOf(one, "00080061"))
      if (modality.is_string())
        study.modalities += (study.modalities.empty() ? "" : ", ") + printable(modality.get<std::string>());
    study.modalities = printable(study.modalities);
    const Json& images = valuesOf(one, "00201208");
    if (!images.empty() && images.front().is_number_integer())
      study.images = static_cast<int>(std::clamp<std::int64_t>(images.front().get<std::int64_t>(), 0, 1'000'000));
    studies.push_back(std::move(study));
    if (studies.size() == kMostStudies) break;
  }
  sortStudies(studies);
  return studies;
}

std::vector<std::string> seriesOf(std::string_view json, const std::string& where) {
  constexpr std::size_t kMostSeries = 200;
  std::vector<std::string> series;
  for (const Json& one : listOf(json, where)) {
    series.push_back(textOf(one, "0020000E"));
    if (!isIdentifier(series.back())) throw UsageError(where + ": a series in its list has no identifier");
    if (series.size() == kMostSeries) break;
  }
  return series;
}

}  // namespace app
