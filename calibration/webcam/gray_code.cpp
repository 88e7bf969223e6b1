#include "calibration/webcam/gray_code.h"

#include <bit>
#include <cmath>
#include <utility>

#include "calibration/calibration_error.h"
#include "calibration/webcam/image_matrix.h"

namespace calibration {
namespace {

constexpr int kMinContrast = 24;     ///< white minus black, grey levels: below, it is not the screen
constexpr double kMinOfWhite = 0.2;  ///< pattern minus inverse, relative to white minus black: below, it is an edge
constexpr int kMinCellPixels = 6;    ///< of a cell

unsigned grayOf(unsigned number) { return number ^ (number >> 1); }
unsigned numberOf(unsigned gray) {
  unsigned number = 0;
  for (; gray != 0; gray >>= 1) number ^= gray;
  return number;
}

/// Sum and bounding box of a cell's pixels.
struct Cell {
  glm::dvec2 sum{0.0};
  glm::ivec2 least{1 << 20}, most{-1};
  int pixels = 0;
};

void checkPictures(const GrayCode& code, const std::vector<GreyImage>& images) {
  if (static_cast<int>(images.size()) != code.images())
    throw CalibrationError("Gray code: " + std::to_string(images.size()) + " images instead of " +
                           std::to_string(code.images()) + ", take the sweep again");
  for (const GreyImage& image : images)
    if (image.size_px != images.front().size_px || !image.isWhole())
      throw CalibrationError("Gray code: the images differ in size, take the sweep again");
}

/// The code of one pixel from image `first` on; -1: a bit is ambiguous.
int codeAt(const std::vector<GreyImage>& images, std::size_t first, int bits, std::size_t pixel, int white_to_black) {
  unsigned gray = 0;
  for (int bit = 0; bit < bits; ++bit) {
    const std::size_t shown = first + 2 * static_cast<std::size_t>(bit);
    const int difference = int{images[shown].grey[pixel]} - int{images[shown + 1].grey[pixel]};
    if (std::abs(difference) < kMinOfWhite * white_to_black) return -1;
    gray = (gray << 1) | static_cast<unsigned>(difference > 0);
  }
  return static_cast<int>(numberOf(gray));
}

bool isSeen(const Cell& cell) { return cell.pixels >= kMinCellPixels; }

/// The pixels lie together.
bool isCompact(const Cell& cell) {
  const glm::ivec2 box = cell.most - cell.least + 1;
  return double(box.x) * box.y <= 6.0 * cell.pixels + 20.0;
}

/// All cells of the screen with their pixels.
struct SeenCells {
  glm::ivec2 count{0};
  std::vector<Cell> cells;
  int decoded = 0, impossible = 0;  ///< pixels; impossible: code beyond the screen's cells

