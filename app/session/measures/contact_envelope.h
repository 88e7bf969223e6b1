// Force and speed of the bur in bone by its clearance to the mandibular canal, as times in classes: what experts use at
// each distance is the envelope that others are held against (reference/product 4.3: S6). Sums of several runs are
// added. N, mm/s, s. Plain values; any thread.
#pragma once

#include <array>
#include <cstddef>
#include <optional>

namespace app {

class ContactEnvelope {
 public:
  /// Nearer than 1, 2, 4 mm, and farther.
  static constexpr std::array kNearer_mm{1.0, 2.0, 4.0};
  static constexpr std::size_t kBands = kNearer_mm.size() + 1;
  static constexpr double kForceClass_N = 0.1, kSpeedClass_mm_per_s = 1.0;
  static constexpr std::size_t kClasses = 200;  ///< the last one takes all above, too
  using Histogram = std::array<double, kClasses>;
  using ByBand = std::array<Histogram, kBands>;

  static std::size_t bandOf(double clearance_mm) {
    std::size_t band = 0;
    while (band < kNearer_mm.size() && clearance_mm >= kNearer_mm[band]) ++band;
    return band;
  }

  void add(std::size_t band, double force_N, double speed_mm_per_s, double dt_s) {
    force_s[band][classOf(force_N, kForceClass_N)] += dt_s;
    speed_s[band][classOf(speed_mm_per_s, kSpeedClass_mm_per_s)] += dt_s;
  }
  void add(const ContactEnvelope& other) {
    for (std::size_t band = 0; band < kBands; ++band)
      for (std::size_t n = 0; n < kClasses; ++n) {
        force_s[band][n] += other.force_s[band][n];
        speed_s[band][n] += other.speed_s[band][n];
      }
  }
  bool isEmpty() const { return sumOf(force_s) == 0.0; }

  /// Share of the time above the 95 % of `experts` in the same band; in bands where they never were nothing is told.
  /// None: no time in a band with experts.
  static std::optional<double> shareAbove(const ByBand& own_s, const ByBand& experts_s) {
    double above = 0.0, all = 0.0;
    for (std::size_t band = 0; band < kBands; ++band) {
      const auto limit = quantile95(experts_s[band]);
      if (!limit) continue;
      for (std::size_t n = 0; n < kClasses; ++n) {
        const auto from = static_cast<double>(n);
        all += own_s[band][n];
        above += own_s[band][n] * (from >= *limit ? 1.0 : from + 1.0 <= *limit ? 0.0 : from + 1.0 - *limit);
      }
    }
    return all > 0.0 ? std::optional(above / all) : std::nullopt;
  }

  ByBand force_s{}, speed_s{};  ///< s

 private:
  static std::size_t classOf(double value, double width) {
    return value > 0.0 && value < width * static_cast<double>(kClasses) ? static_cast<std::size_t>(value / width)
           : value > 0.0                                                ? kClasses - 1
                                                                        : 0;
  }
  static double sumOf(const ByBand& by_band) {
    double sum = 0.0;
    for (const Histogram& histogram : by_band)
      for (const double s : histogram) sum += s;
    return sum;
  }
  /// In classes, evenly spread within one; none: no time.
  static std::optional<double> quantile95(const Histogram& histogram) {
    double all = 0.0, until = 0.0;
    for (const double s : histogram) all += s;
    if (!(all > 0.0)) return {};
    for (std::size_t n = 0; n < kClasses; ++n) {
      if (histogram[n] > 0.0 && until + histogram[n] >= 0.95 * all)
        return static_cast<double>(n) + (0.95 * all - until) / histogram[n];
      until += histogram[n];
    }
    return static_cast<double>(kClasses);
  }
};

}  // namespace app
