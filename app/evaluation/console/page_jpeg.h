// JPEG of a picture, by libturbojpeg. One thread an object; 3.5 ms at 960 x 540.
#pragma once

#include <memory>
#include <string_view>

#include "app/evaluation/console/page_pictures.h"

namespace app {

class PageJpeg {
 public:
  static constexpr int kQuality = 75;

  /// Throws SessionError: the library cannot be used.
  PageJpeg();
  ~PageJpeg();

  /// Valid until the next call; empty: it could not be made.
  std::string_view of(const SmallPicture& picture);

 private:
  struct Encoder;
  std::unique_ptr<Encoder> encoder_;
};

}  // namespace app
