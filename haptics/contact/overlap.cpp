#include "haptics/contact/overlap.h"

#include <algorithm>
#include <array>
#include <bit>
#include <cmath>
#include <cstring>

#include "assets/tissue.h"
#include "haptics/bone/ball_rows.h"
#include "haptics/bone/voxel_sphere.h"

namespace haptics {
namespace {

using calibration::kPi;
static_assert(std::endian::native == std::endian::little, "the row sum reads eight voxels as one little-endian word");

/// Exact integer moments of the solid bytes wholly inside the bur.
struct WholeSum {
  std::int64_t weight = 0, x = 0, y = 0, z = 0;
  std::int64_t grey = 0;  ///< sum of w (255 - w)
};

/// Sum and index-weighted sum of a row, eight bytes at a time in four 16-bit lanes of a machine word.
class RowSum {
 public:
  explicit RowSum(std::span<const std::uint8_t> solid) : solid_(solid) {}

  void add(std::size_t start, int first, int last, int j, int k, WholeSum& sum) const {
    for (int i = first; i <= last; i += kMostVoxels) {
      const Chunk chunk = sumOf(start + static_cast<std::size_t>(i), std::min(kMostVoxels, last - i + 1));
      sum.weight += chunk.weight;
      sum.x += chunk.along + chunk.weight * i;
      sum.y += chunk.weight * j;
      sum.z += chunk.weight * k;
      sum.grey += chunk.grey;
    }
  }

 private:
  struct Chunk {
    std::int64_t weight = 0, along = 0;  ///< sum of the bytes, and of each times its place
    std::int64_t grey = 0;
  };
  static constexpr std::uint64_t kLanes = 0x00FF00FF00FF00FFu;
  static constexpr std::uint64_t kOnes = 0x0001000100010001u;
  static constexpr std::uint64_t kPlaces = 0x0000000200040006u;  // twice the lane's number, lowest lane on top
  static constexpr int kMostVoxels = 63;                         // 7 words and a rest: no lane sum reaches 2^16

  std::uint64_t word(std::size_t at) const {
    std::uint64_t bytes;
    std::memcpy(&bytes, solid_.data() + at, sizeof bytes);
    return bytes;
  }
  std::uint64_t firstBytes(std::size_t at, int count) const {
    if (at + 8 <= solid_.size()) return word(at) & ((std::uint64_t{1} << (8 * count)) - 1);
    std::uint64_t bytes = 0;
    std::memcpy(&bytes, solid_.data() + at, static_cast<std::size_t>(count));
    return bytes;
  }

  /// Sum of w (255 - w) over the bytes of a word; most words are all air and all bone.
  static std::int64_t greyOf(std::uint64_t bytes) {
    if (bytes == (bytes & 0x0101010101010101u) * 0xFF) return 0;
    std::int64_t grey = 0;
    for (; bytes != 0; bytes >>= 8) {
      const auto w = static_cast<std::int64_t>(bytes & 0xFF);
      grey += w * (255 - w);
    }
    return grey;
  }

  /// A multiplication adds the lanes, or the lanes times their places, into the top 16 bits.
  static std::int64_t laneSum(std::uint64_t lanes) { return static_cast<std::int64_t>((lanes * kOnes) >> 48); }
  static std::int64_t placeSum(std::uint64_t lanes) { return static_cast<std::int64_t>((lanes * kPlaces) >> 48); }

  Chunk sumOf(std::size_t at, int count) const {
    std::uint64_t even = 0, odd = 0, earlier = 0;
    std::int64_t grey = 0;
    const int words = count / 8;
    for (int w = 0; w < words; ++w) {
      const std::uint64_t bytes = word(at + 8 * static_cast<std::size_t>(w));
      earlier += even + odd;
      even += bytes & kLanes;
      odd += (bytes >> 8) & kLanes;
      grey += greyOf(bytes);
    }
    const std::uint64_t rest = firstBytes(at + 8 * static_cast<std::size_t>(words), count % 8);
    earlier += even + odd;
    even += rest & kLanes;
    odd += (rest >> 8) & kLanes;
    grey += greyOf(rest);
    if ((even | odd) == 0) return {};
    // A word at place w was counted (words - w) times among the earlier ones.
    const std::int64_t odds = laneSum(odd), weight = laneSum(even) + odds;
    const std::int64_t place = words * weight - laneSum(earlier);
    return {weight, 8 * place + placeSum(even) + placeSum(odd) + odds, grey};
  }

