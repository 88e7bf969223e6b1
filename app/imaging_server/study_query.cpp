#include "app/imaging_server/study_query.h"

#include <algorithm>
#include <array>
#include <cstdint>
#include <string_view>

#include "app/text/list.h"
#include "app/text/usage_error.h"

namespace app {
namespace {

struct KnownKey {
  std::string_view name;
  std::uint16_t group, element;
};
/// PS3.4 table C.6-5, keys of a study.
constexpr std::array<KnownKey, 6> kKeys = {{{"PatientID", 0x0010, 0x0020},
                                            {"PatientName", 0x0010, 0x0010},
                                            {"PatientBirthDate", 0x0010, 0x0030},
                                            {"StudyDate", 0x0008, 0x0020},
                                            {"AccessionNumber", 0x0008, 0x0050},
                                            {"StudyInstanceUID", 0x0020, 0x000d}}};
constexpr std::size_t kLongestValue = 256;

bool isUnreserved(char c) {
  return (c >= '0' && c <= '9') || (c >= 'A' && c <= 'Z') || (c >= 'a' && c <= 'z') || c == '-' || c == '.' ||
         c == '_' || c == '~';
}

}  // namespace

std::vector<QueryKey> studyQuery(const std::string& find) {
  std::vector<QueryKey> keys;
  for (const std::string_view part : split(find, '&')) {
    const std::size_t equals = part.find('=');
    const auto known = std::ranges::find(kKeys, part.substr(0, std::min(equals, part.size())), &KnownKey::name);
    if (equals == std::string_view::npos || known == kKeys.end())
      throw UsageError("--find: give \"PatientID=…\"; it knows " + joined(kKeys, &KnownKey::name) +
                       ", several joined by &");
    QueryKey key{known->name, known->group, known->element, std::string(part.substr(equals + 1))};
    // Nothing, or stars alone, asks for everybody.
    if (key.value.find_first_not_of("*?") == std::string::npos || key.value.size() > kLongestValue ||
        std::ranges::any_of(key.value, [](char c) { return static_cast<unsigned char>(c) < ' ' || c == '\\'; }))
      throw UsageError("--find: the value of " + std::string(key.name) + " is empty, too long, or for everybody");
    keys.push_back(std::move(key));
  }
  return keys;
}

std::string asUrlQuery(const std::vector<QueryKey>& keys) {
  constexpr std::string_view kDigits = "0123456789ABCDEF";
  std::string query;
  for (const QueryKey& key : keys) {
    query += (query.empty() ? "" : "&") + std::string(key.name) + "=";
    for (const char c : key.value)
      if (isUnreserved(c))
        query += c;
      else
        query += {'%', kDigits[static_cast<unsigned char>(c) >> 4], kDigits[static_cast<unsigned char>(c) & 15]};
  }
  return query;
}

}  // namespace app
