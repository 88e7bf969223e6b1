#include "calibration/webcam/gray_code.h"

#include <algorithm>
#include <array>
#include <bit>
#include <cmath>
#include <utility>

#include "calibration/calibration_error.h"
#include "calibration/webcam/image_matrix.h"

namespace calibration {
namespace {

constexpr int kLeastContrast = 24;     ///< of white to black, grey levels: less is not the screen
constexpr double kLeastOfWhite = 0.2;  ///< of a pattern to its inverse, of white to black: less is an edge
constexpr int kLeastCellPixels = 6;    ///< of a cell

unsigned grayOf(unsigned number) { return number ^ (number >> 1); }
unsigned numberOf(unsigned gray) {
  unsigned number = 0;
  for (; gray != 0; gray >>= 1) number ^= gray;
  return number;
}

/// The mean place of a cell's pixels, and whether they are as compact as a cell is.
struct Cell {
  glm::dvec2 sum{0.0};
  glm::ivec2 least{1 << 20}, most{-1};
  int pixels = 0;
};

void checkPictures(const GrayCode& code, const std::vector<GreyImage>& images) {
  if (static_cast<int>(images.size()) != code.images())
    throw CalibrationError("Gray code: " + std::to_string(images.size()) + " pictures instead of " +
                           std::to_string(code.images()) + ", take the sweep again");
  for (const GreyImage& image : images)
    if (image.size_px != images.front().size_px || !isWhole(image))
      throw CalibrationError("Gray code: the pictures differ in size, take the sweep again");
}

/// The bits from `first` on, of one pixel; -1 where one of them can not be told.
int codeAt(const std::vector<GreyImage>& images, std::size_t first, int bits, std::size_t pixel, int white_to_black) {
  unsigned gray = 0;
  for (int bit = 0; bit < bits; ++bit) {
    const std::size_t shown = first + 2 * static_cast<std::size_t>(bit);
    const int difference = int{images[shown].grey[pixel]} - int{images[shown + 1].grey[pixel]};
    if (std::abs(difference) < kLeastOfWhite * white_to_black) return -1;
    gray = (gray << 1) | static_cast<unsigned>(difference > 0);
  }
  return static_cast<int>(numberOf(gray));
}

bool isSeen(const Cell& cell) { return cell.pixels >= kLeastCellPixels; }

/// A cell's pixels lie together.
bool isCompact(const Cell& cell) {
  const glm::ivec2 box = cell.most - cell.least + 1;
  return double(box.x) * box.y <= 6.0 * cell.pixels + 20.0;
}

/// What the pixels say: every cell with its pixels.
struct SeenCells {
  glm::ivec2 count{0};
  std::vector<Cell> cells;
  int decoded = 0, impossible = 0;  ///< pixels; impossible: a cell that the screen does not have

