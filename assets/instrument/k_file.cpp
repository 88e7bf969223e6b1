#include "assets/instrument/k_file.h"

#include <algorithm>

namespace assets {

double KFile::diameter_mm(double from_tip_mm) const {
  return tip_mm() + kTaper * std::clamp(from_tip_mm, 0.0, kCutting_mm);
}

std::string_view KFile::colour() const {
  constexpr std::array<std::string_view, 3> kFine{"pink", "grey", "purple"};
  constexpr std::array<std::string_view, 6> kRest{"white", "yellow", "red", "blue", "green", "black"};
  const auto at =
      static_cast<std::size_t>(std::find(kKFileSizes.begin(), kKFileSizes.end(), size) - kKFileSizes.begin());
  return at < kFine.size() ? kFine[at] : kRest[(at - kFine.size()) % kRest.size()];
}

std::optional<KFile> kFile(int size, int length_mm, KFileMetal metal) {
  // Tables of its own: the servo's thread comes here, and reads no symbol of another object.
  static constexpr auto kSizes = kKFileSizes;
  static constexpr auto kLengths_mm = kKFileLengths_mm;
  if (std::find(kSizes.begin(), kSizes.end(), size) == kSizes.end()) return std::nullopt;
  if (std::find(kLengths_mm.begin(), kLengths_mm.end(), length_mm) == kLengths_mm.end()) return std::nullopt;
  return KFile{size, static_cast<double>(length_mm), metal};
}

}  // namespace assets
