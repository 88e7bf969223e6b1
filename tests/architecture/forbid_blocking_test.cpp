#include "tests/architecture/forbid_blocking.h"

#include <chrono>
#include <mutex>
#include <thread>
#include <vector>

#include <gtest/gtest.h>

namespace tests {
namespace {

class ForbidBlockingTest : public testing::Test {
 protected:
  void SetUp() override {
    if (ForbidBlocking::countsNothing()) GTEST_SKIP() << "a sanitizer owns malloc: nothing can be counted";
  }
};

/// Keeps the optimizer from removing what is made only to be counted.
template <class T>
void use(const T& value) {
  asm volatile("" : : "g"(&value) : "memory");
}

TEST_F(ForbidBlockingTest, CountsAVectorThatGrows) {
  std::vector<int> numbers;
  const ForbidBlocking guard;
  numbers.push_back(1);
  use(numbers);
  EXPECT_EQ(guard.allocations(), 1u);
}

TEST_F(ForbidBlockingTest, CountsFreeingAndAlignedAllocation) {
  struct alignas(64) Wide {
    char bytes[64];
  };
  const ForbidBlocking guard;
  auto* wide = new Wide;
  use(wide);
  delete wide;
  EXPECT_EQ(guard.allocations(), 2u);
}

TEST_F(ForbidBlockingTest, CountsALockAndASleep) {
  std::mutex mutex;
  const ForbidBlocking guard;
  { const std::scoped_lock lock(mutex); }
  EXPECT_EQ(guard.blockingCalls(), 1u);
  std::this_thread::sleep_for(std::chrono::microseconds(1));
  EXPECT_EQ(guard.blockingCalls(), 2u);
}

TEST_F(ForbidBlockingTest, CountsNothingForPlainArithmetic) {
  std::vector<double> values(1000, 0.5);
  const ForbidBlocking guard;
  double sum = 0.0;
  for (double& value : values) sum += value *= 1.5;
  use(sum);
  EXPECT_EQ(guard.allocations(), 0u);
  EXPECT_EQ(guard.blockingCalls(), 0u);
}

TEST_F(ForbidBlockingTest, CountsOnlyItsOwnThreadAndScope) {
  { const ForbidBlocking earlier; }
  std::vector<int> outside(10);
  use(outside);
  std::vector<std::uint64_t> counted(1);
  std::thread other([] {
    std::vector<int> numbers(100);
    use(numbers);
  });
  const ForbidBlocking guard;
  while (counted[0] < 1000) ++counted[0];
  EXPECT_EQ(guard.allocations(), 0u);
  other.join();
}

}  // namespace
}  // namespace tests
