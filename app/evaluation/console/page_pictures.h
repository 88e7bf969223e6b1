// Pictures on their way from the rehearsal to the page's process: three places in shared memory, each picture over the
// oldest; none is queued. The writer never waits, and reads nothing there but whether one is wanted: a reader that dies
// or writes nonsense changes nothing. A reader copies a picture and looks whether it was written over meanwhile. RGB,
// rows top first, at most 960 x 540. One writer, one reader; 1.5 to 2.4 ms of processor to scale and write one of 1280
// x 800 to 1920 x 1080.
#pragma once

#include <cstdint>
#include <optional>
#include <vector>

#include "render/image.h"

namespace app {

inline constexpr int kPictureWidth = 960, kPictureHeight = 540;

struct SmallPicture {
  int w = 0, h = 0;
  std::uint32_t serial = 0;  ///< from 1
  std::int64_t t_ns = 0;     ///< when it was shown
  std::vector<std::uint8_t> rgb;
};

/// Each point the mean of those it covers; as large as fits, never larger than the image.
SmallPicture scaledToFit(const render::Image& image, int most_w, int most_h);

struct SharedPictures;

class PicturesOut {
 public:
  /// Throws SessionError: there is no memory.
  PicturesOut();
  ~PicturesOut();
  PicturesOut(const PicturesOut&) = delete;
  PicturesOut& operator=(const PicturesOut&) = delete;

  int memory() const { return memory_; }  ///< descriptors for the reader, closed in programs that are started
  int bell() const { return bell_; }
  /// A page has credit.
  bool isWanted() const;
  void write(const render::Image& image, std::int64_t t_ns);

 private:
  int memory_ = -1, bell_ = -1;
  SharedPictures* shared_ = nullptr;
  std::uint32_t serial_ = 0;
};

class PicturesIn {
 public:
  /// Takes the memory's descriptor over. Throws SessionError: it is no such memory.
  explicit PicturesIn(int memory);
  ~PicturesIn();
  PicturesIn(const PicturesIn&) = delete;
  PicturesIn& operator=(const PicturesIn&) = delete;

  void ask();
  /// The newest, if it is newer than this one.
  std::optional<SmallPicture> newer(std::uint32_t serial) const;

 private:
  SharedPictures* shared_ = nullptr;
};

}  // namespace app
