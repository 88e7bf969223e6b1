#include "app/evaluation/voice/clock_map.h"

#include <algorithm>
#include <cmath>

#include "app/text/parse_number.h"

namespace app {
namespace {

constexpr double kNanosecond_Hz = 1e9, kWindow_ns = 10e9;

/// The row of a line without its end.
std::optional<ClockRow> rowFrom(std::string_view line) {
  const std::size_t one = line.find(','), two = line.find(',', one + 1);
  if (one == std::string_view::npos || two == std::string_view::npos) return {};
  const auto frame = parseNumber<std::uint64_t>(line.substr(0, one));
  const auto t_ns = parseNumber<std::int64_t>(line.substr(one + 1, two - one - 1));
  const auto gap = parseNumber<std::uint64_t>(line.substr(two + 1));
  // Three years of either keep all that follows exact.
  constexpr std::uint64_t kMost = 1ULL << 42U;
  constexpr std::int64_t kLatest_ns = 1LL << 60;
  if (!frame || !t_ns || !gap || *frame > kMost || *gap > kMost || *t_ns > kLatest_ns || *t_ns < -kLatest_ns) return {};
  return ClockRow{*frame, *t_ns, *gap};
}

}  // namespace

std::string clockLine(const ClockRow& row) {
  return std::to_string(row.frame) + ',' + std::to_string(row.t_ns) + ',' + std::to_string(row.gap_frames) + '\n';
}

std::optional<std::vector<ClockRow>> clockRowsFrom(std::string_view text) {
  if (!text.starts_with(kClockHeader)) return {};
  std::vector<ClockRow> rows;
  for (std::size_t at = kClockHeader.size(), end = 0; (end = text.find('\n', at)) != std::string_view::npos;
       at = end + 1) {
    const auto row = rowFrom(text.substr(at, end - at));
    if (!row || (!rows.empty() && row->frame < rows.back().frame)) return {};
    rows.push_back(*row);
  }
  return rows;
}

ClockMap::ClockMap(std::span<const ClockRow> rows, double rate_Hz) : frame_ns_(kNanosecond_Hz / rate_Hz) {
  if (rows.empty()) return;
  origin_ns_ = rows.front().t_ns;
  const double window = kWindow_ns / frame_ns_;
  double first_of_window = 0.0, newest = 0.0, gap_end_frame = 0.0;
  bool begins = true;
  // A window that has only begun may have seen no piece in time yet: it does not stand for itself.
  const auto end_stretch = [&] {
    constexpr double kShortest = 0.5;
    if (begins || stretches_.back().knots.size() < 2) return;
    if (newest - first_of_window < kShortest * window) stretches_.back().knots.pop_back();
  };
  for (const ClockRow& row : rows) {
    if (row.gap_frames > 0) {
      end_stretch();
      gap_end_frame = static_cast<double>(row.frame + row.gap_frames);
      begins = true;
      continue;
    }
    const auto frame = static_cast<double>(row.frame);
    const double offset_ns = static_cast<double>(row.t_ns - origin_ns_) - frame * frame_ns_;
    newest = frame;
    if (begins) {
      stretches_.push_back({stretches_.empty() ? 0.0 : gap_end_frame, {{frame, offset_ns}}});
      first_of_window = frame;
      begins = false;
    } else if (frame - first_of_window >= window) {
      stretches_.back().knots.push_back({frame, offset_ns});
      first_of_window += window * std::floor((frame - first_of_window) / window);
    } else if (Knot& knot = stretches_.back().knots.back(); offset_ns < knot.offset_ns) {
      knot = {frame, offset_ns};
    }
  }
  end_stretch();
}

double ClockMap::Stretch::offset_ns(double frame) const {
  if (knots.size() == 1) return knots.front().offset_ns;
  // Beyond the ends the first and last line go on.
  auto next = std::ranges::lower_bound(knots, frame, {}, &Knot::frame);
  next = std::clamp(next, knots.begin() + 1, knots.end() - 1);
  const Knot &one = *(next - 1), &two = *next;
  return one.offset_ns + (frame - one.frame) * (two.offset_ns - one.offset_ns) / (two.frame - one.frame);
}

const ClockMap::Stretch& ClockMap::stretchAt(double frame) const {
  const auto behind = std::ranges::upper_bound(stretches_, frame, {}, &Stretch::first_frame);
  return behind == stretches_.begin() ? stretches_.front() : *(behind - 1);
}

double ClockMap::time_ns(const Stretch& stretch, double frame) const {
  return frame * frame_ns_ + stretch.offset_ns(frame);
}

std::int64_t ClockMap::t_ns(double frame) const {
  const double since = stretches_.empty() ? frame * frame_ns_ : time_ns(stretchAt(frame), frame);
  return origin_ns_ + static_cast<std::int64_t>(std::llround(since));
}

double ClockMap::frame(std::int64_t t_ns) const {
  const auto since_ns = static_cast<double>(t_ns - origin_ns_);
  if (stretches_.empty()) return since_ns / frame_ns_;
  const Stretch* stretch = &stretches_.front();
  for (const Stretch& one : stretches_)
    if (time_ns(one, one.first_frame) <= since_ns) stretch = &one;
  // Offsets change by less than a thousandth of the time: three steps are exact to a sample in a thousand hours.
  double frame = (since_ns - stretch->knots.front().offset_ns) / frame_ns_;
  constexpr int kSteps = 3;
  for (int n = 0; n < kSteps; ++n) frame = (since_ns - stretch->offset_ns(frame)) / frame_ns_;
  return frame;
}

double ClockMap::drift_ppm() const {
  const Stretch* longest = nullptr;
  const auto length = [](const Stretch& one) { return one.knots.back().frame - one.knots.front().frame; };
  for (const Stretch& one : stretches_)
    if (longest == nullptr || length(one) > length(*longest)) longest = &one;
  if (longest == nullptr || longest->knots.size() < 2) return 0.0;
  const double from_ns = longest->knots.front().offset_ns, to_ns = longest->knots.back().offset_ns;
  constexpr double kMillion = 1e6;
  return kMillion * (to_ns - from_ns) / (length(*longest) * frame_ns_);
}

}  // namespace app
