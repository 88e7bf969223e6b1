#include "assets/import/dicom/dicom_survey.h"

#include <algorithm>
#include <cmath>
#include <set>

#include "assets/import/dicom/frame_reader.h"
#include "assets/load_error.h"

namespace assets {
namespace {

constexpr double kCoarse_mm = 1.0, kTooCoarse_mm = 1.5;
constexpr std::size_t kFewestSlices = 60;
constexpr double kSmallestSide_mm = 25.0;
constexpr int kLargestSide_px = 8192;  // of a slice: scanners make 512 to 1024
constexpr double kSmallestSpacing_mm = 0.02, kLargestSpacing_mm = 5.0;
constexpr double kNotedTilt_deg = 0.1, kSteepestTilt_deg = 45.0;

std::string mm(double value_mm, int decimals = 2) { return shortNumber(value_mm, decimals) + " mm"; }

/// Writes the verdicts on a survey.
class Judge {
 public:
  Judge(DicomSurvey& survey, const DicomChoices& choices) : survey_(survey), choices_(choices) {}

  void run() {
    judgeDamaged();
    if (survey_.sorted.series.empty()) {
      if (!stops()) refuseNothingThere();
      return;
    }
    choose();
    judgeFiles();
    judgeUnread();
    if (std::max(series().rows, series().columns) > kLargestSide_px)
      return refuse("R3", "its slices are " + std::to_string(series().columns) + " x " + std::to_string(series().rows) +
                              " pixels; at most " + std::to_string(kLargestSide_px) + " on a side are read");
    const auto spacing_mm = pixelSpacing_mm();
    auto stack = spacing_mm ? sliceStack() : std::nullopt;
    if (!stack) return;
    judgeStack(*stack);
    judgeSize(*stack, *spacing_mm);
    if (!stops()) plan(std::move(*stack), *spacing_mm);
  }

 private:
  void say(bool is_refusal, const std::string& code, const std::string& sentence, std::vector<std::string> files = {}) {
    survey_.verdicts.push_back({code, sentence, std::move(files), is_refusal});
  }
  void note(const std::string& code, const std::string& sentence, std::vector<std::string> files = {}) {
    say(false, code, sentence, std::move(files));
  }
  void refuse(const std::string& code, const std::string& sentence, std::vector<std::string> files = {}) {
    say(true, code, sentence, std::move(files));
  }
  bool stops() const { return survey_.refusal() != nullptr; }
  const DicomSeries& series() const { return survey_.sorted.series[*survey_.taken]; }
  const DicomFile& file(std::size_t n) const { return survey_.folder.files[n]; }
  const DicomFile& fileOf(std::size_t slice) const { return file(series().slices[slice].file); }
  const DicomPlane& planeOf(std::size_t slice) const {
    return fileOf(slice).header.planes[series().slices[slice].frame];
  }
  static std::string without(const DicomFile& file) {
    const bool has_space = file.shown.find(' ') != std::string::npos;
    return "--without " + (has_space ? "'" + file.shown + "'" : file.shown);
  }

  void judgeFault(const DicomFile& file) {
    const DicomHeader& header = file.header;
    const std::string place = "scan/" + file.shown;
    const std::string advice = "; copy it from the CD again, or leave it out with " + without(file);
    if (header.fault == DicomFault::cut)
      refuse("F1",
             place + ": the file ends after " + withThousands(header.held_bytes) + " of " +
                 withThousands(header.expected_bytes) + " bytes of its image" + advice,
             {file.shown});
    else if (header.fault == DicomFault::unread_packing)
      refuse("F2",
             place + ": its pictures are packed as \"" + header.unread_name +
                 "\", which no reader here knows; export again as \"uncompressed\" or \"JPEG lossless\"",
             {file.shown});
    else if (header.fault == DicomFault::unread_pixels)
      refuse("F2",
             place +
                 ": its pixels are not one grey value of 8 or 16 bits each; export again as 16-bit grey values, or "
                 "leave it out with " +
                 without(file),
             {file.shown});
    else if (header.fault == DicomFault::damaged)
      refuse("F1", place + ": the file is damaged, its image cannot be found" + advice, {file.shown});
  }

