#include "app/evaluation/console/page_hub.h"

#include <algorithm>
#include <array>
#include <utility>

#include <nlohmann/json.hpp>

#include "app/evaluation/console/page_words.h"
#include "assets/json_depth.h"

namespace app {
namespace {

using HubJson = nlohmann::json;

constexpr std::int64_t kHubSecond_ns = 1'000'000'000;
constexpr double kKept_s = 60.0;  ///< of the course
constexpr std::size_t kMostUpTexts = 1000;

std::string dumped(const HubJson& value) { return value.dump(-1, ' ', false, HubJson::error_handler_t::replace); }

std::string textIn(const HubJson& from, const char* key) {
  const auto found = from.find(key);
  return found != from.end() && found->is_string() ? found->get<std::string>() : "";
}

HubJson parsed(std::string_view text) {
  if (assets::isNestedTooDeep(text)) return HubJson(HubJson::value_t::discarded);
  return HubJson::parse(text.begin(), text.end(), nullptr, false);
}

}  // namespace

struct PageHub::Client {
  Role role = Role::evaluator;
  std::string page;
  std::deque<std::string> replies;
  std::uint64_t seen = 0;  ///< the state that it got last
  double course_until_s = -1.0;
  std::uint32_t pictured = 0, drawn = 0;
  int undrawn = 0, nonsense = 0, messages = 0;
  std::int64_t counted_ns = 0;
};

struct PageHub::State {
  std::uint64_t number = 0;
  HubJson json;
  std::deque<HubJson> course;
};

PageHub::PageHub() : state_(std::make_unique<State>()) {}
PageHub::~PageHub() = default;

int PageHub::join(Role role, const std::string& page, std::int64_t now_ns) {
  const int made = next_++;
  bool was_writer = false;
  for (auto& [number, other] : clients_)
    if (!page.empty() && other.page == page && other.role == role) {
      unwelcome_.push_back(number);
      was_writer = was_writer || number == writer_;
    }
  Client& client = clients_[made];
  client.role = role;
  client.page = page;
  if (role == Role::evaluator && (writer_ == 0 || was_writer)) write(made, now_ns);
  return made;
}

void PageHub::leave(int client) {
  clients_.erase(client);
  if (client != writer_) return;
  writer_ = 0;
  for (const auto& [number, other] : clients_)
    if (other.role == Role::evaluator) return write(number, 0);
}

void PageHub::write(int client, std::int64_t now_ns) {
  writer_ = client;
  if (now_ns > 0) writer_since_ns_ = now_ns;
  // All see who writes.
  ++state_->number;
}

std::vector<int> PageHub::takeUnwelcome() { return std::exchange(unwelcome_, {}); }

int PageHub::pages() const { return static_cast<int>(clients_.size()); }

void PageHub::reply(Client& client, std::string text) {
  // Whoever takes nothing gets no more of it; what is not acknowledged is said again.
  if (client.replies.size() < kMostReplies) client.replies.push_back(std::move(text));
}

bool PageHub::hear(int number, std::string_view text, std::int64_t now_ns) {
  const auto found = clients_.find(number);
  if (found == clients_.end()) return false;
  Client& client = found->second;
  if (now_ns - client.counted_ns > kHubSecond_ns) client.counted_ns = now_ns, client.messages = 0;
  if (++client.messages > kMostPerSecond) return false;
  const HubJson said = text.size() <= kMostUp ? parsed(text) : HubJson();
  const std::string kind = said.is_object() ? textIn(said, "kind") : "";
  if (kind == "ping" && said.contains("t0") && said["t0"].is_number()) {
    reply(client, dumped({{"kind", "pong"}, {"t0", said["t0"]}, {"t1", now_ns}}));
  } else if (kind == "drawn" && said.contains("picture") && said["picture"].is_number_unsigned()) {
    const auto drawn = said["picture"].get<std::uint64_t>();
    if (client.undrawn > 0 && drawn > client.drawn && drawn <= client.pictured) {
      client.drawn = static_cast<std::uint32_t>(drawn);
      // The newest was drawn: none before it will be.
      client.undrawn = drawn == client.pictured ? 0 : client.undrawn - 1;
    }
  } else if (kind == "take-over" && client.role == Role::evaluator) {
    write(number, now_ns);
  } else if (kind == "event") {
    event(client, &said, now_ns);
  } else if (kind == "steer") {
    std::string up =
        dumped({{"kind", "steer"}, {"what", textIn(said, "what")}, {"value", said.value("value", HubJson())}});
    if (!pageWordFrom(up)) return ++client.nonsense <= kMostNonsense;
    // Who only sees steers nothing.
    if (number == writer_ && up_.size() < kMostUpTexts) up_.push_back(std::move(up));
  } else {
    return ++client.nonsense <= kMostNonsense;
  }
  return true;
}

void PageHub::event(Client& client, const void* message, std::int64_t) {
  const HubJson& said = *static_cast<const HubJson*>(message);
  HubJson up{{"kind", "event"}, {"role", client.role == Role::evaluator ? "evaluator" : "participant"}};
  for (const char* key : {"page", "session", "seq", "type", "t_ns", "rtt_ms", "data"})
    if (said.contains(key)) up[key] = said[key];
  std::string text = dumped(up);
  const auto word = text.size() <= kMostUp ? pageWordFrom(text) : std::nullopt;
  if (!word) {
    ++client.nonsense;
    if (isPageId(textIn(said, "page")) && said.contains("seq") && said["seq"].is_number_unsigned())
      reply(client, refusedWith(textIn(said, "page"), said["seq"], "it was not understood"));
    return;
  }
  const auto& event = std::get<PageEvent>(*word);
  if (client.page.empty()) client.page = event.page;
  // What was typed while it wrote still counts.
  const bool writes =
      client.role == Role::participant || (clients_.contains(writer_) && &clients_.at(writer_) == &client);
  if (!writes && event.event.t_ns >= writer_since_ns_)
    return reply(client, refusedWith(event.page, event.number, "another page writes, take over first"));
  // Where the session is slow to hear, it is said again.
  if (up_.size() < kMostUpTexts) up_.push_back(std::move(text));
}

bool PageHub::tell(std::string_view text) {
  HubJson told = parsed(text);
  const std::string kind = told.is_object() ? textIn(told, "kind") : "";
  if (kind == "end") return false;
  if (kind == "state") {
    if (const auto course = told.find("course"); course != told.end() && course->is_array())
      for (HubJson& point : *course) state_->course.push_back(std::move(point));
    while (state_->course.size() > 1 &&
           state_->course.back().value("t_s", 0.0) - state_->course.front().value("t_s", 0.0) > kKept_s)
      state_->course.pop_front();
    told["course"] = HubJson::array();
    state_->json = std::move(told);
    ++state_->number;
  }
  if (kind == "ack" || kind == "refused")
    for (auto& [number, client] : clients_)
      if (client.page == textIn(told, "page")) reply(client, std::string(text));
  if (kind == "tokens") {
    tokens_.clear();
    for (const HubJson& one : told.value("tokens", HubJson::array()))
      tokens_[textIn(one, "token")] = one.value("until_ns", std::int64_t{0});
  }
  if (kind == "paired")
    paired_.push_back({told.value("request", std::int64_t{0}), textIn(told, "token"), textIn(told, "why")});
  return true;
}

void PageHub::show(std::uint32_t serial, std::int64_t t_ns, std::string_view jpeg) {
  constexpr std::uint32_t kMark = 0x4d4c5250;
  std::string bytes;
  const auto add = [&](std::uint64_t value, std::size_t size) {
    for (std::size_t n = 0; n < size; ++n) bytes += static_cast<char>(value >> (8U * n) & 0xFFU);
  };
  add(kMark, 4), add(serial, 4), add(static_cast<std::uint64_t>(t_ns), 8);
  bytes += jpeg;
  picture_ = std::make_shared<const std::string>(std::move(bytes));
  picture_serial_ = serial;
}

bool PageHub::wantsPicture() const {
  return std::ranges::any_of(clients_, [](const auto& one) {
    return one.second.role == Role::evaluator && one.second.undrawn < kMostUndrawn;
  });
}

std::string PageHub::stateFor(Client& client, std::int64_t now_ns) const {
  HubJson state = state_->json;
  const bool is_writer = clients_.contains(writer_) && &clients_.at(writer_) == &client;
  state["role"] = client.role == Role::evaluator ? "evaluator" : "participant";
  state["writer"] = client.role == Role::participant || is_writer;
  state["now_ns"] = now_ns;
  if (client.role == Role::participant) {
    // What is written about him is not his to read meanwhile.
    for (const char* key : {"notes", "prompts", "checks", "course"}) state[key] = HubJson::array();
    state["debrief"] = nullptr;
    if (state.contains("task") && state["task"].is_object())
      state["task"]["success"] = state["task"]["fail"] = HubJson::array();
    return dumped(state);
  }
  HubJson& course = state["course"] = HubJson::array();
  for (const HubJson& point : state_->course)
    if (point.value("t_s", 0.0) > client.course_until_s) course.push_back(point);
  if (!course.empty()) client.course_until_s = course.back().value("t_s", 0.0);
  return dumped(state);
}

std::optional<PageHub::Outgoing> PageHub::next(int number, std::int64_t now_ns) {
  const auto found = clients_.find(number);
  if (found == clients_.end()) return {};
  Client& client = found->second;
  if (!client.replies.empty()) {
    std::string text = std::move(client.replies.front());
    client.replies.pop_front();
    constexpr std::string_view kPong = R"({"kind":"pong")";
    if (text.starts_with(kPong)) text.insert(text.size() - 1, ",\"t2\":" + std::to_string(now_ns));
    return Outgoing{false, std::make_shared<const std::string>(std::move(text))};
  }
  if (client.seen < state_->number && !state_->json.is_null()) {
    client.seen = state_->number;
    return Outgoing{false, std::make_shared<const std::string>(stateFor(client, now_ns))};
  }
  if (client.role != Role::evaluator || !picture_ || client.pictured == picture_serial_ ||
      client.undrawn >= kMostUndrawn)
    return {};
  client.pictured = picture_serial_;
  ++client.undrawn;
  return Outgoing{true, picture_};
}

std::vector<std::string> PageHub::takeUp() { return std::exchange(up_, {}); }

std::int64_t PageHub::pair(const std::string& digits) {
  up_.push_back(dumped({{"kind", "pair"}, {"request", ++request_}, {"digits", digits}}));
  return request_;
}

std::vector<PageHub::Paired> PageHub::takePaired() { return std::exchange(paired_, {}); }

bool PageHub::isValid(std::string_view token, std::int64_t now_ns) const {
  const auto found = tokens_.find(token);
  return found != tokens_.end() && now_ns < found->second;
}

}  // namespace app
