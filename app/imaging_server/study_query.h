// What a server is asked for: values of identifying attributes, as `--find "PatientID=…"` says them, several joined by
// &. Nobody sees them but the server. Any thread.
#pragma once

#include <cstdint>
#include <string>
#include <string_view>
#include <vector>

namespace app {

struct QueryKey {
  std::string_view name;  ///< the standard's keyword
  std::uint16_t group = 0, element = 0;
  std::string value;
};

/// Throws UsageError, without the values.
std::vector<QueryKey> studyQuery(const std::string& find);

/// "PatientID=…&StudyDate=…", percent-encoded (RFC 3986).
std::string asUrlQuery(const std::vector<QueryKey>& keys);

}  // namespace app