  void judgeDamaged() {
    for (const std::size_t n : survey_.sorted.damaged) judgeFault(file(n));
  }

  void refuseNothingThere() {
    std::size_t images = 0;
    for (const DicomFile& one : survey_.folder.files) {
      images += one.header.kind == DicomKind::no_image ? 0 : 1;
      if (one.header.kind != DicomKind::no_image) judgeFault(one);
    }
    if (stops()) return;
    const DicomCounts& counts = survey_.sorted.counts;
    refuse("F3", "scan: " + counted(counts.files, "file") + ", none a " +
                     (images == 0 ? "DICOM image" : "DICOM image of a CT") +
                     "; choose the folder that holds the many equal-sized files");
  }

  std::string briefly(const DicomSeries& one) const {
    const std::string finest = one.spacing_mm ? mm(one.spacing_mm->x) : "unknown spacing";
    return finest + ", " + counted(one.slices.size(), "slice");
  }

  void choose() {
    const auto& all = survey_.sorted.series;
    if (choices_.series && (*choices_.series < 1 || *choices_.series > static_cast<int>(all.size())))
      throw LoadError("scan: it holds " + counted(all.size(), "volume") + ", so there is no --series " +
                      std::to_string(*choices_.series) + "; molar inspect lists them");
    survey_.taken = choices_.series ? static_cast<std::size_t>(*choices_.series - 1) : 0;
    constexpr std::size_t kMostListed = 6;
    if (all.size() > 1) {
      std::string list;
      for (std::size_t n = 0; n < std::min(all.size(), kMostListed); ++n)
        list += std::string(n == 0 ? "" : "; ") + std::to_string(n + 1) + ") " + briefly(all[n]);
      if (all.size() > kMostListed) list += "; …";
      note("S2", "scan holds " + std::to_string(all.size()) + " volumes: " + list +
                     "; taken: " + std::to_string(*survey_.taken + 1) + "; another with --series N");
    }
    if (series().joined > 1)
      note("S1", std::to_string(series().joined) + " series belong together and were joined (" +
                     counted(series().slices.size(), "slice") + ")");
  }

  void judgeFiles() {
    std::vector<std::string> burnt;
    const TransferSyntax* lossy = nullptr;
    std::size_t last = survey_.folder.files.size();
    for (std::size_t n = 0; n < series().slices.size(); ++n) {
      if (series().slices[n].file == last) continue;
      last = series().slices[n].file;
      const DicomHeader& header = fileOf(n).header;
      judgeFault(fileOf(n));
      if (header.syntax->is_lossy) lossy = header.syntax;
      if (header.has_burnt_in_text) burnt.push_back(fileOf(n).shown);
    }
    if (lossy != nullptr)
      note("L1", "the pictures were packed with loss (" + std::string(lossy->name) +
                     "): grey values may be off; measure nothing fine on them");
    if (!burnt.empty() && !choices_.burnt_in_checked)
      refuse("B1",
             "the files say that text is written into the pictures, which may hold names; look at them, then run "
             "again with --burnt-in-checked",
             std::move(burnt));
  }

  /// Files that are named as those of the series, but hold nothing: slices that were lost in copying.
  void judgeUnread() {
    std::set<std::string> names;
    for (const DicomSlice& slice : series().slices) names.insert(numberedName(file(slice.file).path));
    for (const DicomFile& one : survey_.folder.files)
      if (one.header.fault == DicomFault::unread && names.contains(numberedName(one.path)))
        refuse("F1",
               "scan/" + one.shown +
                   ": the file is empty or cannot be opened; copy it from the CD again, or leave it out with " +
                   without(one),
               {one.shown});
  }

