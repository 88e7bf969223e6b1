#include "assets/import/dicom/frame_reader.h"

#include <signal.h>
#include <sys/mman.h>
#include <sys/wait.h>
#include <tbb/blocked_range.h>
#include <tbb/parallel_for.h>
#include <time.h>
#include <unistd.h>

#include <algorithm>
#include <array>
#include <atomic>
#include <memory>
#include <optional>

#include "assets/import/dicom/picture_decoder.h"
#include "assets/import/dicom/stored_frame.h"
#include "assets/load_error.h"
#include "assets/scan/confined_child.h"

namespace assets {
namespace {

constexpr int kChildren = 2;
constexpr std::uint64_t kChild_bytes = std::uint64_t{1} << 30;  // beyond what the program has
constexpr std::uint32_t kFrame_ms = 20'000;                     // processor time; 40 ms is usual at 512 x 512

enum class FrameState : std::uint8_t { waiting, begun, done, failed };

/// The file that the last frame came from stays open.
class OpenFile {
 public:
  explicit OpenFile(const DicomFolder& folder) : folder_(folder) {}

  const DicomBytes* of(std::size_t file) {
    if (bytes_ && file_ == file) return &*bytes_;
    bytes_.reset();
    try {
      bytes_.emplace(folder_.files[file].pixels());
    } catch (const LoadError&) {
      return nullptr;
    }
    file_ = file;
    return &*bytes_;
  }

 private:
  const DicomFolder& folder_;
  std::size_t file_ = 0;
  std::optional<DicomBytes> bytes_;
};

bool readFrame(const DicomFolder& folder, const DicomSlice& slice, OpenFile& open, std::span<std::int16_t> grey) {
  const DicomHeader& header = folder.files[slice.file].header;
  const DicomBytes* bytes = header.pixelCount() == grey.size() ? open.of(slice.file) : nullptr;
  if (bytes == nullptr) return false;
  const std::string packed = frameBytesOf(*bytes, header, slice.frame);
  if (packed.empty()) return false;
  DicomPixelFormat format = header.format;
  std::vector<std::uint16_t> stored;
  const PixelPacking packing = header.syntax->packing;
  if (packing == PixelPacking::plain || packing == PixelPacking::run_length) {
    stored = storedValues(header, packed);
    if (stored.empty()) return false;
  } else {
    const auto facts = codestreamFacts(packing, packed);
    if (!facts || !facts->is_whole || facts->rows != header.rows || facts->columns != header.columns ||
        facts->components != 1 || facts->bits < 2 || facts->bits > 16)
      return false;
    stored.resize(grey.size());
    if (!decodePicture(header.syntax->uid, *facts, packed, stored)) return false;
    format = formatOf(header, packing == PixelPacking::jpeg_2000 ? std::optional(facts->is_signed) : std::nullopt,
                      facts->bits);
  }
  const DicomPlane& plane = header.planes[slice.frame];
  greyFromStored(stored, format, plane.slope, plane.intercept, grey);
  return true;
}

bool needsDecoder(const DicomFolder& folder, const DicomSlice& slice) {
  const PixelPacking packing = folder.files[slice.file].header.syntax->packing;
  return packing != PixelPacking::plain && packing != PixelPacking::run_length;
}

/// Memory that children write and the program reads.
class SharedMemory {
 public:
  explicit SharedMemory(std::size_t bytes) : bytes_(bytes) {
    at_ = ::mmap(nullptr, bytes_, PROT_READ | PROT_WRITE, MAP_SHARED | MAP_ANONYMOUS, -1, 0);
    if (at_ == MAP_FAILED) throw LoadError("scan: there is not enough memory for it; close other programs");
  }
  ~SharedMemory() { ::munmap(at_, bytes_); }
  SharedMemory(const SharedMemory&) = delete;
  SharedMemory& operator=(const SharedMemory&) = delete;

  void* at() const { return at_; }

 private:
  std::size_t bytes_;
  void* at_ = nullptr;
};

class Decoders {
 public:
  Decoders(const DicomFolder& folder, const std::vector<DicomSlice>& slices, const std::vector<std::size_t>& packed,
           std::size_t pixels)
      : folder_(folder),
        slices_(slices),
        packed_(packed),
        pixels_(pixels),
        greys_(packed.size() * pixels * sizeof(std::int16_t)),
        states_(packed.size()) {
    for (int child = 0; child < kChildren; ++child) start(child);
  }
  ~Decoders() {
    for (const pid_t child : children_) {
      if (child <= 0) continue;
      ::kill(child, SIGKILL);
      ::waitpid(child, nullptr, 0);
    }
  }
  Decoders(const Decoders&) = delete;
  Decoders& operator=(const Decoders&) = delete;