  std::span<const std::uint8_t> solid_;
};

/// Sums the lenses of the voxels cut by the bur's surface: four neighbours in a row at a time, gathered into batches
/// that the compiler turns into vector code. A voxel gathered although it lies wholly inside or outside counts right
/// too.
class ShellSum {
 public:
  ShellSum(std::span<const std::uint8_t> solid, const BallRows& ball, int row_voxels)
      : solid_(solid), ball_(ball), row_voxels_(row_voxels) {}

  /// Voxels i..i+3 of the row that starts at `start`.
  void addFour(std::size_t start, int i, const BallRow& row) {
    std::uint32_t bytes = 0;
    const std::size_t at = start + static_cast<std::size_t>(i);
    if (i + 4 <= row_voxels_)
      std::memcpy(&bytes, solid_.data() + at, 4);
    else
      std::memcpy(&bytes, solid_.data() + at, static_cast<std::size_t>(row_voxels_ - i));
    if (bytes == 0) return;
    Four& four = batch_[count_];
    four.dx = i - ball_.centre.x;
    four.dy = row.dy;
    four.dz = row.dz;
    for (int n = 0; n < 4; ++n) four.weight[n] = static_cast<double>((bytes >> (8 * n)) & 0xFF);
    if (++count_ == kBatch) sumBatch();
  }

  /// Volume, moment and greyness of everything added, in voxels and steps of 1/255 (of 1/255² for the greyness).
  void finish(double& volume, glm::dvec3& moment, double& grey) {
    // Fill up with voxels of no weight.
    while (count_ != 0) {
      batch_[count_] = {ball_.radius, 0.0, 0.0, {0.0, 0.0, 0.0, 0.0}};
      if (++count_ == kBatch) sumBatch();
    }
    volume = volume_;
    moment = moment_;
    grey = grey_;
  }

 private:
  static constexpr std::size_t kBatch = 16;
  struct Four {
    double dx, dy, dz;  ///< of the first from the centre
    double weight[4];
  };

  void sumBatch() {
    const double outer = ball_.outer, inner = ball_.inner, inner2x3 = 3.0 * inner * inner;
    const double radical = ball_.radius * ball_.radius - kVoxelSphereRadius * kVoxelSphereRadius;
    alignas(32) double volume[kBatch][4], cap[kBatch][4];
    // Lens volume and bur-side cap of each voxel sphere (reference/physics 2.3), times its solid fraction.
    for (std::size_t n = 0; n < kBatch; ++n) {
      const double across2 = batch_[n].dy * batch_[n].dy + batch_[n].dz * batch_[n].dz;
      for (int i = 0; i < 4; ++i) {
        const double dx = batch_[n].dx + i;
        const double away = std::sqrt(dx * dx + across2);
        const double least = away < inner ? inner : away;
        const double d = least > outer ? outer : least;
        const double gap = outer - d, half_inverse = 0.5 / d;
        const double height = kVoxelSphereRadius - (d * d - radical) * half_inverse;
        volume[n][i] =
            batch_[n].weight[i] * (kPi / 6.0 * half_inverse * gap * gap * (d * (d + 2.0 * outer) - inner2x3));
        cap[n][i] = batch_[n].weight[i] * (kPi / 3.0 * height * height * (3.0 * kVoxelSphereRadius - height));
      }
    }
    for (std::size_t n = 0; n < kBatch; ++n) {
      const double caps = (cap[n][0] + cap[n][1]) + (cap[n][2] + cap[n][3]);
      volume_ += (volume[n][0] + volume[n][1]) + (volume[n][2] + volume[n][3]);
      for (int i = 0; i < 4; ++i) grey_ += volume[n][i] * (255.0 - batch_[n].weight[i]);
      moment_.x += batch_[n].dx * caps + (cap[n][1] + (2.0 * cap[n][2] + 3.0 * cap[n][3]));
      moment_.y += batch_[n].dy * caps;
      moment_.z += batch_[n].dz * caps;
    }
    count_ = 0;
  }

