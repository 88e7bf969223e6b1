#include "assets/import/dicom/dicom_series.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <cstdint>
#include <limits>
#include <map>
#include <numeric>
#include <tuple>

namespace assets {
namespace {

constexpr int kSmallestSide = 64;

const DicomPlane& planeOf(const DicomFolder& folder, const DicomSlice& slice) {
  return folder.files[slice.file].header.planes[slice.frame];
}

/// What the slices of one volume share; of groups that may be joined all but the series itself.
struct Likeness {
  std::uint64_t study = 0, frame_of_reference = 0;
  int rows = 0, columns = 0;
  std::array<long, 6> orientation{};  ///< in thousandths
  std::array<long, 2> spacing{};      ///< in ten thousandths of a mm
  int bits = 0;
  std::string kernel;
  bool has_position = false;

  auto operator<=>(const Likeness&) const = default;
};

Likeness likenessOf(const DicomFolder& folder, const DicomSlice& slice) {
  const DicomHeader& header = folder.files[slice.file].header;
  const DicomPlane& plane = planeOf(folder, slice);
  Likeness alike;
  alike.study = header.study_key, alike.frame_of_reference = header.frame_of_reference_key;
  alike.rows = header.rows, alike.columns = header.columns;
  if (plane.row_column)
    for (std::size_t n = 0; n < 6; ++n)
      alike.orientation[n] = std::lround(
          1.0e3 * std::clamp((*plane.row_column)[static_cast<int>(n / 3)][static_cast<int>(n % 3)], -2.0, 2.0));
  if (plane.spacing_mm)
    for (std::size_t n = 0; n < 2; ++n)
      alike.spacing[n] = std::lround(1.0e4 * std::clamp((*plane.spacing_mm)[static_cast<int>(n)], -1.0, 1.0e4));
  alike.bits = header.format.bits_stored;
  alike.kernel = header.kernel;
  alike.has_position = plane.position_P_mm.has_value();
  return alike;
}

/// Sorts a file's picture into the counts; true: it may be part of a volume.
bool isSlice(const DicomHeader& header, DicomCounts& counts) {
  if (!header.isDicom()) return ++counts.not_dicom, false;
  if (header.kind == DicomKind::no_image) return ++counts.not_images, false;
  if (header.kind == DicomKind::localizer) return ++counts.localizers, false;
  if (header.modality != "CT") return ++counts.other_modalities, false;
  if (header.kind == DicomKind::capture) return ++counts.captures, false;
  if (std::min(header.rows, header.columns) < kSmallestSide) return ++counts.small, false;
  return true;
}

void findStack(const DicomFolder& folder, DicomSeries& series) {
  const DicomPlane& first = planeOf(folder, series.slices.front());
  const DicomHeader& header = folder.files[series.slices.front().file].header;
  series.rows = header.rows, series.columns = header.columns;
  series.spacing_mm = first.spacing_mm;
  series.axes = first.row_column ? sliceAxes(*first.row_column) : std::nullopt;
  std::vector<glm::dvec3> positions_P_mm;
  for (const DicomSlice& slice : series.slices)
    if (const auto& position = planeOf(folder, slice).position_P_mm) positions_P_mm.push_back(*position);
  series.has_positions = positions_P_mm.size() == series.slices.size();
  if (series.axes && series.has_positions) series.stack = stackOf(positions_P_mm, *series.axes);
}

/// Whether the slices of `small` lie in the gaps of `large`: between its ends, and nowhere near its slices; or the two
/// alternate evenly.
bool fillsGaps(const DicomFolder& folder, const DicomSeries& large, const DicomSeries& small) {
  if (!large.axes || !large.has_positions || !small.has_positions || large.stack.order.size() < 2) return false;
  const double step_mm = large.stack.step_mm;
  const glm::dvec3 normal_P = large.axes->normal_P();
  double nearest_mm = INFINITY;
  for (const DicomSlice& slice : small.slices) {
    const double at_mm = glm::dot(*planeOf(folder, slice).position_P_mm, normal_P);
    if (at_mm < large.stack.along_mm.front() - 1.5 * step_mm || at_mm > large.stack.along_mm.back() + 1.5 * step_mm)
      return false;
    const auto above = std::ranges::lower_bound(large.stack.along_mm, at_mm);
    if (above != large.stack.along_mm.end()) nearest_mm = std::min(nearest_mm, *above - at_mm);
    if (above != large.stack.along_mm.begin()) nearest_mm = std::min(nearest_mm, at_mm - *std::prev(above));
  }
  if (nearest_mm >= 0.9 * step_mm) return true;
  DicomSeries both = large;
  both.slices.insert(both.slices.end(), small.slices.begin(), small.slices.end());
  findStack(folder, both);
  return both.stack.is_regular && both.stack.doubles.empty();
}

/// All groups as one, if that is one even row: exporters that number every slice a series of its own.
std::optional<DicomSeries> unionOf(const DicomFolder& folder, const std::vector<DicomSeries>& groups) {
  DicomSeries all;
  for (const DicomSeries& group : groups) all.slices.insert(all.slices.end(), group.slices.begin(), group.slices.end());
  findStack(folder, all);
  all.joined = groups.size();
  const bool is_even = all.stack.order.size() >= 2 && all.stack.is_regular && all.stack.doubles.empty();
  return is_even ? std::optional(std::move(all)) : std::nullopt;
}

/// Joins the groups of one likeness, large ones first.
std::vector<DicomSeries> joined(const DicomFolder& folder, std::vector<DicomSeries> groups) {
  constexpr std::size_t kMostInPairs = 50;
  if (groups.size() < 2) return groups;
  if (auto all = unionOf(folder, groups)) return {std::move(*all)};
  if (groups.size() > kMostInPairs) return groups;
  std::ranges::stable_sort(groups, std::ranges::greater(),
                           [](const DicomSeries& group) { return group.slices.size(); });
  std::vector<DicomSeries> made;
  for (DicomSeries& group : groups) {
    const auto home =
        std::ranges::find_if(made, [&](const DicomSeries& large) { return fillsGaps(folder, large, group); });
    if (home == made.end()) {
      made.push_back(std::move(group));
      continue;
    }
    home->slices.insert(home->slices.end(), group.slices.begin(), group.slices.end());
    ++home->joined;
    findStack(folder, *home);
  }
  return made;
}

/// Many slices, close together.
double worth(const DicomSeries& series) {
  const double spacing_mm = series.spacing_mm ? std::clamp(series.spacing_mm->x, 0.05, 5.0) : 1.0;
  return static_cast<double>(series.slices.size()) / spacing_mm;
}

}  // namespace

SortedDicom sortDicom(const DicomFolder& folder) {
  SortedDicom sorted;
  sorted.counts.files = folder.files.size() + folder.left_out;
  sorted.counts.left_out = folder.left_out;
  std::map<Likeness, std::map<std::uint64_t, DicomSeries>> groups;
  for (std::size_t file = 0; file < folder.files.size(); ++file) {
    const DicomHeader& header = folder.files[file].header;
    const bool is_lost = header.fault == DicomFault::damaged && (header.modality == "CT" || header.modality.empty());
    if (is_lost) {
      sorted.damaged.push_back(file);
      continue;
    }
    if (!isSlice(header, sorted.counts)) continue;
    if (header.planes.empty()) {
      sorted.damaged.push_back(file);
      continue;
    }
    for (std::size_t frame = 0; frame < header.planes.size(); ++frame)
      groups[likenessOf(folder, {file, frame})][header.series_key].slices.push_back({file, frame});
  }
  for (auto& [likeness, by_series] : groups) {
    std::vector<DicomSeries> alike;
    for (auto& [key, series] : by_series) {
      findStack(folder, series);
      alike.push_back(std::move(series));
    }
    for (DicomSeries& series : joined(folder, std::move(alike))) sorted.series.push_back(std::move(series));
  }
  std::ranges::stable_sort(sorted.series, std::ranges::greater(), worth);
  return sorted;
}

SliceStack assumedStack(const DicomFolder& folder, const DicomSeries& series, double step_mm) {
  const SliceAxes axes = series.axes.value_or(SliceAxes{});
  // A frame's number is its place in the file.
  const auto number = [&](const DicomSlice& slice) {
    const DicomHeader& header = folder.files[slice.file].header;
    return header.frames > 1 ? static_cast<std::int64_t>(slice.frame) : std::int64_t{header.instance.value_or(0)};
  };
  std::int64_t least = std::numeric_limits<std::int64_t>::max(), apart = 0;
  for (const DicomSlice& slice : series.slices) least = std::min(least, number(slice));
  for (const DicomSlice& slice : series.slices) apart = std::gcd(apart, number(slice) - least);
  std::vector<glm::dvec3> positions_P_mm;
  for (const DicomSlice& slice : series.slices) {
    const auto steps = static_cast<double>((number(slice) - least) / std::max<std::int64_t>(apart, 1));
    positions_P_mm.push_back(steps * step_mm * axes.normal_P());
  }
  return stackOf(positions_P_mm, axes);
}

}  // namespace assets
