#include "app/calibrate/page_album.h"

#include <cctype>

#include "app/text/usage_error.h"
#include "calibration/output_file.h"
#include "calibration/png_file.h"

namespace app {
namespace {

/// Pages with the same text here count as the same page.
std::string kindOf(const WizardView& view) {
  std::string kind = view.title + '|' + view.sentence;
  if (view.verdict) kind += "|verdict";
  if (!view.numbers.empty()) kind += "|numbers";
  if (view.message.tone == Tone::reject) kind += "|rejected";
  if (view.capture > 0.3 && view.capture < 1.0) kind += "|held still";
  return kind;
}

/// "07-touch-the-pits.png"
std::string fileNameOf(int number, const std::string& title) {
  std::string name = (number < 10 ? "0" : "") + std::to_string(number) + '-';
  for (const char c : title) {
    const bool plain = std::isalnum(static_cast<unsigned char>(c)) != 0;
    if (plain) name += static_cast<char>(std::tolower(static_cast<unsigned char>(c)));
    if (!plain && name.back() != '-') name += '-';
  }
  while (name.back() == '-') name.pop_back();
  return name + ".png";
}

}  // namespace

PageAlbum::PageAlbum(std::filesystem::path folder) : folder_(std::move(folder)) {
  std::error_code error;
  std::filesystem::create_directories(folder_, error);
  if (error || !std::filesystem::is_directory(folder_, error))
    throw UsageError("pages " + folder_.string() + ": the folder cannot be created, choose another");
  if (!std::filesystem::is_empty(folder_, error) || error)
    throw UsageError("pages " + folder_.string() + ": the folder is not empty, choose another");
}

void PageAlbum::keep(const WizardView& view, const std::function<render::Image()>& draw) {
  if (view.title.empty() || !kept_.insert(kindOf(view)).second) return;
  const render::Image picture = draw();
  calibration::OutputFile file((folder_ / fileNameOf(++count_, view.title)).string(), false);
  calibration::writePng(file.temporaryPath(), {picture.w, picture.h}, picture.rgba);
  file.commit();
}

}  // namespace app
