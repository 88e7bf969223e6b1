// `molar calibrate lens`: a camera's lens from pictures of a chessboard.

#include <cstdio>
#include <filesystem>
#include <memory>

#include "app/calibrate/calibration_text.h"
#include "app/commands/calibrate/calibrate.h"
#include "app/options/view_option.h"
#include "app/text/command_line.h"
#include "app/text/usage_error.h"
#include "calibration/output_file.h"
#include "calibration/record/utc.h"
#include "calibration/webcam/board.h"
#include "calibration/webcam/camera_file.h"
#include "calibration/webcam/image_reader.h"
#include "calibration/webcam/image_source.h"

namespace app {
namespace {

using namespace calibration;

struct LensOptions {
  std::string folder, out, board, screen = "1920x1080", name, serial;
  double square_mm = 25.0;
  bool force = false, json = false;
};

/// "9x6": inner corners across and down.
glm::ivec2 cornersNamed(const std::string& text) {
  int across = 0, down = 0, end = 0;
  const bool read = std::sscanf(text.c_str(), "%3dx%3d%n", &across, &down, &end) == 2;
  if (!read || static_cast<std::size_t>(end) != text.size() || across < 3 || down < 3 || across > 60 || down > 60)
    throw UsageError("--board " + text + ": not the inner corners of a chessboard, write 9x6, 3 to 60 each");
  return {across, down};
}

/// The board in the pictures: a plain one by its corners, or the one that our own screen shows.
class LensBoard {
 public:
  explicit LensBoard(const LensOptions& options) {
    if (options.board.empty()) {
      own_ = boardFor(imageSize(options.screen));
      positions_mm_ = own_->cornerPositions_px();  // a lens does not know the board's size
      return;
    }
    corners_ = cornersNamed(options.board);
    for (int y = 0; y < corners_.y; ++y)
      for (int x = 0; x < corners_.x; ++x) positions_mm_.push_back(options.square_mm * glm::dvec2(x, y));
  }
  BoardDetection in(const GreyImage& image) const {
    return own_ ? findBoard(image, *own_) : findChessboard(image, corners_);
  }
  const std::vector<glm::dvec2>& positions_mm() const { return positions_mm_; }

 private:
  std::optional<ShownBoard> own_;
  glm::ivec2 corners_{0};
  std::vector<glm::dvec2> positions_mm_;
};

std::string pixels(const glm::ivec2& size_px) {
  return std::to_string(size_px.x) + " x " + std::to_string(size_px.y) + " px";
}

struct Views {
  glm::ivec2 size_px{0};
  std::vector<BoardView> usable;
  std::vector<std::string> refused;  ///< "left12.jpg: the picture is blurred …"
};

Views viewsIn(const LensOptions& options, const LensBoard& board) {
  Views views;
  for (const std::string& path : imageFilesIn(options.folder)) {
    const std::string name = std::filesystem::path(path).filename().string();
    const GreyImage image = readGreyImage(path);
    if (views.size_px == glm::ivec2(0)) views.size_px = image.size_px;
    if (image.size_px != views.size_px)
      throw CalibrationError(path + ": it is " + pixels(image.size_px) + ", those before " + pixels(views.size_px) +
                             ", give the pictures of one camera at one size");
    BoardDetection sighting = board.in(image);
    if (sighting.trouble)
      views.refused.push_back(name + ": " + sighting.line);
    else
      views.usable.push_back({name, std::move(sighting.corners_px)});
  }
  return views;
}

int lens(const LensOptions& options) {
  std::unique_ptr<calibration::OutputFile> out;
  const LensBoard board(options);
  if (!options.out.empty()) out = std::make_unique<calibration::OutputFile>(options.out, options.force);
  const Views views = viewsIn(options, board);
  // The reason for a refused image helps more than "too few".
  if (views.usable.size() < kMinViews && !views.refused.empty())
    throw CalibrationError("folder " + options.folder + ": " + std::to_string(views.usable.size()) + " of " +
                           std::to_string(views.usable.size() + views.refused.size()) +
                           " pictures can be used, at least " + std::to_string(kMinViews) + " are needed; " +
                           views.refused.front());
  const Intrinsics fitted = fitIntrinsics(views.size_px, board.positions_mm(), views.usable);
  std::fputs(lensText(fitted, views.refused).c_str(), stderr);
  if (out) {
    CameraRecord record;
    record.camera = fitted.camera;
    record.name = options.name;
    record.serial = options.serial;
    record.measured_utc = nowUtc();
    record.rms_px = fitted.rms_px;
    record.views = static_cast<int>(views.usable.size() - fitted.left_out.size());
    out->commit(cameraText(record));
  }
  if (options.json) std::fputs(lensJson(fitted, views.refused).c_str(), stdout);
  return statusOf(lensVerdict(fitted));
}

}  // namespace

void addCalibrateLens(CommandLine& calibrate) {
  auto o = std::make_shared<LensOptions>();
  CommandLine& command = calibrate.command(
      "lens", "A camera's lens from 12 to 15 pictures of a chessboard; exit 0 green (0.3 px), 1 amber (0.6 px) or red");
  command.option("PICTURES", o->folder, "Folder of PNG or JPEG").required();
  command.option("--board", o->board, "Inner corners of a plain chessboard, 9x6 [the board that our screen shows]")
      .valueNamed("CxR");
  command.option("--square-mm", o->square_mm, "Side of its squares; the lens does not depend on it")
      .from(0.1, 1000.0)
      .showsDefault();
  command.option("--screen", o->screen, "Size of the screen that shows our board").valueNamed("WxH").showsDefault();
  command.option("--out", o->out, "Camera file to write, YAML; what --lens takes").valueNamed("FILE");
  command.option("--name", o->name, "Which camera it is, for people");
  command.option("--serial", o->serial, "Its serial number");
  command.flag("--force", o->force, "Replace a file that exists");
  command.flag("--json", o->json, "The lens as JSON on standard output");
  command.does([o] { return lens(*o); });
}

}  // namespace app
