#include "app/evaluation/seat/seat_keeper.h"

#include <signal.h>
#include <sys/mman.h>
#include <sys/wait.h>
#include <unistd.h>

#include <chrono>
#include <functional>
#include <new>
#include <thread>
#include <utility>

#include <gtest/gtest.h>

namespace app {
namespace {

/// What the processes tell the test.
struct Board {
  std::atomic<int> worker{0}, parent{0}, began_from{0}, may_keep{0}, is_over{0};
};

class SeatKeeperTest : public testing::Test {
 protected:
  SeatKeeperTest() {
    void* const page = ::mmap(nullptr, sizeof(Board), PROT_READ | PROT_WRITE, MAP_SHARED | MAP_ANONYMOUS, -1, 0);
    board_ = new (page) Board;
  }
  ~SeatKeeperTest() override {
    if (first_ <= 0) return;
    ::kill(-first_, SIGKILL);
    ::waitpid(first_, nullptr, 0);
  }

  /// A process with a state of 1 that keeps itself; then, told so, with a state of 2.
  void start(const std::function<void(Board&, SeatKeeper&)>& work) {
    first_ = ::fork();
    if (first_ != 0) return void(::setpgid(first_, first_));
    ::setpgid(0, 0);
    SeatKeeper keeper;
    work(*board_, keeper);
    ::_exit(0);
  }
  static void workOn(Board& board, SeatKeeper& keeper) {
    int state = 1;
    keeper.keep();
    board.began_from = state, board.parent = ::getppid(), board.worker = ::getpid();
    while (board.may_keep == 0 && board.is_over == 0) beatOn(keeper);
    state = 2;
    keeper.keep();
    board.began_from = state, board.parent = ::getppid(), board.worker = ::getpid();
    while (board.is_over == 0) beatOn(keeper);
  }
  static void beatOn(SeatKeeper& keeper) {
    keeper.beat();
    std::this_thread::sleep_for(std::chrono::milliseconds(2));
  }
  template <class Condition>
  static bool comesTrue(const Condition& condition) {
    for (int n = 0; n < 3000; ++n) {
      if (condition()) return true;
      std::this_thread::sleep_for(std::chrono::milliseconds(10));
    }
    return false;
  }
  /// The next worker after this one.
  bool isFollowed(int worker) const {
    return comesTrue([&] { return board_->worker != 0 && board_->worker != worker; });
  }
  int exitStatus() {
    int status = -1;
    ::waitpid(std::exchange(first_, 0), &status, 0);
    return WIFEXITED(status) ? WEXITSTATUS(status) : -1;
  }

  Board* board_;
  pid_t first_ = 0;
};

TEST_F(SeatKeeperTest, AfterADeathAnotherGoesOnFromTheKeptState) {
  start(workOn);
  ASSERT_TRUE(isFollowed(0));
  EXPECT_EQ(board_->began_from, 1);
  int worker = board_->worker;
  ::kill(worker, SIGKILL);
  ASSERT_TRUE(isFollowed(worker));
  EXPECT_EQ(board_->began_from, 1);
  worker = board_->worker;
  board_->may_keep = 1;
  ASSERT_TRUE(isFollowed(worker));
  for (int deaths = 0; deaths < 3; ++deaths) {
    worker = board_->worker;
    board_->began_from = 0;
    ::kill(worker, SIGKILL);
    ASSERT_TRUE(isFollowed(worker));
    EXPECT_EQ(board_->began_from, 2);
  }
  board_->is_over = 1;
  EXPECT_EQ(exitStatus(), 0);
}

TEST_F(SeatKeeperTest, OneThatIsStoppedIsReplaced) {
  start(workOn);
  ASSERT_TRUE(isFollowed(0));
  const int worker = board_->worker;
  ::kill(worker, SIGSTOP);
  ASSERT_TRUE(isFollowed(worker));
  board_->is_over = 1;
  EXPECT_EQ(exitStatus(), 0);
}

TEST_F(SeatKeeperTest, WhereTheKeeperDiesTooTheFirstStateIsLeft) {
  start(workOn);
  ASSERT_TRUE(isFollowed(0));
  int worker = board_->worker;
  board_->may_keep = 1;
  ASSERT_TRUE(isFollowed(worker));
  worker = board_->worker;
  const int keeper = board_->parent;
  ASSERT_NE(keeper, first_);
  ::kill(keeper, SIGKILL);
  // The work goes on without it.
  std::this_thread::sleep_for(std::chrono::milliseconds(200));
  EXPECT_EQ(board_->worker, worker);
  EXPECT_EQ(::kill(worker, 0), 0);
  board_->may_keep = 0, board_->began_from = 0;
  ::kill(worker, SIGKILL);
  ASSERT_TRUE(isFollowed(worker));
  EXPECT_EQ(board_->began_from, 1);
  board_->is_over = 1;
  EXPECT_EQ(exitStatus(), 0);
}

TEST_F(SeatKeeperTest, WhatDiesAgainAndAgainIsGivenUp) {
  start([](Board&, SeatKeeper& keeper) {
    keeper.keep();
    ::_exit(9);
  });
  EXPECT_EQ(exitStatus(), SeatKeeper::kGivenUp);
}

}  // namespace
}  // namespace app