  static bool isSpacing(double value_mm) { return value_mm >= kSmallestSpacing_mm && value_mm <= kLargestSpacing_mm; }

  std::optional<glm::dvec2> pixelSpacing_mm() {
    const auto& stated = series().spacing_mm;
    if (stated && choices_.spacing_mm && series().has_positions)
      throw LoadError("scan: the files state a pixel of " + mm(stated->x) +
                      " and where each slice lies; leave out --spacing, which is for files that do not");
    if (!stated && !choices_.spacing_mm) {
      refuse("P1", "the size of a pixel is nowhere in the files; ask for the export again, or give --spacing 0.3");
      return std::nullopt;
    }
    const glm::dvec2 spacing_mm = stated ? *stated : glm::dvec2(*choices_.spacing_mm);
    if (isSpacing(spacing_mm.x) && isSpacing(spacing_mm.y)) return spacing_mm;
    refuse("P1", "a pixel of " + shortNumber(spacing_mm.x, 4) + " x " + mm(spacing_mm.y, 4) +
                     " cannot be; ask for the export again");
    return std::nullopt;
  }

  /// A single slice needs no number, frames have their place in the file.
  bool isNumbered() const {
    return series().slices.size() == 1 || std::ranges::all_of(series().slices, [&](const DicomSlice& slice) {
             const DicomHeader& header = survey_.folder.files[slice.file].header;
             return header.frames > 1 || header.instance;
           });
  }

  std::optional<SliceStack> sliceStack() {
    if (series().axes && series().has_positions) {
      if (series().axes->is_mended)
        note("O1", "the directions of rows and columns are not quite at right angles; they were straightened");
      return series().stack;
    }
    const auto thickness_mm = planeOf(0).thickness_mm;
    const bool is_stated = planeOf(0).row_column.has_value();
    if (is_stated && !series().axes) {
      refuse("P2",
             "the files give the rows and columns of a slice directions that are no right angle; ask for the "
             "export again");
      return std::nullopt;
    }
    if (!is_stated && series().has_positions) {
      refuse("P2",
             "the files say where each slice lies, but not which way its rows and columns run; ask for the export "
             "again");
      return std::nullopt;
    }
    if (!isNumbered()) {
      refuse("P2", "the files do not say where each slice lies, and not all have a number; ask for the export again");
      return std::nullopt;
    }
    double step_mm = 0.0;
    if (choices_.spacing_from_thickness && thickness_mm) step_mm = *thickness_mm;
    if (choices_.assume_order && choices_.spacing_mm) step_mm = choices_.spacing_mm->z;
    if (step_mm == 0.0) {
      std::string advice =
          "ask for the export again, or run with --assume-order --spacing 0.3 to take them in the "
          "order of their numbers";
      if (thickness_mm && isSpacing(*thickness_mm))
        advice = "thickness says " + mm(*thickness_mm) + "; if slices touch, run again with --spacing-from-thickness";
      refuse("P2", "the files do not say where each slice lies; " + advice);
      return std::nullopt;
    }
    if (!isSpacing(step_mm)) {
      refuse("P2", "a step of " + mm(step_mm, 4) + " from slice to slice cannot be; give --spacing");
      return std::nullopt;
    }
    note("P2", "the files do not say where each slice lies: taken in the order of their numbers, " + mm(step_mm) +
                   " apart; upside down or mirrored is possible, check right and left");
    return assumedStack(survey_.folder, series(), step_mm);
  }

