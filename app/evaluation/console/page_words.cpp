#include "app/evaluation/console/page_words.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <cstring>
#include <utility>
#include <vector>

#include <nlohmann/json.hpp>

#include "assets/json_depth.h"

namespace app {
namespace {

using nlohmann::json;

constexpr std::size_t kLongestPageText = 4000, kHead = 4;
constexpr double kLongestTrip_ms = 60'000.0;
constexpr std::uint64_t kMostNumber = std::uint64_t{1} << 53U;

/// Types of events that come from a page, and what they may carry.
struct PageType {
  std::string_view type;
  std::array<std::string_view, 4> keys;
};
constexpr std::array<PageType, 10> kPageTypes{{{"consent", {"stream", "given"}},
                                               {"note", {"kind", "text", "severity"}},
                                               {"prompt", {"prompt"}},
                                               {"bookmark", {"label"}},
                                               {"help", {"reason"}},
                                               {"problem", {"problem", "title", "severity"}},
                                               {"task", {"result", "reason"}},
                                               {"answer", {"questionnaire", "item", "value", "words"}},
                                               {"submit", {"questionnaire"}},
                                               {"continue", {}}}};

const std::string* pageText(const json& from, const char* key) {
  const auto found = from.find(key);
  return found != from.end() && found->is_string() ? found->get_ptr<const std::string*>() : nullptr;
}

std::optional<double> pageNumber(const json& from, const char* key) {
  const auto found = from.find(key);
  if (found == from.end() || !found->is_number()) return {};
  const double value = found->get<double>();
  return std::isfinite(value) ? std::optional(value) : std::nullopt;
}

std::optional<LogValue> datumFrom(const json& value) {
  if (value.is_boolean()) return value.get<bool>();
  if (value.is_number_unsigned() && value.get<std::uint64_t>() > kMostNumber) return {};
  if (value.is_number_integer()) return value.get<std::int64_t>();
  if (value.is_number_float())
    return std::isfinite(value.get<double>()) ? std::optional<LogValue>(value.get<double>()) : std::nullopt;
  if (!value.is_string() || value.get_ref<const std::string&>().size() > kLongestPageText) return {};
  return value.get<std::string>();
}

std::optional<PageWord> eventFrom(const json& said) {
  const std::string *page = pageText(said, "page"), *type = pageText(said, "type"), *role = pageText(said, "role"),
                    *session = pageText(said, "session");
  const auto number = said.find("seq"), at = said.find("t_ns"), data = said.find("data");
  if (page == nullptr || !isPageId(*page) || type == nullptr || role == nullptr ||
      (*role != "evaluator" && *role != "participant") || number == said.end() || !number->is_number_unsigned() ||
      at == said.end() || !at->is_number() || (session != nullptr && !isPageId(*session)))
    return {};
  PageEvent made;
  made.page = *page;
  if (session != nullptr) made.session = *session;
  made.number = number->get<std::uint64_t>();
  if (made.number == 0 || made.number > kMostNumber) return {};
  made.round_trip_ms = std::clamp(pageNumber(said, "rtt_ms").value_or(0.0), 0.0, kLongestTrip_ms);
  made.event.source = *role;
  made.event.type = *type;
  if (at->is_number_integer()) {
    made.event.t_ns = at->get<std::int64_t>();
  } else {
    const double t_ns = at->get<double>();
    if (!(std::abs(t_ns) < static_cast<double>(std::int64_t{1} << 62U))) return {};
    made.event.t_ns = static_cast<std::int64_t>(t_ns);
  }
  const auto known = std::ranges::find(kPageTypes, *type, &PageType::type);
  if (known == kPageTypes.end()) return {};
  if (data == said.end()) return made;
  if (!data->is_object()) return {};
  for (const std::string_view key : known->keys) {
    if (key.empty()) continue;
    const auto found = data->find(std::string(key));
    if (found == data->end() || found->is_null()) continue;
    auto value = datumFrom(*found);
    if (!value) return {};
    made.event.data.emplace_back(std::string(key), std::move(*value));
  }
  return made;
}

/// Play and pause need no value; a time is one of the first two days, a speed within its bounds.
std::optional<PageWord> steerFrom(const json& said) {
  constexpr double kLongest_s = 172'800.0;
  const std::string* const what = pageText(said, "what");
  const auto known = what == nullptr ? kDebriefSteers.end() : std::ranges::find(kDebriefSteers, *what);
  if (known == kDebriefSteers.end()) return {};
  PageSteers steered{static_cast<DebriefSteer>(known - kDebriefSteers.begin()), 0.0};
  if (steered.what == DebriefSteer::play || steered.what == DebriefSteer::pause) return steered;
  const bool is_speed = steered.what == DebriefSteer::speed;
  const auto value = pageNumber(said, "value");
  if (!value || *value < (is_speed ? kLeastDebriefSpeed : 0.0) || *value > (is_speed ? kMostDebriefSpeed : kLongest_s))
    return {};
  steered.value = *value;
  return steered;
}

}  // namespace

std::string framed(std::string_view text) {
  const auto size = static_cast<std::uint32_t>(text.size());
  std::string bytes(kHead + text.size(), '\0');
  for (std::size_t n = 0; n < kHead; ++n) bytes[n] = static_cast<char>(size >> (8U * n) & 0xFFU);
  std::memcpy(bytes.data() + kHead, text.data(), text.size());
  return bytes;
}

bool FrameReader::add(std::span<const char> bytes) {
  if (is_broken_) return false;
  open_.append(bytes.data(), bytes.size());
  std::size_t at = 0;
  while (open_.size() - at >= kHead) {
    std::size_t size = 0;
    for (std::size_t n = 0; n < kHead; ++n) size |= std::size_t{static_cast<unsigned char>(open_[at + n])} << (8U * n);
    is_broken_ = size == 0 || size > most_;
    if (is_broken_) return false;
    if (open_.size() - at - kHead < size) break;
    texts_.push_back(open_.substr(at + kHead, size));
    at += kHead + size;
  }
  open_.erase(0, at);
  return true;
}

std::optional<std::string> FrameReader::next() {
  if (texts_.empty()) return {};
  std::string text = std::move(texts_.front());
  texts_.pop_front();
  return text;
}

bool isPageId(std::string_view id) {
  constexpr std::size_t kLongest = 64;
  return !id.empty() && id.size() <= kLongest && std::ranges::all_of(id, [](char c) {
    return (c >= 'a' && c <= 'z') || (c >= 'A' && c <= 'Z') || (c >= '0' && c <= '9') || c == '-';
  });
}

std::optional<PageWord> pageWordFrom(std::string_view text) {
  if (assets::isNestedTooDeep(text)) return {};
  const json said = json::parse(text.begin(), text.end(), nullptr, false);
  if (!said.is_object()) return {};
  const std::string* const kind = pageText(said, "kind");
  if (kind == nullptr) return {};
  if (*kind == "event") return eventFrom(said);
  if (*kind == "ready") return PageServes{};
  if (*kind == "alive") {
    constexpr double kMostPages = 1000.0;
    const auto pages = pageNumber(said, "pages");
    if (!pages || !(*pages >= 0.0 && *pages <= kMostPages)) return {};
    return PageLives{static_cast<int>(*pages)};
  }
  if (*kind == "pair") {
    const auto request = pageNumber(said, "request");
    const std::string* const digits = pageText(said, "digits");
    if (!request || std::abs(*request) > static_cast<double>(kMostNumber) || digits == nullptr) return {};
    return PagePairs{static_cast<std::int64_t>(*request), *digits};
  }
  return *kind == "steer" ? steerFrom(said) : std::nullopt;
}

std::string acknowledged(const std::string& page, std::uint64_t number) {
  return json{{"kind", "ack"}, {"page", page}, {"seq", number}}.dump();
}

std::string refusedWith(const std::string& page, std::uint64_t number, const std::string& why) {
  return json{{"kind", "refused"}, {"page", page}, {"seq", number}, {"why", why}}.dump(-1, ' ', false,
                                                                                       json::error_handler_t::replace);
}

}  // namespace app
