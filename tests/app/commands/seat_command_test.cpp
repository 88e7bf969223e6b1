// `molar seat` beside a recording that is made here, tick by tick: no clock decides anything.

#include <signal.h>

#include <algorithm>
#include <map>
#include <thread>

#include "app/evaluation/seat/follower.h"
#include "app/evaluation/seat/seat.h"
#include "app/evaluation/seat/seat_link.h"
#include "app/session/recorder.h"
#include "tests/app/commands/program.h"
#include "tests/app/session/real_session.h"

namespace app {
namespace {

constexpr std::chrono::milliseconds kLong{120'000};
const std::vector<std::string> kIds{"O1.bone", "O5.count"};

class SeatCommand : public ProgramTest {
 protected:
  void SetUp() override {
    ProgramTest::SetUp();
    recorder_.emplace(at("s.molar"), false, block_.start(), log_, DrainMode::by_hand, &feed_);
    link_.emplace(feed_, kIds, MOLAR_PROGRAM);
    link_->start(recorder_->firstFile());
    StoredStart start;
    start.dt_s = 0.001;
    start.grid = block_.grid, start.solid = block_.solid, start.label = block_.label;
    twin_.emplace(std::move(start), kIds);
    const SessionCommand first{command_, 0};
    twin_->add({&first, 1});
  }
  void TearDown() override {
    link_.reset();
    recorder_.reset();
    ProgramTest::TearDown();
  }

  /// So many ticks more, written together; what the seat says of each is what is found here.
  void goOn(int count) {
    const std::uint64_t first = next_;
    for (int n = 0; n < count; ++n, ++next_) {
      const haptics::Tick tick = servo_.step(test::sweepingHand(static_cast<double>(next_) * 0.001), command_, 0.001);
      log_.push(tick);
      ASSERT_FALSE(twin_->step(tick));
      found_.push_back(twin_->measures().values()[0]);
      if (n % 1000 == 999 || n + 1 == count) recorder_->drain();
    }
    link_->update(next_ - 1, kLong);
    for (const BoneSource::News& one : link_->takeNews()) {
      ++news_[one.type];
      for (const auto& [key, value] : one.data)
        if (key == "how") how_ = std::get<std::string>(value);
    }
    ASSERT_EQ(link_->followed(), next_);
    for (std::uint64_t tick = first; tick < next_; ++tick)
      ASSERT_EQ(link_->value("O1.bone", tick), found_[tick]) << tick;
  }
  static std::vector<pid_t> childrenOf(pid_t parent) {
    std::vector<pid_t> children;
    for (const auto& entry : std::filesystem::directory_iterator("/proc")) {
      std::ifstream stat(entry.path() / "stat");
      std::string text;
      std::getline(stat, text);
      const std::size_t name_end = text.rfind(')');
      if (name_end == std::string::npos) continue;
      std::istringstream rest(text.substr(name_end + 1));
      char state = 0;
      pid_t of = 0;
      rest >> state >> of;
      if (of == parent) children.push_back(std::stoi(entry.path().filename()));
    }
    return children;
  }
  /// Who has no child works.
  pid_t worker() const {
    pid_t one = link_->process();
    for (std::vector<pid_t> children = childrenOf(one); !children.empty(); children = childrenOf(one))
      one = children.front();
    return one;
  }

  /// Once the first process's child has kept a state and has a child of its own: before, it works and may yet fork.
  pid_t workerBesideAState() const {
    for (int n = 0; n < 6000; ++n) {
      const std::vector<pid_t> keepers = childrenOf(link_->process());
      const std::vector<pid_t> workers = keepers.empty() ? keepers : childrenOf(keepers.front());
      if (!workers.empty()) return workers.front();
      std::this_thread::sleep_for(std::chrono::milliseconds(10));
    }
    return 0;
  }

  test::BoneBlock block_;
  haptics::TickLog log_;
  InputFeed feed_;
  haptics::Bodies bodies_{block_.grid, block_.solid, block_.label};
  haptics::Servo servo_{bodies_};
  haptics::Command command_ = block_.start().command;
  std::optional<Recorder> recorder_;
  std::optional<SeatLink> link_;
  std::optional<Follower> twin_;
  std::uint64_t next_ = 0;
  std::vector<std::optional<double>> found_;
  std::map<std::string, int> news_;
  std::string how_;  ///< the newest process came back
};

TEST_F(SeatCommand, TellsWhatAServoHereFindsInEveryTick) {
  for (int part = 0; part < 5; ++part) goOn(200);
  goOn(2500);
  EXPECT_TRUE(news_.empty());
  EXPECT_GT(*found_.back(), 1.0);
  EXPECT_EQ(link_->figures().starts, 1);
  const pid_t first = link_->process();
  link_.reset();
  EXPECT_FALSE(std::filesystem::exists("/proc/" + std::to_string(first)));
}

TEST_F(SeatCommand, KilledStoppedOrBothItTellsTheSame) {
  // A state is kept on the way.
  goOn(static_cast<int>(1000.0 * kBetweenStates_s) + 500);
  const pid_t first_worker = workerBesideAState();
  ASSERT_GT(first_worker, 1) << "no state was kept within a minute";
  kill(first_worker, SIGKILL);
  goOn(300);
  EXPECT_EQ(link_->figures().taken_over, 1);
  EXPECT_EQ(link_->figures().starts, 1);
  kill(worker(), SIGSTOP);
  goOn(300);
  EXPECT_EQ(link_->figures().taken_over, 2);
  EXPECT_EQ(news_["seat.lost"], 0);
  // All of it, with the states in its memory: another begins with the one that was stored.
  kill(-link_->process(), SIGKILL);
  goOn(1200);
  EXPECT_EQ(link_->figures().starts, 2);
  EXPECT_EQ(how_, "from a stored state on");
  kill(-link_->process(), SIGSTOP);
  goOn(1200);
  EXPECT_EQ(link_->figures().starts, 3);
  EXPECT_EQ(news_["seat.lost"], 2);
  EXPECT_EQ(news_["seat.back"], 4);
  EXPECT_EQ(news_["follower.desync"], 0);
  // The recording is whole, whatever became of who followed it.
  EXPECT_TRUE(recorder_->stop(&bodies_).isWhole());
  EXPECT_TRUE(verify(at("s.molar")).verified());
}

TEST_F(SeatCommand, RefusesWhatIsNoMeasureOfTheBone) {
  expectRefusal("seat --recording 3 --feed 4 --words 5 --measures M1.on", "M1.on: is no measure of the bone");
}

}  // namespace
}  // namespace app