  void judgeStack(const SliceStack& stack) {
    judgeDoubles(stack);
    if (stack.tilt_deg > kSteepestTilt_deg)
      return refuse("P3", "the slices do not lie one above another; ask for the export again");
    if (stack.sideways_mm > 0.5 * series().spacing_mm.value_or(glm::dvec2(1.0)).x)
      return refuse("P3", "slices are shifted sideways against each other by up to " + mm(stack.sideways_mm) +
                              "; ask for the export again");
    if (stack.order.size() > 1 && std::min(stack.step_mm, stack.smallest_step_mm) < kSmallestSpacing_mm)
      return refuse("P3", "slices lie " + mm(stack.smallest_step_mm, 4) + " apart; ask for the export again");
    if (stack.tilt_deg > kNotedTilt_deg) {
      std::string degrees = shortNumber(stack.tilt_deg, 1);
      if (degrees.find('.') == std::string::npos) degrees += ".0";
      note("T1", "the gantry was tilted by " + degrees + " degrees; straightened by interpolation");
    }
    if (stack.largest_step_mm > kTooCoarse_mm && (stack.step_mm > kTooCoarse_mm || !stack.changes.empty())) {
      const bool is_even = stack.largest_step_mm - stack.smallest_step_mm < 0.05 * stack.largest_step_mm;
      return refuse("R1", "slices are " + (is_even ? "" : shortNumber(stack.smallest_step_mm, 1) + " to ") +
                              mm(stack.largest_step_mm, 1) + " apart; below 1 mm a third molar cannot be rehearsed");
    }
    if (stack.step_mm > kCoarse_mm)
      note("R1", "slices are " + mm(stack.step_mm) + " apart; roots and canal are drawn coarsely");
    judgeGaps(stack);
  }

  void judgeGaps(const SliceStack& stack) {
    std::size_t missing_before = 0, all_missing = 0;
    bool can_fill = true;
    for (const SliceGap& gap : stack.gaps) {
      all_missing += static_cast<std::size_t>(gap.missing_slices.value_or(0));
      can_fill = can_fill && gap.missing_slices.has_value();
    }
    const std::size_t all = stack.order.size() + all_missing;
    for (const SliceGap& gap : stack.gaps) {
      const std::size_t before = gap.before + 1 + missing_before;
      if (!gap.missing_slices) {
        refuse("G3", "after slice " + std::to_string(before) + " " + mm(gap.missing_mm, 1) +
                         " are missing, too much to bridge; copy the scan again");
        continue;
      }
      const auto count = static_cast<std::size_t>(*gap.missing_slices);
      const std::string which = count == 1
                                    ? "slice " + std::to_string(before + 1)
                                    : "slices " + std::to_string(before + 1) + " to " + std::to_string(before + count);
      const std::string what = which + " of " + std::to_string(all) + (count == 1 ? " is" : " are");
      missing_before += count;
      if (choices_.fill_gaps && can_fill)
        note("G3", what + " missing (" + mm(gap.missing_mm, 1) + ") and bridged by interpolation");
      else
        refuse("G3", what + " missing (" + mm(gap.missing_mm, 1) +
                         "); copy the scan again, or run with --fill-gaps to bridge them");
    }
    if (stack.changes.empty()) return;
    const std::size_t change = stack.changes.front();
    const double before_mm = stack.along_mm[change] - stack.along_mm[change - 1];
    const double after_mm = stack.along_mm[change + 1] - stack.along_mm[change];
    const std::size_t coarse = after_mm > before_mm ? stack.order.size() - change : change;
    const std::string part = 10 * coarse > 4 * stack.order.size() && 10 * coarse < 6 * stack.order.size()
                                 ? (after_mm > before_mm ? "the second half" : "the first half")
                                 : "the coarser part";
    if (stack.changes.size() == 1)
      note("G2", "slices lie " + mm(before_mm) + " apart, from the " + ordinal(change + 1) + " on " + mm(after_mm) +
                     "; " + part + " is interpolated and less sharp");
    else
      note("G2", "slices lie " + mm(stack.smallest_step_mm) + " to " + mm(stack.largest_step_mm) +
                     " apart; those between are interpolated and less sharp");
  }

