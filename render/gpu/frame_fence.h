// Keeps the graphics card at most one image behind: marked after a image was handed over, waited for before the
// hand is asked for the next. Thread: the context's. Cost: the wait itself; none where the card is ahead.
#pragma once

namespace render {

class FrameFence {
 public:
  FrameFence() = default;
  ~FrameFence();
  FrameFence(const FrameFence&) = delete;
  FrameFence& operator=(const FrameFence&) = delete;

  /// All that was asked of the graphics card so far; an older mark is forgotten.
  void mark();
  /// Until the mark is reached. At most a second: a lost context never gets there.
  void wait();
  /// Drawing asked for in the current context from now on comes after the mark, which another context may have set.
  void waitOnGpu() const;

 private:
  void* sync_ = nullptr;
};

}  // namespace render
