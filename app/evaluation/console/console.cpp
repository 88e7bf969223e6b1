#include "app/evaluation/console/console.h"

#include <algorithm>
#include <thread>
#include <utility>

#include <glm/glm.hpp>

#include "app/evaluation/evaluation_desk.h"
#include "app/evaluation/seat/seat_link.h"
#include "app/text/message.h"

namespace app {
namespace {

using ConsoleTime = std::chrono::steady_clock;

constexpr std::chrono::milliseconds kBetweenStates{200}, kBetweenIdleStates{1000}, kBetweenPoints{66},
    kBetweenPictures{66}, kBetweenFigures{500}, kAsking{10};
constexpr std::size_t kMostPoints = 900;  ///< of a minute
constexpr std::int64_t kSecondOf_ns = 1'000'000'000;
/// A note may come late, as of a page that was cut off.
constexpr std::int64_t kLatest_ns = 600 * kSecondOf_ns;

PageLink::Parts linkParts(const PageAddress& address, const PicturesOut& pictures, const Pairing& pairing,
                          std::string program) {
  PageLink::Parts parts;
  parts.listener = address.descriptor(), parts.pictures = pictures.memory(), parts.bell = pictures.bell();
  parts.options = pairing.options();
  parts.handed = pairing.descriptors();
  parts.greeting = pairing.greeting();
  parts.program = std::move(program);
  return parts;
}

}  // namespace

Console::Console(Parts parts, const ConsoleAddress& address, std::string program)
    : parts_(std::move(parts)),
      address_(address.text, address.is_shared),
      pairing_(address.is_shared),
      session_(randomWord()),
      began_ns_(parts_.clock.now_ns()),
      state_(parts_.study, parts_.course, parts_.consent_text, began_ns_) {
  link_.emplace(linkParts(address_, pictures_, pairing_, std::move(program)));
  printMessage("page for the evaluator: " + std::string(address.is_shared ? "https" : "http") + "://" +
               address_.text() + "/ and for the participant: /participant");
  if (address.is_shared)
    printMessage("code for the page: " + pairing_.digits() + "; its certificate: SHA-256 " + pairing_.fingerprint());
  tell();
}

/// What was said last is answered as well.
Console::~Console() {
  constexpr int kTries = 50;
  for (int n = 0; n < kTries && known_.waits(); ++n) {
    acknowledge();
    std::this_thread::sleep_for(kAsking);
  }
}

std::string Console::missing() const {
  const EvaluationCourse& course = parts_.course;
  switch (course.phase()) {
    case Phase::prepare:
      return is_ready_ ? "" : "the case is being prepared";
    case Phase::consent:
      return course.isConsentComplete() ? "" : "each stream needs a yes or no";
    case Phase::warm_up:
      if (!warm_up_end_ns_ || parts_.clock.now_ns() < *warm_up_end_ns_) return "the warm-up's time is not over";
      return parts_.voice_missing ? parts_.voice_missing() : "";
    case Phase::tasks:
      return course.areTasksDone() ? "" : "not all tasks are done";
    case Phase::questionnaires:
      for (const AskedQuestionnaire* one : parts_.study.questionnairesFor(course.participant().group))
        if (!one->questionnaire.isOfWords() && !course.isLocked(one->questionnaire.id))
          return one->questionnaire.title + " is not submitted yet";
      return "";
    default:
      return "";
  }
}

void Console::goOn(const PageEvent& said) {
  std::string why = missing();
  if (said.event.source != "evaluator") why = "the evaluator goes on";
  if (!why.empty()) return refuse(said, why);
  if (goes_on_) return refuse(said, "it goes on already");
  goes_on_ = true;
  // Nothing follows on the log's end.
  if (closing_) return settle(said, {});
  parts_.course.log({parts_.clock.now_ns(), {}}, "evaluator", "continue",
                    {{"from", std::string(kPhases[static_cast<std::size_t>(parts_.course.phase())])}});
  settle(said, {});
}

void Console::refuse(const PageEvent& said, const std::string& why) {
  known_.refuse(said.page, said.number, why);
  link_->answer(refusedWith(said.page, said.number, why));
}

void Console::settle(const PageEvent& said, const std::optional<std::string>& refused) {
  is_due_ = true;
  if (refused) return refuse(said, *refused);
  known_.accept(said.page, said.number, parts_.book.events().size());
}

void Console::hear(const PageEvent& said, std::int64_t at_ns) {
  switch (known_.known(said.page, said.number)) {
    case PageBook::Known::safe:
      return link_->answer(acknowledged(said.page, said.number));
    case PageBook::Known::refused:
      return link_->answer(refusedWith(said.page, said.number, known_.why(said.page, said.number)));
    case PageBook::Known::waiting:
      return;
    case PageBook::Known::too_many:
      return link_->answer(refusedWith(said.page, said.number, "too much was said in this session"));
    case PageBook::Known::no:
      break;
  }
  if (!said.session.empty() && said.session != session_) return refuse(said, "it is of another session");
  LogEvent event = said.event;
  if (event.t_ns < at_ns - kLatest_ns) return refuse(said, "it is older than ten minutes, write it again");
  event.t_ns = std::clamp(event.t_ns, began_ns_, at_ns);
  if (event.type == "continue") return goOn(said);
  if (closing_) return refuse(said, "the session is closed");
  if (event.source == "participant" && event.type != "consent" && event.type != "answer" && event.type != "submit")
    return refuse(said, "that is the evaluator's to say");
  // What is said of a moment that is looked at has its place in the recording.
  if (debrief_ && debrief_->prepared_share >= 1.0 &&
      (event.type == "note" || event.type == "bookmark" || event.type == "problem"))
    event.data.emplace_back("moment_s", debrief_->t_s);
  event.data.emplace_back("rtt_ms", said.round_trip_ms);
  const std::string type = event.type;
  if (desk_ != nullptr) {
    known_.begin(said.page, said.number);
    said_.push_back({std::move(event), "", [this, said](const auto& refused) { settle(said, refused); }});
    return;
  }
  const auto refused = parts_.course.take(std::move(event));
  if (refused) parts_.course.log({parts_.clock.now_ns(), {}}, "system", "refused", {{"what", type}, {"why", *refused}});
  settle(said, refused);
}

void Console::pair(const PagePairs& asked) {
  link_->answer(pairing_.answerTo(asked));
  link_->greet(pairing_.greeting());
}

void Console::acknowledge() {
  for (const auto& [page, number] : known_.takeSafe([this](std::size_t n) { return parts_.book.isSafe(n); }))
    link_->answer(acknowledged(page, number));
}

void Console::tellLosses() {
  for (const std::string& why : link_->takeLosses()) {
    printMessage("the page's process was lost (" + why + "), another serves it");
    if (!closing_) parts_.course.log({parts_.clock.now_ns(), {}}, "system", "page.lost", {{"why", why}});
  }
}

void Console::poll() {
  if (desk_ == nullptr && parts_.follow_voice) parts_.follow_voice();
  for (const PageLink::Heard& heard : link_->take()) {
    if (const auto* said = std::get_if<PageEvent>(&heard.word)) hear(*said, heard.at_ns);
    if (const auto* asked = std::get_if<PagePairs>(&heard.word)) pair(*asked);
    if (const auto* steered = std::get_if<PageSteers>(&heard.word); steered != nullptr && debrief_)
      steered_.push_back(*steered);
    if (const auto* lives = std::get_if<PageLives>(&heard.word)) {
      is_due_ = is_due_ || lives->pages != pages_;
      pages_ = lives->pages;
    }
    // A new process knows nothing of the last minute.
    if (std::holds_alternative<PageServes>(heard.word)) is_due_ = true, points_told_ = 0;
  }
  tellLosses();
  acknowledge();
  const auto now = ConsoleTime::now();
  const auto since = now - told_at_;
  const bool is_news = is_due_ || told_events_ != parts_.book.events().size();
  if (since < kBetweenStates || !link_->isStateSent()) return;
  if (is_news || pages_ > 0 || since > kBetweenIdleStates) tell();
}

void Console::tell() {
  const std::vector<LogEvent>& events = parts_.book.events();
  for (; told_events_ < events.size(); ++told_events_) state_.add(events[told_events_]);
  link_->tellState(state_.text(now()));
  told_at_ = ConsoleTime::now();
  is_due_ = false;
}

PageNow Console::now() {
  PageNow now;
  now.serial = ++serial_;
  now.session = session_;
  now.now_ns = parts_.clock.now_ns(), now.began_ns = began_ns_;
  now.hold = missing();
  now.may_continue = now.hold.empty();
  if (warm_up_end_ns_)
    now.warm_up_left_s =
        std::max(0.0, static_cast<double>(*warm_up_end_ns_ - now.now_ns) / static_cast<double>(kSecondOf_ns));
  if (desk_ != nullptr) {
    now.task_s = desk_->task_s();
    now.measure = [this](std::string_view id) { return desk_->measure(id); };
    now.is_recording = recording_trouble_.empty();
  }
  if (!recording_trouble_.empty()) now.not_kept = "the session is not recorded any more: " + recording_trouble_;
  if (const auto trouble = parts_.book.trouble())
    now.not_kept += (now.not_kept.empty() ? "" : "; ") + std::string("notes are not kept any more: ") + *trouble;
  now.course.assign(points_.begin() + static_cast<std::ptrdiff_t>(points_told_), points_.end());
  points_told_ = points_.size();
  now.servo = servo_;
  if (seat_ != nullptr && desk_ != nullptr && desk_->now().tick) {
    const std::uint64_t made = *desk_->now().tick + 1;
    const double rate_Hz = servo_ ? servo_->rate_Hz : 1000.0;
    now.seat_lag_ms = 1000.0 * static_cast<double>(made - std::min(made, seat_->followed())) / rate_Hz;
  }
  if (parts_.voice) now.voice = parts_.voice();
  now.closing = closing_;
  now.debrief = debrief_;
  now.debrief_trouble = debrief_trouble_;
  return now;
}

std::vector<Said> Console::take(std::string_view, double) {
  poll();
  return std::exchange(said_, {});
}

void Console::ask(Phase phase) {
  goes_on_ = false;
  is_ready_ = true;
  is_due_ = true;
  if (phase == Phase::warm_up || phase == Phase::tasks) return;
  if (phase == Phase::debrief && parts_.debrief) {
    debrief_ = PageNow::Debrief{};
    tell();
    debrief_trouble_ = parts_.debrief(*this);
    debrief_.reset();
    is_due_ = true;
  }
  while (!goes_on_ && !parts_.is_cancelled()) {
    poll();
    std::this_thread::sleep_for(kAsking);
  }
  if (phase == Phase::close) {
    closing_ = PageNow::Closing{};
    tell();
  }
}

void Console::beginWarmUp(double seconds) {
  warm_up_end_ns_ = parts_.clock.now_ns() + static_cast<std::int64_t>(seconds * static_cast<double>(kSecondOf_ns));
}

void Console::beginTasks(const EvaluationDesk& desk, const SeatLink* seat) {
  warm_up_end_ns_.reset();
  desk_ = &desk, seat_ = seat;
}

void Console::endTasks() {
  // What came after the last frame has no tick.
  desk_ = nullptr, seat_ = nullptr;
  servo_.reset();
  for (Said& one : std::exchange(said_, {})) one.answered(parts_.course.take(std::move(one.event)));
}

void Console::see(const Frame& frame) {
  // Also where the servo makes no ticks.
  poll();
  const auto now = ConsoleTime::now();
  if (now - figured_at_ > kBetweenFigures) {
    figured_at_ = now;
    servo_ = PageNow::Servo{frame.rate_Hz, frame.servo().missed};
    recording_trouble_ = frame.recording_trouble().value_or("");
  }
  if (now - point_at_ >= kBetweenPoints) {
    point_at_ = now;
    const double t_s = static_cast<double>(parts_.clock.now_ns() - began_ns_) / static_cast<double>(kSecondOf_ns);
    points_.push_back({t_s, frame.clearance_mm, glm::length(frame.newest.commanded_force_P_N.xyz)});
    if (points_.size() > kMostPoints) {
      points_.pop_front();
      points_told_ -= points_told_ > 0 ? 1 : 0;
    }
  }
  if (ConsoleTime::now() - pictured_at_ >= kBetweenPictures) showPicture(frame.picture);
}

/// Only where it is allowed, and somebody looks.
void Console::showPicture(const std::function<render::Image()>& made) {
  if (!parts_.course.allows("picture") || !pictures_.isWanted()) return;
  if (picture_asked_ns_ == 0) picture_asked_ns_ = parts_.clock.now_ns();
  const render::Image picture = made();
  // On its way: the next frame has it.
  if (picture.w <= 0) return;
  pictured_at_ = ConsoleTime::now();
  is_picture_due_ = false;
  pictures_.write(picture, std::exchange(picture_asked_ns_, 0));
}

void Console::follow(const Shown& shown) {
  const bool is_moved = debrief_ && (debrief_->t_s != shown.t_s || debrief_->plays != shown.plays ||
                                     debrief_->speed != shown.speed || debrief_->values.tick != shown.values.tick);
  is_due_ = is_due_ || is_moved;
  debrief_ = PageNow::Debrief{shown.t_s,   shown.length_s, shown.tick_s, shown.prepared_share,
                              shown.speed, shown.plays,    shown.values, {}};
  debrief_->incidents.assign(shown.incidents.begin(), shown.incidents.end());
  poll();
  // One that stands still is sent again, so that it is as young as what it shows.
  constexpr std::chrono::milliseconds kBetweenSame{500};
  const auto since = ConsoleTime::now() - pictured_at_;
  is_picture_due_ = is_picture_due_ || shown.is_new_picture;
  const bool is_due = (is_picture_due_ && since >= kBetweenPictures) || since >= kBetweenSame;
  if (shown.prepared_share >= 1.0 && is_due) showPicture(shown.picture);
}

std::vector<DebriefGuide::Steered> Console::takeSteered() { return std::exchange(steered_, {}); }

void Console::close(bool is_verified, std::size_t rules, std::size_t deviate) {
  closing_ = PageNow::Closing{true, is_verified, rules, deviate, parts_.book.place().folder};
  goes_on_ = false;
  is_due_ = true;
  constexpr std::chrono::seconds kNobody{3};
  auto seen_at = ConsoleTime::now();
  while (!goes_on_ && !parts_.is_cancelled() && ConsoleTime::now() - seen_at < kNobody) {
    poll();
    if (pages_ > 0) seen_at = ConsoleTime::now();
    std::this_thread::sleep_for(kAsking);
  }
}

}  // namespace app
