#include "render/gpu/frame_fence.h"

#include <epoxy/gl.h>

namespace render {
namespace {

constexpr GLuint64 kLongest_ns = 1'000'000'000;

GLsync syncOf(void* sync) { return static_cast<GLsync>(sync); }

}  // namespace

FrameFence::~FrameFence() {
  if (sync_ != nullptr) glDeleteSync(syncOf(sync_));
}

void FrameFence::mark() {
  if (sync_ != nullptr) glDeleteSync(syncOf(sync_));
  sync_ = glFenceSync(GL_SYNC_GPU_COMMANDS_COMPLETE, 0);
  glFlush();
}

void FrameFence::wait() {
  if (sync_ == nullptr) return;
  glClientWaitSync(syncOf(sync_), GL_SYNC_FLUSH_COMMANDS_BIT, kLongest_ns);
  glDeleteSync(syncOf(sync_));
  sync_ = nullptr;
}

bool FrameFence::isReached() const {
  if (sync_ == nullptr) return true;
  const GLenum now = glClientWaitSync(syncOf(sync_), GL_SYNC_FLUSH_COMMANDS_BIT, 0);
  return now != GL_TIMEOUT_EXPIRED;
}

void FrameFence::waitOnGpu() const {
  if (sync_ != nullptr) glWaitSync(syncOf(sync_), 0, GL_TIMEOUT_IGNORED);
}

}  // namespace render