  void judgeDoubles(const SliceStack& stack) {
    if (stack.doubles.empty()) return;
    std::size_t identical = 0, different = 0;
    std::vector<std::string> same_files, other_files;
    for (const std::vector<std::size_t>& place : stack.doubles) {
      const DicomSlice& first = series().slices[place.front()];
      const std::size_t pixels = fileOf(place.front()).header.pixelCount();
      std::vector<std::int16_t> grey(2 * pixels);
      bool is_same = true;
      for (std::size_t n = 1; n < place.size() && is_same; ++n) {
        const std::vector<std::size_t> lost = readFrames(survey_.folder, {first, series().slices[place[n]]}, grey);
        const auto half = grey.begin() + static_cast<std::ptrdiff_t>(pixels);
        is_same = lost.empty() && std::equal(grey.begin(), half, half);
      }
      is_same ? identical += place.size() - 1 : different += place.size();
      for (const std::size_t n : place) (is_same ? same_files : other_files).push_back(fileOf(n).shown);
    }
    if (identical > 0)
      note("D1",
           counted(identical, "slice") + (identical == 1 ? " is" : " are") +
               " there twice, identical; one of each was taken",
           std::move(same_files));
    if (different > 0)
      refuse("D2",
             counted(different, "slice") +
                 " lie at the same place and differ: two scans in one folder? leave files out with --without",
             std::move(other_files));
  }

  void judgeSize(const SliceStack& stack, const glm::dvec2& spacing_mm) {
    if (stack.order.size() < kFewestSlices)
      refuse("G1", "only " + counted(stack.order.size(), "slice") + "; a jaw needs at least " +
                       std::to_string(kFewestSlices));
    if (stops()) return;
    const double height_mm = stack.extent_mm() + stack.step_mm;
    const double side_mm = std::min(spacing_mm.x * series().rows, spacing_mm.y * series().columns);
    if (height_mm < kSmallestSide_mm)
      refuse("R2", "the volume is " + mm(height_mm, 0) + " high: no whole lower jaw");
    else if (side_mm < kSmallestSide_mm)
      refuse("R2", "the volume is " + mm(side_mm, 0) + " wide: no whole lower jaw");
  }

  void plan(SliceStack stack, const glm::dvec2& spacing_mm) {
    DicomPlan made;
    made.even = evenSlices(stack);
    const SliceAxes axes = series().axes.value_or(SliceAxes{});
    made.geometry.size = {series().columns, series().rows, static_cast<int>(made.even.slices.size())};
    made.geometry.step_P_mm[0] = axes.row_P * spacing_mm.y;
    made.geometry.step_P_mm[1] = axes.column_P * spacing_mm.x;
    made.geometry.step_P_mm[2] = stack.per_mm_P * made.even.step_mm;
    made.geometry.origin_P_mm = planeOf(stack.order.front()).position_P_mm.value_or(glm::dvec3(0.0));
    made.invented_slices = static_cast<std::size_t>(std::ranges::count_if(made.even.slices, &MadeSlice::isInvented));
    try {
      requireValidGeometry(made.geometry, "the volume");
    } catch (const LoadError& unfit) {
      return refuse("R3", unfit.what());
    }
    made.stack = std::move(stack);
    survey_.plan = std::move(made);
  }

  DicomSurvey& survey_;
  const DicomChoices& choices_;
};

}  // namespace

const DicomVerdict* DicomSurvey::refusal() const {
  const auto found = std::ranges::find_if(verdicts, &DicomVerdict::stops);
  return found == verdicts.end() ? nullptr : &*found;
}

namespace {

DicomSurvey surveyOf(DicomFolder folder, const DicomChoices& choices) {
  DicomSurvey survey;
  survey.folder = std::move(folder);
  survey.sorted = sortDicom(survey.folder);
  Judge(survey, choices).run();
  return survey;
}

}  // namespace

DicomSurvey surveyDicom(const std::string& source, const DicomChoices& choices) {
  return surveyOf(readDicomFolder(source, choices.without), choices);
}

DicomSurvey surveyDicom(const ReceivedFiles& files, const DicomChoices& choices) {
  return surveyOf(readDicomFolder(files, choices.without), choices);
}

}  // namespace assets