  std::span<const std::uint8_t> solid_;
  const BallRows& ball_;
  int row_voxels_;
  std::size_t count_ = 0;
  alignas(32) std::array<Four, kBatch> batch_;
  double volume_ = 0.0, grey_ = 0.0;
  glm::dvec3 moment_{0.0};
};

SphereOverlap scaled(double volume_voxels, const glm::dvec3& moment_voxels, double grey_voxels, double spacing_mm) {
  const double s3 = spacing_mm * spacing_mm * spacing_mm;
  return {volume_voxels * s3, {moment_voxels * (s3 * spacing_mm)}, grey_voxels * s3};
}

}  // namespace

SphereOverlap sphereOverlap(const SolidField& field, const calibration::Point<calibration::Patient>& centre_P,
                            double radius_mm) noexcept {
  const BallRows ball(field.grid, centre_P, radius_mm);
  if (ball.empty()) return {};
  if (ball.radius < 2.0) return sphereOverlapVoxelByVoxel(field, centre_P, radius_mm);

  WholeSum whole;
  ShellSum shell(field.solid, ball, field.grid.size.x);
  const RowSum rows(field.solid);
  // The near shell in whole fours, the inside in words, the far shell in fours again.
  const auto add_row = [&](const BallRow& row, std::size_t start, int j, int k) {
    int i = row.outer_first;
    for (; i < row.inner_first; i += 4) shell.addFour(start, i, row);
    rows.add(start, i, row.inner_last, j, k, whole);
    for (i = std::max(i, row.inner_last + 1); i <= row.outer_last; i += 4) shell.addFour(start, i, row);
  };
  std::array<BallRow, kRowsAtOnce> row;
  for (int k = ball.first.z; k <= ball.last.z; ++k)
    for (int j = ball.first.y; j <= ball.last.y; ++j) {
      const int turn = (j - ball.first.y) % kRowsAtOnce;
      if (turn == 0) ball.rows(j, k, row);
      add_row(row[static_cast<std::size_t>(turn)], field.grid.index({0, j, k}), j, k);
    }

  double shell_volume = 0.0, shell_grey = 0.0;
  glm::dvec3 shell_moment{0.0};
  shell.finish(shell_volume, shell_moment, shell_grey);
  const auto weight = static_cast<double>(whole.weight);
  const glm::dvec3 inside{static_cast<double>(whole.x), static_cast<double>(whole.y), static_cast<double>(whole.z)};
  return scaled((weight + shell_volume) / 255.0, (inside - weight * ball.centre + shell_moment) / 255.0,
                (static_cast<double>(whole.grey) + shell_grey) / (255.0 * 255.0), field.grid.spacing_mm);
}

SphereOverlap sphereOverlapVoxelByVoxel(const SolidField& field,
                                        const calibration::Point<calibration::Patient>& centre_P, double radius_mm) {
  const BallRows ball(field.grid, centre_P, radius_mm);
  double volume = 0.0, grey = 0.0;
  glm::dvec3 moment{0.0};
  for (int k = ball.first.z; k <= ball.last.z; ++k)
    for (int j = ball.first.y; j <= ball.last.y; ++j)
      for (int i = ball.first.x; i <= ball.last.x; ++i) {
        const double solid = field.solid[field.grid.index({i, j, k})] / 255.0;
        const glm::dvec3 offset = glm::dvec3(i, j, k) - ball.centre;
        const double d = glm::length(offset);
        const Lens lens = lensOfSpheres(ball.radius, kVoxelSphereRadius, d);
        volume += solid * lens.volume;
        grey += solid * (1.0 - solid) * lens.volume;
        if (d > 0.0) moment += solid * lens.moment / d * offset;
      }
  return scaled(volume, moment, grey, field.grid.spacing_mm);
}

std::uint8_t dominantLabel(const SolidField& field, const calibration::Point<calibration::Patient>& centre_P,
                           double radius_mm) noexcept {
  const BallRows ball(field.grid, centre_P, radius_mm);
  if (ball.empty() || field.label.empty()) return 0;
  std::array<std::uint32_t, 256> weight{};
  const int stride = std::max(1, static_cast<int>(ball.radius / 6.0));
  for (int k = ball.first.z; k <= ball.last.z; k += stride)
    for (int j = ball.first.y; j <= ball.last.y; j += stride) {
      std::array<BallRow, kRowsAtOnce> rows;
      ball.rows(j, k, rows);
      const BallRow& row = rows[0];
      const std::size_t start = field.grid.index({0, j, k});
      for (int i = row.outer_first; i <= row.outer_last; i += stride) {
        const std::size_t voxel = start + static_cast<std::size_t>(i);
        weight[field.label[voxel]] += field.solid[voxel];
      }
    }
  const auto most = std::max_element(weight.begin(), weight.end());
  return *most == 0 ? std::uint8_t{0} : static_cast<std::uint8_t>(most - weight.begin());
}

}  // namespace haptics