  /// Until both have ended.
  void wait(const ReportProgress& report) {
    while (std::ranges::any_of(children_, [](pid_t child) { return child > 0; })) {
      for (pid_t& child : children_)
        if (child > 0 && ::waitpid(child, nullptr, WNOHANG) == child) child = 0;
      if (report)
        report(static_cast<double>(std::count_if(
                   states(), states() + packed_.size(),
                   [](const auto& state) { return state.load(std::memory_order_acquire) >= FrameState::done; })) /
               static_cast<double>(packed_.size()));
      const timespec pause{0, 5'000'000};
      ::nanosleep(&pause, nullptr);
    }
  }

  bool isDone(std::size_t n) const { return states()[n].load(std::memory_order_acquire) == FrameState::done; }
  std::span<const std::int16_t> grey(std::size_t n) const { return {greys() + n * pixels_, pixels_}; }

 private:
  using State = std::atomic<FrameState>;
  static_assert(State::is_always_lock_free);

  State* states() const { return static_cast<State*>(states_.at()); }
  std::int16_t* greys() const { return static_cast<std::int16_t*>(greys_.at()); }

  void start(int child) {
    const pid_t process = ::fork();
    if (process == 0) run(child);
    if (process < 0) throw LoadError("scan: no process can be started to decode it; close other programs");
    children_[static_cast<std::size_t>(child)] = process;
  }

  [[noreturn]] void run(int child) const {
    confineChild(kChild_bytes);
    OpenFile open(folder_);
    for (auto n = static_cast<std::size_t>(child); n < packed_.size(); n += kChildren) {
      limitChildTime(kFrame_ms, 20 * kFrame_ms);
      states()[n].store(FrameState::begun, std::memory_order_release);
      bool is_read = false;
      try {
        is_read = readFrame(folder_, slices_[packed_[n]], open, {greys() + n * pixels_, pixels_});
      } catch (...) {
      }
      states()[n].store(is_read ? FrameState::done : FrameState::failed, std::memory_order_release);
    }
    ::_exit(0);
  }

  const DicomFolder& folder_;
  const std::vector<DicomSlice>& slices_;
  const std::vector<std::size_t>& packed_;
  std::size_t pixels_;
  DefaultChildSignal children_wait_;
  SharedMemory greys_, states_;
  std::array<pid_t, kChildren> children_{};
};

}  // namespace

std::vector<std::size_t> readFrames(const DicomFolder& folder, const std::vector<DicomSlice>& slices,
                                    std::span<std::int16_t> grey, const ReportProgress& report) {
  if (slices.empty()) return {};
  const std::size_t pixels = grey.size() / slices.size();
  std::vector<std::size_t> packed, plain;
  for (std::size_t n = 0; n < slices.size(); ++n) (needsDecoder(folder, slices[n]) ? packed : plain).push_back(n);

  const std::unique_ptr<std::atomic<bool>[]> is_lost = std::make_unique<std::atomic<bool>[]>(slices.size());
  std::atomic<std::size_t> count{0};
  // A deflated file is inflated once for each range that reads of it.
  std::size_t grain = 8;
  for (const std::size_t n : plain) {
    const DicomHeader& header = folder.files[slices[n].file].header;
    if (header.syntax->is_deflated) grain = std::max(grain, static_cast<std::size_t>(header.frames));
  }
  tbb::parallel_for(tbb::blocked_range<std::size_t>(0, plain.size(), grain), [&](const auto& range) {
    OpenFile open(folder);
    for (std::size_t n = range.begin(); n < range.end(); ++n) {
      const std::size_t slice = plain[n];
      is_lost[slice] = !readFrame(folder, slices[slice], open, grey.subspan(slice * pixels, pixels));
      if (report) report(static_cast<double>(++count) / static_cast<double>(slices.size()));
    }
  });
  if (!packed.empty()) {
    Decoders decoders(folder, slices, packed, pixels);
    decoders.wait(report);
    for (std::size_t n = 0; n < packed.size(); ++n) {
      is_lost[packed[n]] = !decoders.isDone(n);
      if (decoders.isDone(n))
        std::ranges::copy(decoders.grey(n), grey.begin() + static_cast<std::ptrdiff_t>(packed[n] * pixels));
    }
  }
  std::vector<std::size_t> lost;
  for (std::size_t n = 0; n < slices.size(); ++n)
    if (is_lost[n]) lost.push_back(n);
  return lost;
}

}  // namespace assets
