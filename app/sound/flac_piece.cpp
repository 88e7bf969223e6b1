#include "app/sound/flac_piece.h"

#include <sndfile.h>

#include <algorithm>
#include <cstdio>
#include <cstring>

#include "app/text/usage_error.h"

namespace app {
namespace {

/// What libsndfile takes for a file.
struct InMemory {
  std::string bytes;
  sf_count_t at = 0;

  sf_count_t size() const { return static_cast<sf_count_t>(bytes.size()); }
  static InMemory& of(void* self) { return *static_cast<InMemory*>(self); }
  static sf_count_t length(void* self) { return of(self).size(); }
  static sf_count_t tell(void* self) { return of(self).at; }
  static sf_count_t seek(sf_count_t offset, int whence, void* self) {
    InMemory& file = of(self);
    const sf_count_t from = whence == SEEK_SET ? 0 : whence == SEEK_CUR ? file.at : file.size();
    if (offset < -from) return -1;
    return file.at = from + offset;
  }
  static sf_count_t read(void* out, sf_count_t count, void* self) {
    InMemory& file = of(self);
    const sf_count_t got = std::clamp<sf_count_t>(file.size() - file.at, 0, count);
    if (got > 0) std::memcpy(out, file.bytes.data() + file.at, static_cast<std::size_t>(got));
    file.at += got;
    return got;
  }
  static sf_count_t write(const void* from, sf_count_t count, void* self) {
    InMemory& file = of(self);
    file.bytes.resize(static_cast<std::size_t>(std::max(file.size(), file.at + count)));
    std::memcpy(file.bytes.data() + file.at, from, static_cast<std::size_t>(count));
    file.at += count;
    return count;
  }
  static SF_VIRTUAL_IO* calls() {
    static SF_VIRTUAL_IO io{length, seek, read, write, tell};
    return &io;
  }
};

}  // namespace

std::string flacOf(std::span<const float> samples, int rate_Hz) {
  InMemory file;
  SF_INFO info{};
  info.samplerate = rate_Hz;
  info.channels = 1;
  info.format = SF_FORMAT_FLAC | SF_FORMAT_PCM_16;
  SNDFILE* const sound = sf_open_virtual(InMemory::calls(), SFM_WRITE, &info, &file);
  if (sound == nullptr) throw UsageError("sound: it cannot be packed, close other programs");
  sf_command(sound, SFC_SET_CLIPPING, nullptr, SF_TRUE);
  sf_write_float(sound, samples.data(), static_cast<sf_count_t>(samples.size()));
  sf_close(sound);
  return std::move(file.bytes);
}

std::optional<std::vector<float>> soundOfFlac(std::string_view flac, int rate_Hz, std::size_t most) {
  InMemory file{std::string(flac)};
  SF_INFO info{};
  SNDFILE* const sound = sf_open_virtual(InMemory::calls(), SFM_READ, &info, &file);
  if (sound == nullptr) return {};
  std::optional<std::vector<float>> samples;
  const bool is_ours = (info.format & SF_FORMAT_TYPEMASK) == SF_FORMAT_FLAC && info.channels == 1 &&
                       info.samplerate == rate_Hz && info.frames >= 0 && info.frames <= static_cast<sf_count_t>(most);
  if (is_ours) {
    samples.emplace(static_cast<std::size_t>(info.frames));
    const sf_count_t got = sf_read_float(sound, samples->data(), info.frames);
    if (got != info.frames) samples.reset();
  }
  sf_close(sound);
  return samples;
}

}  // namespace app
