#include "app/check_page/jaw_search.h"

#include <chrono>
#include <condition_variable>
#include <mutex>
#include <thread>
#include <utility>

#include "assets/import/found_jaw.h"
#include "assets/load_error.h"

namespace app {
namespace {

using Clock = std::chrono::steady_clock;

/// Ends work that nobody waits for.
struct Unwanted {};

}  // namespace

struct JawSearch::Work {
  mutable std::mutex guard;
  std::condition_variable changed;
  std::optional<assets::JawClicks> question;  ///< not begun
  std::optional<Answer> answer;
  std::string stage;
  Clock::time_point asked;
  std::optional<std::vector<assets::ToothClick>> halves_of;  ///< clicks of the halves that were answered last
  bool is_busy = false, is_unwanted = false, ends = false;
  std::thread thread;

  /// Nobody takes the answer.
  void dropAnswer() {
    if (answer && answer->halves) halves_of.reset();
    answer.reset();
  }

  /// A stage begins; throws where its result is not wanted.
  void begin(std::string_view name) {
    const std::lock_guard lock(guard);
    if (ends || is_unwanted) throw Unwanted{};
    stage = name;
  }

  void run(const assets::CtVolume& ct) {
    const assets::ReportStage report = [this](std::string_view name) { begin(name); };
    std::unique_ptr<assets::JawFinder> finder;
    for (;;) {
      assets::JawClicks clicks;
      bool needs_halves = true;
      {
        std::unique_lock lock(guard);
        changed.wait(lock, [this] { return ends || question; });
        if (ends) return;
        clicks = *std::exchange(question, std::nullopt);
        needs_halves = halves_of != clicks.teeth;
        is_unwanted = false;
      }
      Answer found;
      found.clicks = clicks;
      try {
        if (!finder) {
          begin("shading");
          finder = std::make_unique<assets::JawFinder>(ct.grid, assets::greyToSearch(ct), report);
        }
        found.jaw = finder->withClicks(clicks, report, [&](assets::JawSegmentation teeth) {
          Answer first;
          first.clicks = clicks;
          first.jaw = std::move(teeth);
          first.is_whole = false;
          const std::lock_guard lock(guard);
          if (ends || is_unwanted) throw Unwanted{};
          answer = std::move(first);
        });
        if (found.jaw.refusal) found.refusal = found.jaw.refusal->sentence;
        if (found.refusal.empty() && needs_halves)
          found.halves = std::array{finder->halfOf(true), finder->halfOf(false)};
      } catch (const assets::LoadError& error) {
        found.refusal = error.what();
      } catch (const Unwanted&) {
        continue;
      }
      const std::lock_guard lock(guard);
      if (is_unwanted || question) continue;
      if (found.halves) halves_of = clicks.teeth;
      answer = std::move(found);
      is_busy = false;
      changed.notify_all();
    }
  }
};

JawSearch::JawSearch(const assets::CtVolume& ct) : work_(std::make_unique<Work>()) {
  work_->thread = std::thread([work = work_.get(), &ct] { work->run(ct); });
}

JawSearch::~JawSearch() {
  {
    const std::lock_guard lock(work_->guard);
    work_->ends = true;
  }
  work_->changed.notify_all();
  work_->thread.join();
}

void JawSearch::ask(assets::JawClicks clicks) {
  {
    const std::lock_guard lock(work_->guard);
    work_->question = std::move(clicks);
    work_->dropAnswer();
    work_->stage = "waiting for the stage before";
    work_->asked = Clock::now();
    work_->is_busy = work_->is_unwanted = true;
  }
  work_->changed.notify_all();
}

void JawSearch::leaveIt() {
  const std::lock_guard lock(work_->guard);
  work_->question.reset();
  work_->dropAnswer();
  work_->is_busy = false;
  work_->is_unwanted = true;
}

bool JawSearch::isBusy() const {
  const std::lock_guard lock(work_->guard);
  return work_->is_busy;
}

std::string JawSearch::stage() const {
  const std::lock_guard lock(work_->guard);
  return work_->is_busy ? work_->stage : std::string();
}

double JawSearch::seconds() const {
  const std::lock_guard lock(work_->guard);
  return work_->is_busy ? std::chrono::duration<double>(Clock::now() - work_->asked).count() : 0.0;
}

std::optional<JawSearch::Answer> JawSearch::take() {
  const std::lock_guard lock(work_->guard);
  return std::exchange(work_->answer, std::nullopt);
}

std::optional<JawSearch::Answer> JawSearch::wait() {
  std::unique_lock lock(work_->guard);
  work_->changed.wait(lock, [this] { return !work_->is_busy; });
  return std::exchange(work_->answer, std::nullopt);
}

}  // namespace app
