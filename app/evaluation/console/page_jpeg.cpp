#include "app/evaluation/console/page_jpeg.h"

#include <turbojpeg.h>

#include "app/session/session_error.h"

namespace app {

struct PageJpeg::Encoder {
  tjhandle handle = tjInitCompress();
  unsigned char* bytes = nullptr;
  unsigned long size = 0;
};

PageJpeg::PageJpeg() : encoder_(std::make_unique<Encoder>()) {
  if (encoder_->handle == nullptr) throw SessionError("page: libturbojpeg cannot be used, install it again");
}

PageJpeg::~PageJpeg() {
  tjFree(encoder_->bytes);
  tjDestroy(encoder_->handle);
}

std::string_view PageJpeg::of(const SmallPicture& picture) {
  if (picture.rgb.empty()) return {};
  if (tjCompress2(encoder_->handle, picture.rgb.data(), picture.w, 0, picture.h, TJPF_RGB, &encoder_->bytes,
                  &encoder_->size, TJSAMP_420, kQuality, TJFLAG_FASTDCT) != 0)
    return {};
  return {reinterpret_cast<const char*>(encoder_->bytes), encoder_->size};
}

}  // namespace app
