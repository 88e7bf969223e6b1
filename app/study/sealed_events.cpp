#include "app/study/sealed_events.h"

#include <algorithm>
#include <array>
#include <string_view>
#include <utility>

#include <nlohmann/json.hpp>

#include "assets/load_error.h"

namespace app {
namespace {

using nlohmann::ordered_json;

constexpr char kSealedKey[] = "sealed", kSealedRows[] = "events";
constexpr auto kSaid = std::to_array<std::pair<std::string_view, std::string_view>>({{"note", "text"},
                                                                                     {"bookmark", "label"},
                                                                                     {"help", "reason"},
                                                                                     {"problem", "problem"},
                                                                                     {"problem", "title"},
                                                                                     {"task.stop", "reason"},
                                                                                     {"task.override", "reason"},
                                                                                     {"answer", "value"},
                                                                                     {"answer", "words"}});

SealedStream streamOf(const LogEvent& event) {
  return event.type == "answer" ? SealedStream::answers : SealedStream::words;
}

}  // namespace

bool isSaid(const LogEvent& event, std::string_view key) {
  // Why a task ended by a rule or by the program is the program's own word.
  if (event.type == "task.stop" && event.source != "evaluator") return false;
  return std::ranges::find(kSaid, std::pair<std::string_view, std::string_view>(event.type, key)) != kSaid.end();
}

LogEvent sealedEvent(const SessionSeal& seal, LogEvent event, std::uint64_t row) {
  ordered_json said = ordered_json::object();
  for (const auto& [key, value] : event.data)
    if (isSaid(event, key)) std::visit([&, &name = key](const auto& one) { said[name] = one; }, value);
  if (said.empty()) return event;
  std::erase_if(event.data, [&](const auto& datum) { return isSaid(event, datum.first); });
  const std::string words = said.dump(-1, ' ', false, ordered_json::error_handler_t::replace);
  const std::string sealed = seal.seal(streamOf(event), kSealedRows, row, words);
  if (!sealed.empty()) event.data.emplace_back(kSealedKey, base64Of(sealed));
  return event;
}

OpenedEvents openedEvents(std::vector<LogEvent> events, const OpenedSession* session, const std::string& where) {
  OpenedEvents made;
  for (std::size_t row = 0; row < events.size(); ++row) {
    LogEvent& event = events[row];
    const std::string* const sealed = event.text(kSealedKey);
    if (sealed == nullptr) continue;
    const SealedStream stream = streamOf(event);
    if (session == nullptr || !session->holds(stream)) {
      ++made.sealed;
      continue;
    }
    const auto bytes = fromBase64(*sealed);
    const auto words = bytes ? session->open(stream, kSealedRows, row, *bytes) : std::nullopt;
    const ordered_json said = words ? ordered_json::parse(*words, nullptr, false) : ordered_json();
    if (!said.is_object())
      throw assets::LoadError(where + ": the words of line " + std::to_string(row + 1) +
                              " do not open, they were changed or moved");
    std::erase_if(event.data, [](const auto& datum) { return datum.first == kSealedKey; });
    for (const auto& [key, value] : said.items()) {
      if (value.is_string()) event.data.emplace_back(key, value.get<std::string>());
      if (value.is_number_integer()) event.data.emplace_back(key, value.get<std::int64_t>());
      if (value.is_number_float()) event.data.emplace_back(key, value.get<double>());
    }
  }
  made.events = std::move(events);
  return made;
}

}  // namespace app
