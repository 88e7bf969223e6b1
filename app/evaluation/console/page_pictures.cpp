#include "app/evaluation/console/page_pictures.h"

#include <sys/eventfd.h>
#include <sys/mman.h>
#include <sys/stat.h>
#include <unistd.h>

#include <algorithm>
#include <array>
#include <atomic>
#include <cstring>
#include <new>

#include "app/session/session_error.h"

namespace app {

struct SharedPictures {
  struct Place {
    std::atomic<std::uint32_t> begun{0}, done{0};  ///< serials: alike while nobody writes
    std::int32_t w = 0, h = 0;
    std::int64_t t_ns = 0;
    std::array<std::uint8_t, std::size_t{3} * kPictureWidth * kPictureHeight> rgb;
  };
  std::atomic<std::uint32_t> newest{0}, wanted{0};
  std::array<Place, 3> places;
};

namespace {

/// In groups of a fixed size, which the compiler adds together.
void addTo(std::uint16_t* sums, const std::uint8_t* values, std::size_t count) {
  constexpr std::size_t kTogether = 32;
  std::size_t at = 0;
  for (; at + kTogether <= count; at += kTogether)
    for (std::size_t n = 0; n < kTogether; ++n)
      sums[at + n] = static_cast<std::uint16_t>(sums[at + n] + values[at + n]);
  for (; at < count; ++at) sums[at] = static_cast<std::uint16_t>(sums[at] + values[at]);
}

}  // namespace

SmallPicture scaledToFit(const render::Image& image, int most_w, int most_h) {
  SmallPicture small;
  if (image.w <= 0 || image.h <= 0) return small;
  const double shrink = std::min({1.0, static_cast<double>(most_w) / image.w, static_cast<double>(most_h) / image.h});
  small.w = std::clamp(static_cast<int>(image.w * shrink + 0.5), 1, most_w);
  small.h = std::clamp(static_cast<int>(image.h * shrink + 0.5), 1, most_h);
  small.rgb.resize(std::size_t{3} * static_cast<std::size_t>(small.w) * static_cast<std::size_t>(small.h));
  const auto edges = [](int of, int whole) {
    std::vector<int> at(static_cast<std::size_t>(of) + 1);
    for (int n = 0; n <= of; ++n) at[static_cast<std::size_t>(n)] = static_cast<int>(std::int64_t{n} * whole / of);
    return at;
  };
  const std::vector<int> columns = edges(small.w, image.w), rows = edges(small.h, image.h);
  // First the rows that a row covers, then of these sums its points: a division each would take as long as all the
  // rest.
  constexpr int kShift = 24;
  const auto width = static_cast<std::size_t>(image.w) * 4;
  std::vector<std::uint16_t> sums(width);                                                // of up to 257 rows
  std::vector<std::uint64_t> share_of(static_cast<std::size_t>(image.w / small.w + 2));  ///< by columns, in a row
  std::uint8_t* out = small.rgb.data();
  for (std::size_t y = 0; y + 1 < rows.size(); ++y) {
    std::fill(sums.begin(), sums.end(), std::uint16_t{0});
    for (int v = rows[y]; v < rows[y + 1]; ++v) {
      const std::uint8_t* const in = image.rgba.data() + width * static_cast<std::size_t>(v);
      addTo(sums.data(), in, width);
    }
    for (std::size_t n = 1; n < share_of.size(); ++n) {
      const std::uint64_t points = n * static_cast<std::uint64_t>(rows[y + 1] - rows[y]);
      share_of[n] = ((std::uint64_t{1} << kShift) + points - 1) / points;
    }
    for (std::size_t x = 0; x + 1 < columns.size(); ++x) {
      std::uint64_t red = 0, green = 0, blue = 0;
      for (int u = columns[x]; u < columns[x + 1]; ++u) {
        const std::uint16_t* const in = sums.data() + 4 * static_cast<std::size_t>(u);
        red += in[0], green += in[1], blue += in[2];
      }
      const std::uint64_t share = share_of[static_cast<std::size_t>(columns[x + 1] - columns[x])];
      *out++ = static_cast<std::uint8_t>(red * share >> kShift);
      *out++ = static_cast<std::uint8_t>(green * share >> kShift);
      *out++ = static_cast<std::uint8_t>(blue * share >> kShift);
    }
  }
  return small;
}

PicturesOut::PicturesOut() {
  memory_ = ::memfd_create("molar page pictures", MFD_CLOEXEC);
  bell_ = ::eventfd(0, EFD_CLOEXEC | EFD_NONBLOCK);
  void* at = MAP_FAILED;
  if (memory_ >= 0 && bell_ >= 0 && ::ftruncate(memory_, sizeof(SharedPictures)) == 0)
    at = ::mmap(nullptr, sizeof(SharedPictures), PROT_READ | PROT_WRITE, MAP_SHARED, memory_, 0);
  if (at == MAP_FAILED) throw SessionError("pictures for the page: there is no memory for them, close other programs");
  shared_ = new (at) SharedPictures;
}

PicturesOut::~PicturesOut() {
  ::munmap(shared_, sizeof(SharedPictures));
  ::close(memory_);
  ::close(bell_);
}

bool PicturesOut::isWanted() const { return shared_->wanted.load(std::memory_order_relaxed) != 0; }

void PicturesOut::write(const render::Image& image, std::int64_t t_ns) {
  const SmallPicture small = scaledToFit(image, kPictureWidth, kPictureHeight);
  if (small.rgb.empty()) return;
  SharedPictures::Place& place = shared_->places[++serial_ % shared_->places.size()];
  place.begun.exchange(serial_, std::memory_order_acq_rel);  // no write of the picture goes before it
  place.w = small.w, place.h = small.h, place.t_ns = t_ns;
  std::memcpy(place.rgb.data(), small.rgb.data(), small.rgb.size());
  place.done.store(serial_, std::memory_order_release);
  shared_->wanted.store(0, std::memory_order_relaxed);
  shared_->newest.store(serial_, std::memory_order_release);
  constexpr std::uint64_t kRing = 1;
  [[maybe_unused]] const ssize_t rung = ::write(bell_, &kRing, sizeof kRing);
}

PicturesIn::PicturesIn(int memory) {
  struct stat about {};
  void* at = MAP_FAILED;
  if (::fstat(memory, &about) == 0 && about.st_size == static_cast<off_t>(sizeof(SharedPictures)))
    at = ::mmap(nullptr, sizeof(SharedPictures), PROT_READ | PROT_WRITE, MAP_SHARED, memory, 0);
  ::close(memory);
  if (at == MAP_FAILED)
    throw SessionError("page: what it was given holds no pictures, it is started by molar evaluate");
  shared_ = static_cast<SharedPictures*>(at);
}

PicturesIn::~PicturesIn() { ::munmap(shared_, sizeof(SharedPictures)); }

void PicturesIn::ask() { shared_->wanted.store(1, std::memory_order_relaxed); }

std::optional<SmallPicture> PicturesIn::newer(std::uint32_t serial) const {
  const std::uint32_t newest = shared_->newest.load(std::memory_order_acquire);
  if (newest == 0 || newest == serial) return {};
  SharedPictures::Place& place = shared_->places[newest % shared_->places.size()];
  if (place.done.load(std::memory_order_acquire) != newest) return {};
  SmallPicture copy;
  copy.w = place.w, copy.h = place.h, copy.t_ns = place.t_ns, copy.serial = newest;
  if (copy.w <= 0 || copy.h <= 0 || copy.w > kPictureWidth || copy.h > kPictureHeight) return {};
  const auto size = std::size_t{3} * static_cast<std::size_t>(copy.w) * static_cast<std::size_t>(copy.h);
  copy.rgb.assign(place.rgb.begin(), place.rgb.begin() + static_cast<std::ptrdiff_t>(size));
  if (place.begun.fetch_add(0, std::memory_order_acq_rel) != newest) return {};  // no read of it comes after
  return copy;
}

}  // namespace app
