#include "assets/import/grey_scale.h"

#include <algorithm>
#include <cmath>
#include <iterator>
#include <limits>
#include <utility>

namespace assets {
namespace {

constexpr int kBins = 400;
constexpr double kSmoothing_bins = 4.0, kLeastProminence = 0.15, kLeastHeight = 0.004;
constexpr double kFillShare = 0.01, kFillOverNeighbours = 10.0;
constexpr std::size_t kEvery = 27;
constexpr double kAir_hu = -1000.0, kSoft_hu = 40.0;

/// Every 27th value, sorted, without the constant fill.
struct Sample {
  std::vector<std::int16_t> values;
  std::vector<int> fill;  ///< rising

  double percentile(double share) const {
    return values[static_cast<std::size_t>(share * static_cast<double>(values.size() - 1))];
  }
  /// A fill below the tissues, else where the values begin.
  double darkest() const {
    const bool is_fill = values.empty() || (!fill.empty() && fill.front() < percentile(0.2));
    return is_fill ? fill.front() : percentile(0.005);
  }
};

Sample sampleOf(std::span<const std::int16_t> grey, std::int16_t no_value) {
  Sample sample;
  const std::size_t every = grey.size() < 100 * kEvery ? 1 : kEvery;
  constexpr int kShift = 32768;
  std::vector<std::uint32_t> count(65536);
  for (std::size_t n = 0; n < grey.size(); n += every)
    if (grey[n] != no_value) {
      ++count[static_cast<std::size_t>(grey[n] + kShift)];
      sample.values.push_back(grey[n]);
    }
  std::ranges::sort(sample.values);
  // A value that stands out of its neighbours: the fill, or where a scanner clips.
  constexpr int kNeighbours = 3;
  const double least = kFillShare * static_cast<double>(sample.values.size());
  for (int value = 0; value < static_cast<int>(count.size()); ++value) {
    if (count[static_cast<std::size_t>(value)] <= least) continue;
    double beside = 0.0;
    for (int d = -kNeighbours; d <= kNeighbours; ++d)
      if (d != 0 && value + d >= 0 && value + d < static_cast<int>(count.size()))
        beside += count[static_cast<std::size_t>(value + d)] / (2.0 * kNeighbours);
    if (count[static_cast<std::size_t>(value)] > kFillOverNeighbours * beside) sample.fill.push_back(value - kShift);
  }
  std::vector<std::int16_t> kept;
  std::ranges::copy_if(sample.values, std::back_inserter(kept),
                       [&](std::int16_t value) { return std::ranges::find(sample.fill, value) == sample.fill.end(); });
  sample.values = std::move(kept);
  return sample;
}

std::vector<double> smoothed(const std::vector<double>& counts) {
  const int reach = static_cast<int>(4.0 * kSmoothing_bins), size = static_cast<int>(counts.size());
  std::vector<double> result(counts.size());
  for (int n = 0; n < size; ++n)
    for (int d = -reach; d <= reach; ++d) {
      int from = ((n + d) % (2 * size) + 2 * size) % (2 * size);  // mirrored at the ends
      if (from >= size) from = 2 * size - 1 - from;
      result[static_cast<std::size_t>(n)] +=
          counts[static_cast<std::size_t>(from)] * std::exp(-0.5 * d * d / (kSmoothing_bins * kSmoothing_bins));
    }
  return result;
}

/// The lowest value between a peak and the nearest higher place on one side.
template <class Iterator>
double saddle(Iterator begin, Iterator end, double height) {
  double lowest = height;
  for (; begin != end && *begin <= height; ++begin) lowest = std::min(lowest, *begin);
  return lowest;
}

std::vector<GreyPeak> peaksOf(const Sample& sample) {
  const double low = sample.percentile(0.0005), high = sample.percentile(0.9995);
  if (high - low < 1.0) return {};
  // No bin narrower than a step of the values.
  const int bins = std::min(kBins, static_cast<int>(high - low) + 1);
  std::vector<double> counts(static_cast<std::size_t>(bins));
  const double width = (high - low + 1.0) / bins;
  for (const std::int16_t value : sample.values)
    if (value >= low && value <= high)
      counts[std::min<std::size_t>(counts.size() - 1, static_cast<std::size_t>((value - low) / width))] += 1.0;
  const std::vector<double> smooth = smoothed(counts);
  const double highest = *std::ranges::max_element(smooth);
  std::vector<GreyPeak> peaks;
  for (std::size_t n = 2; n + 2 < smooth.size(); ++n) {
    const double height = smooth[n];
    const bool is_top =
        std::all_of(smooth.begin() + static_cast<std::ptrdiff_t>(n) - 2,
                    smooth.begin() + static_cast<std::ptrdiff_t>(n) + 3, [&](double other) { return other <= height; });
    if (!is_top || height < kLeastHeight * highest) continue;
    const double below = saddle(smooth.rend() - static_cast<std::ptrdiff_t>(n), smooth.rend(), height);
    const double above = saddle(smooth.begin() + static_cast<std::ptrdiff_t>(n) + 1, smooth.end(), height);
    if (height - std::max(below, above) > kLeastProminence * height)
      peaks.push_back({low - 0.5 + (static_cast<double>(n) + 0.5) * width, height});
  }
  return peaks;
}

/// The highest peak from `low` to `high`.
const GreyPeak* highestPeak(const std::vector<GreyPeak>& peaks, double low, double high) {
  const GreyPeak* found = nullptr;
  for (const GreyPeak& peak : peaks)
    if (peak.grey >= low && peak.grey <= high && (found == nullptr || peak.height > found->height)) found = &peak;
  return found;
}

bool isNearAir(double grey) { return grey > -1100.0 && grey < -900.0; }

std::optional<GreyMap> hounsfield(const Sample& sample, const std::vector<GreyPeak>& peaks) {
  const GreyPeak* soft = highestPeak(peaks, -150.0, 150.0);
  const bool has_air = isNearAir(sample.darkest()) || highestPeak(peaks, -1060.0, -940.0) != nullptr;
  if (soft == nullptr || !has_air) return std::nullopt;
  const GreyPeak* between = highestPeak(peaks, -850.0, -150.0);
  if (between != nullptr && between->height >= 0.5 * soft->height) return std::nullopt;
  return GreyMap{};
}

/// Stored 1000 or 1024 higher, without an intercept.
std::optional<GreyMap> shifted(const Sample& sample, const std::vector<GreyPeak>& peaks) {
  if (sample.darkest() < -40.0 || sample.darkest() > 60.0) return std::nullopt;
  const GreyPeak* highest = highestPeak(peaks, -INFINITY, INFINITY);
  for (const double shift : {1000.0, 1024.0})
    if (const GreyPeak* soft = highestPeak(peaks, shift - 130.0, shift + 130.0))
      if (soft->height >= 0.5 * highest->height) return GreyMap{GreyScale::shifted, 1.0, -shift};
  return std::nullopt;
}

/// Through air and soft tissue. Teeth must come out denser than bone, and nothing denser than metal.
std::optional<GreyMap> throughPeaks(const Sample& sample, const std::vector<GreyPeak>& peaks) {
  if (peaks.size() < 2) return std::nullopt;
  const double air = peaks.front().grey, brightest = sample.percentile(0.9995), range = brightest - air;
  const GreyPeak* soft = highestPeak(peaks, air + 0.12 * range, air + 0.62 * range);
  if (soft == nullptr) return std::nullopt;
  GreyMap map{GreyScale::two_points, (kSoft_hu - kAir_hu) / (soft->grey - air), 0.0};
  map.offset_hu = kAir_hu - map.slope * air;
  const double brightest_hu = map.slope * brightest + map.offset_hu;
  constexpr double kLeastDense_hu = 1200.0, kMostDense_hu = 20'000.0;
  if (brightest_hu < kLeastDense_hu || brightest_hu > kMostDense_hu) return std::nullopt;
  return map;
}

}  // namespace

GreyJudgement judgeGreyScale(std::span<const std::int16_t> grey, std::int16_t no_value) {
  GreyJudgement judgement;
  const Sample sample = sampleOf(grey, no_value);
  if (sample.values.empty() && sample.fill.empty()) return judgement;
  if (!sample.values.empty()) judgement.peaks = peaksOf(sample);
  judgement.map = hounsfield(sample, judgement.peaks);
  if (!judgement.map) judgement.map = shifted(sample, judgement.peaks);
  if (!judgement.map) judgement.map = throughPeaks(sample, judgement.peaks);
  // A jaw cut out of a calibrated scan, with little soft tissue.
  if (!judgement.map &&
      (isNearAir(sample.darkest()) || (!judgement.peaks.empty() && isNearAir(judgement.peaks[0].grey))))
    judgement.map = GreyMap{};
  return judgement;
}

std::optional<GreyMap> greyMapFromTissues(const std::array<double, 3>& air_muscle_dentine) {
  constexpr std::array<double, 3> kKnown_hu = {-1000.0, 50.0, 1650.0};
  const auto& grey = air_muscle_dentine;
  if (!(grey[0] < grey[1] && grey[1] < grey[2])) return std::nullopt;
  double mean_grey = 0.0, mean_hu = 0.0;
  for (std::size_t n = 0; n < 3; ++n) mean_grey += grey[n] / 3.0, mean_hu += kKnown_hu[n] / 3.0;
  double both = 0.0, own = 0.0;
  for (std::size_t n = 0; n < 3; ++n) {
    both += (grey[n] - mean_grey) * (kKnown_hu[n] - mean_hu);
    own += (grey[n] - mean_grey) * (grey[n] - mean_grey);
  }
  GreyMap map{GreyScale::stated, both / own, 0.0};
  map.offset_hu = mean_hu - map.slope * mean_grey;
  return map;
}

void applyGreyMap(const GreyMap& map, std::int16_t no_value, std::span<std::int16_t> grey) {
  if (map.slope == 1.0 && map.offset_hu == 0.0) return;
  constexpr double kLowest = std::numeric_limits<std::int16_t>::min() + 1;
  constexpr double kHighest = std::numeric_limits<std::int16_t>::max();
  for (std::int16_t& value : grey)
    if (value != no_value)
      value =
          static_cast<std::int16_t>(std::floor(std::clamp(map.slope * value + map.offset_hu, kLowest, kHighest) + 0.5));
}

}  // namespace assets