  Cell& at(int x, int y) {
    return cells[static_cast<std::size_t>(y) * static_cast<std::size_t>(count.x) + static_cast<std::size_t>(x)];
  }
  /// Seen with its eight neighbours: not cut by the image's edge, by a shadow, by the screen's end.
  bool isWhole(int x, int y) {
    for (int dy = -1; dy <= 1; ++dy)
      for (int dx = -1; dx <= 1; ++dx)
        if (!isSeen(at(x + dx, y + dy))) return false;
    return true;
  }
};
SeenCells cellsSeen(const GrayCode& code, const std::vector<GreyImage>& images, GreyImage& mask) {
  const glm::ivec2 size = images.front().size_px, bits = code.bits();
  SeenCells seen{code.cells(), {}};
  seen.cells.resize(static_cast<std::size_t>(seen.count.x) * static_cast<std::size_t>(seen.count.y));
  for (int y = 0; y < size.y; ++y)
    for (int x = 0; x < size.x; ++x) {
      const std::size_t pixel =
          static_cast<std::size_t>(y) * static_cast<std::size_t>(size.x) + static_cast<std::size_t>(x);
      const int white_to_black = int{images[0].grey[pixel]} - int{images[1].grey[pixel]};
      if (white_to_black < kLeastContrast) continue;
      const int column = codeAt(images, 2, bits.x, pixel, white_to_black);
      const int row = codeAt(images, 2 + 2 * static_cast<std::size_t>(bits.x), bits.y, pixel, white_to_black);
      if (column < 0 || row < 0) continue;
      ++seen.decoded;
      if (column >= seen.count.x || row >= seen.count.y) {
        ++seen.impossible;
        continue;
      }
      mask.grey[pixel] = 255;
      Cell& cell = seen.at(column, row);
      cell.sum += glm::dvec2(x, y);
      cell.least = glm::min(cell.least, glm::ivec2(x, y));
      cell.most = glm::max(cell.most, glm::ivec2(x, y));
      ++cell.pixels;
    }
  return seen;
}

/// How the image's place grows with the screen's x and y (columns), as one affine map by least squares. None: too few
/// or on a line.
std::optional<glm::dmat2> directionOf(const std::vector<ScreenCorrespondence>& sights) {
  if (sights.size() < 12) return std::nullopt;
  glm::dvec2 screen{0.0}, camera{0.0};
  for (const ScreenCorrespondence& sight : sights) screen += sight.screen_px, camera += sight.camera_px;
  screen /= double(sights.size()), camera /= double(sights.size());
  glm::dmat2 spread{0.0}, both{0.0};
  for (const ScreenCorrespondence& sight : sights) {
    const glm::dvec2 s = sight.screen_px - screen, c = sight.camera_px - camera;
    spread += glm::outerProduct(s, s);
    both += glm::outerProduct(c, s);
  }
  const double size = spread[0][0] * spread[1][1];
  if (!(glm::determinant(spread) > 1e-6 * size) || size <= 0.0) return std::nullopt;
  return both * glm::inverse(spread);
}

CodeDetection refused(CodeTrouble trouble, const char* line, CodeDetection sighting) {
  sighting.trouble = trouble;
  sighting.line = line;
  sighting.sights.clear();
  return sighting;
}

}  // namespace

glm::ivec2 GrayCode::bits() const {
  const auto enough = [](int count) { return static_cast<int>(std::bit_width(static_cast<unsigned>(count - 1))); };
  return {enough(cells().x), enough(cells().y)};
}

std::vector<GreyImage> patternImages(const GrayCode& code) {
  if (code.screen_px.x < 64 || code.screen_px.y < 64 || code.cell_px < 2)
    throw CalibrationError("Gray code: a screen under 64 px or stripes under 2 px, use a larger window");
  const std::size_t pixels = static_cast<std::size_t>(code.screen_px.x) * static_cast<std::size_t>(code.screen_px.y);
  std::vector<GreyImage> images{{code.screen_px, std::vector<std::uint8_t>(pixels, kShownWhite)},
                                {code.screen_px, std::vector<std::uint8_t>(pixels, kShownBlack)}};
  for (int axis = 0; axis < 2; ++axis)
    for (int bit = code.bits()[axis] - 1; bit >= 0; --bit) {
      GreyImage pattern{code.screen_px, {}}, inverse{code.screen_px, {}};
      pattern.grey.reserve(pixels), inverse.grey.reserve(pixels);
      for (int y = 0; y < code.screen_px.y; ++y)
        for (int x = 0; x < code.screen_px.x; ++x) {
          const auto cell = static_cast<unsigned>((axis == 0 ? x : y) / code.cell_px);
          const bool white = ((grayOf(cell) >> bit) & 1U) != 0;
          pattern.grey.push_back(white ? kShownWhite : kShownBlack);
          inverse.grey.push_back(white ? kShownBlack : kShownWhite);
        }
      images.push_back(std::move(pattern));
      images.push_back(std::move(inverse));
    }
  return images;
}

CodeDetection decoded(const GrayCode& code, const std::vector<GreyImage>& images) {
  checkPictures(code, images);
  CodeDetection sighting;
  sighting.mask = {images.front().size_px, std::vector<std::uint8_t>(images.front().grey.size(), 0)};
  SeenCells seen = cellsSeen(code, images, sighting.mask);

  // Whole cells only, by the mean place of their pixels.
  int complete = 0, scattered = 0;
  for (int y = 1; y + 1 < seen.count.y; ++y)
    for (int x = 1; x + 1 < seen.count.x; ++x) {
      if (!seen.isWhole(x, y)) continue;
      const Cell& cell = seen.at(x, y);
      ++complete;
      if (!isCompact(cell))
        ++scattered;
      else
        sighting.sights.push_back(
            {(glm::dvec2(x, y) + 0.5) * double(code.cell_px) - 0.5, cell.sum / double(cell.pixels)});
    }
  sighting.seen_share = double(complete) / std::max(1, (seen.count.x - 2) * (seen.count.y - 2));

  const auto direction = directionOf(sighting.sights);
  if (seen.impossible > seen.decoded / 10 || scattered > complete / 4)
    return refused(CodeTrouble::mixed_up,
                   "the stripes do not fit together: hold camera and light still during the sweep and take it again",
                   std::move(sighting));
  if (!direction)
    return refused(CodeTrouble::not_seen,
                   "the stripes are not seen: point the camera at the screen, go nearer, darken the room",
                   std::move(sighting));
  // Columns that decrease to the right or rows that decrease downwards: a flip too many, or a turned camera.
  if (glm::determinant(*direction) < 0.0)
    return refused(CodeTrouble::mirrored,
                   (*direction)[0].x < 0.0
                       ? "the screen is mirrored left to right: correct its corners in the rig file"
                       : "the screen is mirrored top to bottom: correct its corners in the rig file",
                   std::move(sighting));
  if ((*direction)[0].x < 0.0)
    return refused(CodeTrouble::upside_down,
                   "the screen stands on its head: turn the camera by half a turn, or correct the rig file's corners",
                   std::move(sighting));
  return sighting;
}

}  // namespace calibration
