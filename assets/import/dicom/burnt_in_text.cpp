#include "assets/import/dicom/burnt_in_text.h"

#include <algorithm>
#include <array>
#include <cstdlib>
#include <limits>
#include <map>
#include <tuple>

#include "assets/volume_grid.h"

namespace assets {
namespace {

constexpr std::size_t kFewestLetters = 8;
constexpr int kLowestLetter_px = 3, kHighestLetter_px = 30;
constexpr std::size_t kFewestTextSlices = 3;
constexpr int kLineTolerance_px = 1;
constexpr std::size_t kMostLetterPixels = 200'000;  // of a slice; more is metal

/// Pixels of the brightest value in one slice.
class BrightPixels {
 public:
  BrightPixels(glm::ivec2 size, std::span<const std::int16_t> slice, std::int16_t brightest)
      : size_(size), slice_(slice), brightest_(brightest), is_seen_(slice.size()) {}

  /// Boxes of the pieces that touch by sides or corners.
  std::vector<TextBox> pieces() {
    std::vector<TextBox> found;
    for (std::size_t n = 0; n < slice_.size(); ++n)
      if (slice_[n] == brightest_ && !is_seen_[n]) found.push_back(pieceFrom(n));
    return found;
  }

 private:
  TextBox pieceFrom(std::size_t start) {
    const auto columns = static_cast<std::size_t>(size_.x);
    TextBox box{glm::ivec2(std::numeric_limits<int>::max()), glm::ivec2(0)};
    front_.assign(1, start);
    is_seen_[start] = true;
    for (std::size_t n = 0; n < front_.size(); ++n) {
      const glm::ivec2 at(static_cast<int>(front_[n] % columns), static_cast<int>(front_[n] / columns));
      box.low = glm::min(box.low, at), box.end = glm::max(box.end, at + 1);
      for (int y = std::max(at.y - 1, 0); y <= std::min(at.y + 1, size_.y - 1); ++y)
        for (int x = std::max(at.x - 1, 0); x <= std::min(at.x + 1, size_.x - 1); ++x) {
          const std::size_t next = static_cast<std::size_t>(y) * columns + static_cast<std::size_t>(x);
          if (slice_[next] != brightest_ || is_seen_[next]) continue;
          is_seen_[next] = true;
          front_.push_back(next);
        }
    }
    return box;
  }

  glm::ivec2 size_;
  std::span<const std::int16_t> slice_;
  std::int16_t brightest_;
  std::vector<bool> is_seen_;
  std::vector<std::size_t> front_;
};

int heightOf(const TextBox& box) { return box.end.y - box.low.y; }

/// Lines of enough letters of one height.
std::vector<TextBox> linesOf(std::vector<TextBox> letters) {
  std::erase_if(letters, [](const TextBox& letter) {
    return heightOf(letter) < kLowestLetter_px || heightOf(letter) > kHighestLetter_px;
  });
  std::vector<TextBox> lines;
  std::vector<bool> is_used(letters.size());
  for (std::size_t first = 0; first < letters.size(); ++first) {
    if (is_used[first]) continue;
    TextBox line = letters[first];
    std::vector<std::size_t> members;
    for (std::size_t n = first; n < letters.size(); ++n) {
      const bool is_on_line = !is_used[n] && std::abs(letters[n].end.y - letters[first].end.y) <= kLineTolerance_px &&
                              std::abs(heightOf(letters[n]) - heightOf(letters[first])) <= kLineTolerance_px;
      if (is_on_line) members.push_back(n);
    }
    if (members.size() < kFewestLetters) continue;
    for (const std::size_t n : members) {
      is_used[n] = true;
      line.low = glm::min(line.low, letters[n].low), line.end = glm::max(line.end, letters[n].end);
    }
    lines.push_back(line);
  }
  return lines;
}

}  // namespace

std::vector<TextBox> burntInText(glm::ivec3 size, std::span<const std::int16_t> grey, std::int16_t no_value) {
  std::int16_t brightest = no_value;
  for (const std::int16_t value : grey)
    if (value != no_value) brightest = std::max(brightest, value);
  const std::size_t pixels = static_cast<std::size_t>(size.x) * static_cast<std::size_t>(size.y);
  using Place = std::array<int, 4>;
  std::map<Place, std::size_t> slices_of_line;
  for (int k = 0; k < size.z; ++k) {
    const auto slice = grey.subspan(static_cast<std::size_t>(k) * pixels, pixels);
    const auto bright = static_cast<std::size_t>(std::ranges::count(slice, brightest));
    if (bright < kFewestLetters * kLowestLetter_px || bright > kMostLetterPixels) continue;
    for (const TextBox& line : linesOf(BrightPixels({size.x, size.y}, slice, brightest).pieces()))
      ++slices_of_line[{line.low.x, line.low.y, line.end.x, line.end.y}];
  }
  std::vector<TextBox> boxes;
  for (const auto& [place, slices] : slices_of_line)
    if (slices >= kFewestTextSlices) boxes.push_back({{place[0], place[1]}, {place[2], place[3]}});
  return boxes;
}

void blankText(glm::ivec3 size, const std::vector<TextBox>& boxes, std::int16_t no_value,
               std::span<std::int16_t> grey) {
  for (const TextBox& box : boxes)
    forVoxels({box.low, 0}, {box.end, size.z}, [&](glm::ivec3 ijk) { grey[indexIn(size, ijk)] = no_value; });
}

}  // namespace assets
