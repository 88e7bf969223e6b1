// Limits the graphics card to one frame of latency: mark() after submitting a frame, wait() before sampling the pose
// for the next. Thread: the context's. Cost: the wait.
#pragma once

namespace render {

class FrameFence {
 public:
  FrameFence() = default;
  ~FrameFence();
  FrameFence(const FrameFence&) = delete;
  FrameFence& operator=(const FrameFence&) = delete;

  /// Marks the commands submitted so far; replaces an older mark.
  void mark();
  /// Waits for the mark, at most a second: a lost context never reaches it.
  void wait();
  /// Whether the mark was reached, or there is none. Does not wait.
  bool isReached() const;
  /// Later commands of the current context run after the mark, which another context may have set.
  void waitOnGpu() const;

 private:
  void* sync_ = nullptr;
};

}  // namespace render
