#include "tests/architecture/forbid_blocking.h"

#include <dlfcn.h>
#include <pthread.h>
#include <time.h>

#include <cerrno>
#include <cstddef>

#if defined(__SANITIZE_ADDRESS__) || defined(__SANITIZE_THREAD__)
#define MOLAR_SANITIZED 1
#else
#define MOLAR_SANITIZED 0
#endif

namespace {

// Plain thread-locals of the program itself: reading them allocates nothing.
thread_local int watching = 0;
thread_local std::uint64_t allocations_seen = 0, blocking_seen = 0;

[[maybe_unused]] void countAllocation() { allocations_seen += watching > 0 ? 1 : 0; }
[[maybe_unused]] void countBlocking() { blocking_seen += watching > 0 ? 1 : 0; }

}  // namespace

#if !MOLAR_SANITIZED
extern "C" {

// The C library's own, under the names it keeps for this.
void* __libc_malloc(std::size_t);
void* __libc_calloc(std::size_t, std::size_t);
void* __libc_realloc(void*, std::size_t);
void* __libc_memalign(std::size_t, std::size_t);
void __libc_free(void*);

void* malloc(std::size_t bytes) {
  countAllocation();
  return __libc_malloc(bytes);
}
void* calloc(std::size_t count, std::size_t bytes) {
  countAllocation();
  return __libc_calloc(count, bytes);
}
void* realloc(void* block, std::size_t bytes) {
  countAllocation();
  return __libc_realloc(block, bytes);
}
void* memalign(std::size_t alignment, std::size_t bytes) {
  countAllocation();
  return __libc_memalign(alignment, bytes);
}
void* aligned_alloc(std::size_t alignment, std::size_t bytes) {
  countAllocation();
  return __libc_memalign(alignment, bytes);
}
int posix_memalign(void** block, std::size_t alignment, std::size_t bytes) {
  countAllocation();
  *block = __libc_memalign(alignment, bytes);
  return *block == nullptr ? ENOMEM : 0;
}
void free(void* block) {
  if (block != nullptr) countAllocation();
  __libc_free(block);
}

// The real function behind the one of the same name here.
#define MOLAR_NEXT(name) reinterpret_cast<decltype(&name)>(::dlsym(RTLD_NEXT, #name))

int pthread_mutex_lock(pthread_mutex_t* mutex) {
  countBlocking();
  static const auto next = MOLAR_NEXT(pthread_mutex_lock);
  return next(mutex);
}
int pthread_rwlock_rdlock(pthread_rwlock_t* lock) {
  countBlocking();
  static const auto next = MOLAR_NEXT(pthread_rwlock_rdlock);
  return next(lock);
}
int pthread_rwlock_wrlock(pthread_rwlock_t* lock) {
  countBlocking();
  static const auto next = MOLAR_NEXT(pthread_rwlock_wrlock);
  return next(lock);
}
int pthread_cond_wait(pthread_cond_t* condition, pthread_mutex_t* mutex) {
  countBlocking();
  static const auto next = MOLAR_NEXT(pthread_cond_wait);
  return next(condition, mutex);
}
int nanosleep(const timespec* duration, timespec* left) {
  countBlocking();
  static const auto next = MOLAR_NEXT(nanosleep);
  return next(duration, left);
}
int clock_nanosleep(clockid_t clock, int flags, const timespec* time, timespec* left) {
  countBlocking();
  static const auto next = MOLAR_NEXT(clock_nanosleep);
  return next(clock, flags, time, left);
}

}  // extern "C"
#endif

namespace tests {

ForbidBlocking::ForbidBlocking() {
  allocations_seen = blocking_seen = 0;
  ++watching;
}
ForbidBlocking::~ForbidBlocking() { --watching; }

std::uint64_t ForbidBlocking::allocations() const { return allocations_seen; }
std::uint64_t ForbidBlocking::blockingCalls() const { return blocking_seen; }

bool ForbidBlocking::countsNothing() { return MOLAR_SANITIZED != 0; }

}  // namespace tests
