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

SmallPicture scaledToFit(const render::Image& image, int most_w, int most_h) {
  SmallPicture small;
  if (image.w <= 0 || image.h <= 0) return small;
  const double shrink = std::min({1.0, static_cast<double>(most_w) / image.w, static_cast<double>(most_h) / image.h});
  small.w = std::clamp(static_cast<int>(image.w * shrink + 0.5), 1, most_w);
  small.h = std::clamp(static_cast<int>(image.h * shrink + 0.5), 1, most_h);
  small.rgb.resize(std::size_t{3} * static_cast<std::size_t>(small.w) * static_cast<std::size_t>(small.h));
  const auto edge = [](int at, int of, int whole) { return static_cast<int>(std::int64_t{at} * whole / of); };
  std::uint8_t* out = small.rgb.data();
  for (int y = 0; y < small.h; ++y) {
    const int top = edge(y, small.h, image.h), bottom = std::max(top + 1, edge(y + 1, small.h, image.h));
    for (int x = 0; x < small.w; ++x) {
      const int left = edge(x, small.w, image.w), right = std::max(left + 1, edge(x + 1, small.w, image.w));
      std::uint32_t red = 0, green = 0, blue = 0;
      for (int v = top; v < bottom; ++v) {
        const std::uint8_t* in =
            image.rgba.data() + std::size_t{4} * (static_cast<std::size_t>(v) * static_cast<std::size_t>(image.w) +
                                                  static_cast<std::size_t>(left));
        for (int u = left; u < right; ++u, in += 4) red += in[0], green += in[1], blue += in[2];
      }
      const auto points = static_cast<std::uint32_t>((right - left) * (bottom - top));
      *out++ = static_cast<std::uint8_t>(red / points);
      *out++ = static_cast<std::uint8_t>(green / points);
      *out++ = static_cast<std::uint8_t>(blue / points);
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
  place.begun.store(serial_);
  std::atomic_thread_fence(std::memory_order_seq_cst);
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
  const SharedPictures::Place& place = shared_->places[newest % shared_->places.size()];
  if (place.done.load(std::memory_order_acquire) != newest) return {};
  SmallPicture copy;
  copy.w = place.w, copy.h = place.h, copy.t_ns = place.t_ns, copy.serial = newest;
  if (copy.w <= 0 || copy.h <= 0 || copy.w > kPictureWidth || copy.h > kPictureHeight) return {};
  const auto size = std::size_t{3} * static_cast<std::size_t>(copy.w) * static_cast<std::size_t>(copy.h);
  copy.rgb.assign(place.rgb.begin(), place.rgb.begin() + static_cast<std::ptrdiff_t>(size));
  std::atomic_thread_fence(std::memory_order_acquire);
  if (place.begun.load(std::memory_order_relaxed) != newest) return {};
  return copy;
}

}  // namespace app
