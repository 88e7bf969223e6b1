// Studies and series that a server has, out of its answer in the DICOM JSON model (PS3.18 annex F), or as another route
// tells them. Shown on a terminal, stored nowhere. Any thread.
#pragma once

#include <string>
#include <string_view>
#include <vector>

namespace app {

struct FoundStudy {
  std::string uid;
  std::string date;         ///< "2026-03-14"
  std::string description;  ///< printable, at most 60 letters
  std::string modalities;   ///< "CT, OT"
  int images = 0;           ///< 0: not told
};

/// At most this many are listed.
inline constexpr std::size_t kMostStudies = 200;

/// The oldest first, of a day by their identifiers. Throws UsageError: it is not such a list; `where` names the server.
std::vector<FoundStudy> studiesOf(std::string_view json, const std::string& where);
/// Identifiers of series.
std::vector<std::string> seriesOf(std::string_view json, const std::string& where);

/// Digits and dots, up to 64.
bool isIdentifier(std::string_view text);
/// Without what a terminal obeys.
std::string printable(std::string_view text);
/// 20260314 as 2026-03-14; empty for anything else.
std::string shownDate(std::string_view text);
/// In the order of studiesOf.
void sortStudies(std::vector<FoundStudy>& studies);

}  // namespace app
