// Evaluator and participant at a page in a browser, served by a process beside the session (`molar page`): what they
// say becomes the course's events, and a state tells the page all there is to see. Looks on at the rehearsals for their
// picture and figures, and never waits for the page in one. Main thread; some 10 µs a frame, 0.2 ms where a state is
// due, 3 to 5 ms where a page looks at the picture and one is due.
#pragma once

#include <chrono>
#include <cstdint>
#include <deque>
#include <functional>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

#include "app/evaluation/console/page_address.h"
#include "app/evaluation/console/page_book.h"
#include "app/evaluation/console/page_link.h"
#include "app/evaluation/console/page_pictures.h"
#include "app/evaluation/console/page_state.h"
#include "app/evaluation/console/pairing.h"
#include "app/evaluation/debrief_guide.h"
#include "app/evaluation/session_book.h"
#include "app/evaluation/session_clock.h"
#include "app/evaluation/session_people.h"
#include "app/evaluation/spectator.h"

namespace app {

class EvaluationDesk;
class SeatLink;

struct ConsoleAddress {
  std::string text;  ///< "127.0.0.1:8080"
  bool is_shared = false;
};

class Console : public SessionPeople, public Spectator, public DebriefGuide {
 public:
  struct Parts {
    const StudyTemplate& study;
    EvaluationCourse& course;
    const SessionClock& clock;
    const SessionBook& book;
    const std::string& consent_text;
    std::function<bool()> is_cancelled;
    /// Of the voice: followed while no tasks are done, how it stands, what the warm-up misses of it. May be empty.
    std::function<void()> follow_voice = {};
    std::function<std::optional<VoiceState>()> voice = {};
    std::function<std::string()> voice_missing = {};
    /// Shows the recording until the guide ends it; returns why it cannot be shown, or nothing. May be empty.
    std::function<std::string(DebriefGuide&)> debrief = {};
  };
  /// Borrows all. Prints the address. Throws UsageError: it cannot be opened.
  Console(Parts parts, const ConsoleAddress& address, std::string program = "/proc/self/exe");
  ~Console() override;

  std::vector<Said> take(std::string_view during, double since_s) override;
  bool leads() const override { return false; }
  bool mayEndTasks() const override { return goes_on_; }
  /// Returns when the evaluator goes on; in a phase that a rehearsal fills, at once.
  void ask(Phase phase) override;

  void see(const Frame& frame) override;
  bool endsRehearsal() const override { return warm_up_end_ns_ && goes_on_; }

  void follow(const Shown& shown) override;
  std::vector<Steered> takeSteered() override;
  bool allowsVoice() const override { return parts_.course.allows("audio"); }
  bool isOver() const override { return goes_on_ || parts_.is_cancelled(); }

  /// Around the rehearsals.
  void beginWarmUp(double seconds);
  void beginTasks(const EvaluationDesk& desk, const SeatLink* seat);
  void endTasks();
  /// Shows how the session ended, until the evaluator leaves or nobody looks any more.
  void close(bool is_verified, std::size_t rules, std::size_t deviate);

  const PageAddress& address() const { return address_; }
  PageLink::Figures linkFigures() const { return link_->figures(); }

 private:
  void poll();
  void hear(const PageEvent& said, std::int64_t at_ns);
  void refuse(const PageEvent& said, const std::string& why);
  void settle(const PageEvent& said, const std::optional<std::string>& refused);
  void goOn(const PageEvent& said);
  void pair(const PagePairs& asked);
  void acknowledge();
  void tellLosses();
  void tell();
  PageNow now();
  std::string missing() const;
  void showPicture(const std::function<render::Image()>& made);

  Parts parts_;
  PageAddress address_;
  PicturesOut pictures_;
  Pairing pairing_;
  std::optional<PageLink> link_;
  std::string session_;
  std::int64_t began_ns_;
  PageState state_;
  PageBook known_;
  std::size_t told_events_ = 0;
  std::vector<Said> said_;  ///< during the tasks, for the desk
  bool goes_on_ = false;
  std::optional<std::int64_t> warm_up_end_ns_;
  const EvaluationDesk* desk_ = nullptr;
  const SeatLink* seat_ = nullptr;
  std::deque<PageNow::Point> points_;
  std::size_t points_told_ = 0;
  std::optional<PageNow::Servo> servo_;
  std::optional<PageNow::Closing> closing_;
  std::string recording_trouble_;
  std::optional<PageNow::Debrief> debrief_;
  std::string debrief_trouble_;
  std::vector<Steered> steered_;
  std::int64_t picture_asked_ns_ = 0;  ///< 0: none is on its way
  bool is_picture_due_ = false;        ///< of the debrief: one was drawn that no page has
  std::uint64_t serial_ = 0;
  int pages_ = 0;
  bool is_ready_ = false, is_due_ = true;  ///< the checks are there; something has changed
  std::chrono::steady_clock::time_point told_at_{}, point_at_{}, pictured_at_{}, figured_at_{};
};

}  // namespace app