  Cell& at(int x, int y) {
    return cells[static_cast<std::size_t>(y) * static_cast<std::size_t>(count.x) + static_cast<std::size_t>(x)];
  }
  /// With all eight neighbours visible: not cut by the image's edge, a shadow or the screen's end.
  bool isWhole(int x, int y) {
    for (int dy = -1; dy <= 1; ++dy)
      for (int dx = -1; dx <= 1; ++dx)
        if (!isSeen(at(x + dx, y + dy))) return false;
    return true;
  }
};
SeenCells cellsSeen(const GrayCode& code, const std::vector<GreyImage>& images) {
  const glm::ivec2 size = images.front().size_px, bits = code.bits();
  SeenCells seen{code.cells(), {}};
  seen.cells.resize(GreyImage::pixels(seen.count));
  for (int y = 0; y < size.y; ++y)
    for (int x = 0; x < size.x; ++x) {
      const std::size_t pixel = images.front().indexOf(x, y);
      const int white_to_black = int{images[0].grey[pixel]} - int{images[1].grey[pixel]};
      if (white_to_black < kMinContrast) continue;
      const int column = codeAt(images, 2, bits.x, pixel, white_to_black);
      const int row = codeAt(images, 2 + 2 * static_cast<std::size_t>(bits.x), bits.y, pixel, white_to_black);
      if (column < 0 || row < 0) continue;
      ++seen.decoded;
      if (column >= seen.count.x || row >= seen.count.y) {
        ++seen.impossible;
        continue;
      }
      Cell& cell = seen.at(column, row);
      cell.sum += glm::dvec2(x, y);
      cell.least = glm::min(cell.least, glm::ivec2(x, y));
      cell.most = glm::max(cell.most, glm::ivec2(x, y));
      ++cell.pixels;
    }
  return seen;
}

/// Linear map from screen to image by least squares. None: too few points or collinear.
std::optional<glm::dmat2> directionOf(const std::vector<ScreenCorrespondence>& correspondences) {
  if (correspondences.size() < 12) return std::nullopt;
  glm::dvec2 screen{0.0}, camera{0.0};
  for (const ScreenCorrespondence& correspondence : correspondences)
    screen += correspondence.screen_px, camera += correspondence.camera_px;
  screen /= double(correspondences.size()), camera /= double(correspondences.size());
  glm::dmat2 spread{0.0}, both{0.0};
  for (const ScreenCorrespondence& correspondence : correspondences) {
    const glm::dvec2 s = correspondence.screen_px - screen, c = correspondence.camera_px - camera;
    spread += glm::outerProduct(s, s);
    both += glm::outerProduct(c, s);
  }
  const double size = spread[0][0] * spread[1][1];
  if (!(glm::determinant(spread) > 1e-6 * size) || size <= 0.0) return std::nullopt;
  return both * glm::inverse(spread);
}

}  // namespace

glm::ivec2 GrayCode::bits() const {
  const auto enough = [](int count) { return static_cast<int>(std::bit_width(static_cast<unsigned>(count - 1))); };
  return {enough(cells().x), enough(cells().y)};
}

std::vector<GreyImage> patternImages(const GrayCode& code) {
  if (code.screen_px.x < 64 || code.screen_px.y < 64 || code.cell_px < 2)
    throw CalibrationError("Gray code: a screen under 64 px or stripes under 2 px, use a larger window");
  std::vector<GreyImage> images{GreyImage::filled(code.screen_px, kShownWhite),
                                GreyImage::filled(code.screen_px, kShownBlack)};
  for (int axis = 0; axis < 2; ++axis)
    for (int bit = code.bits()[axis] - 1; bit >= 0; --bit) {
      GreyImage pattern = images[1], inverse = images[0];
      for (int y = 0; y < code.screen_px.y; ++y)
        for (int x = 0; x < code.screen_px.x; ++x) {
          const auto cell = static_cast<unsigned>((axis == 0 ? x : y) / code.cell_px);
          if (((grayOf(cell) >> bit) & 1U) != 0) std::swap(pattern.at(x, y), inverse.at(x, y));
        }
      images.push_back(std::move(pattern));
      images.push_back(std::move(inverse));
    }
  return images;
}

CodeDetection decoded(const GrayCode& code, const std::vector<GreyImage>& images) {
  checkPictures(code, images);
  CodeDetection detection;
  SeenCells seen = cellsSeen(code, images);

  // Complete cells only, by the mean position of their pixels.
  int complete = 0, scattered = 0;
  for (int y = 1; y + 1 < seen.count.y; ++y)
    for (int x = 1; x + 1 < seen.count.x; ++x) {
      if (!seen.isWhole(x, y)) continue;
      const Cell& cell = seen.at(x, y);
      ++complete;
      if (!isCompact(cell))
        ++scattered;
      else
        detection.correspondences.push_back(
            {(glm::dvec2(x, y) + 0.5) * double(code.cell_px) - 0.5, cell.sum / double(cell.pixels)});
    }

  const auto direction = directionOf(detection.correspondences);
  if (seen.impossible > seen.decoded / 10 || scattered > complete / 4)
    return {CodeTrouble::mixed_up,
            "the stripes do not fit together: hold camera and light still during the sweep and take it again",
            {}};
  if (!direction)
    return {CodeTrouble::not_seen,
            "the stripes are not seen: point the camera at the screen, go nearer, darken the room",
            {}};
  // Columns that decrease to the right or rows that decrease downwards: one flip too many, or a rotated camera.
  if (glm::determinant(*direction) < 0.0)
    return {CodeTrouble::mirrored,
            (*direction)[0].x < 0.0 ? "the screen is mirrored left to right: correct its corners in the rig file"
                                    : "the screen is mirrored top to bottom: correct its corners in the rig file",
            {}};
  if ((*direction)[0].x < 0.0)
    return {CodeTrouble::upside_down,
            "the screen is upside down: turn the camera by half a turn, or correct the rig file's corners",
            {}};
  return detection;
}

}  // namespace calibration
