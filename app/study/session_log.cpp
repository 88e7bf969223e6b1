#include "app/study/session_log.h"

#include <fcntl.h>
#include <sys/file.h>
#include <unistd.h>

#include <algorithm>
#include <cerrno>
#include <chrono>
#include <condition_variable>
#include <cstring>
#include <mutex>
#include <thread>

#include <nlohmann/json.hpp>

#include "assets/load_error.h"
#include "assets/toml_reader.h"
#include "calibration/calibration_error.h"
#include "calibration/record/sha256.h"

namespace app {
namespace {

using nlohmann::ordered_json;

constexpr std::size_t kMostLogBytes = 64U << 20U;
constexpr std::chrono::milliseconds kBetweenSyncs{100};

template <class Value>
const Value* valueOf(const LogEvent& event, std::string_view key) {
  const auto found = std::ranges::find(event.data, key, [](const auto& one) { return std::string_view(one.first); });
  return found == event.data.end() ? nullptr : std::get_if<Value>(&found->second);
}

ordered_json jsonOf(const LogEvent& event, std::uint64_t number) {
  ordered_json line{{"seq", number}, {"t_ns", event.t_ns}};
  if (event.tick) line["tick"] = *event.tick;
  line["src"] = event.source;
  line["type"] = event.type;
  ordered_json data = ordered_json::object();
  for (const auto& [key, value] : event.data)
    std::visit([&, &name = key](const auto& one) { data[name] = one; }, value);
  line["data"] = data;
  return line;
}

std::string textOf(const ordered_json& line) {
  return line.dump(-1, ' ', false, ordered_json::error_handler_t::replace);
}

std::string digestOf(const std::string& before, const std::string& line) {
  return calibration::sha256Of(before + line);
}

struct ChainedLine {
  std::string bytes, digest;
};

ChainedLine lineAfter(const std::string& before, const LogEvent& event, std::uint64_t number) {
  ordered_json line = jsonOf(event, number);
  std::string digest = digestOf(before, textOf(line));
  line["digest"] = digest;
  return {textOf(line) + "\n", std::move(digest)};
}

/// None: not an event.
std::optional<LogEvent> eventFrom(const ordered_json& line) {
  const auto is_text = [&](const char* key) { return line.contains(key) && line[key].is_string(); };
  if (!line.is_object() || !is_text("src") || !is_text("type") || !line.contains("t_ns") ||
      !line["t_ns"].is_number_integer() || !line.contains("data") || !line["data"].is_object())
    return {};
  LogEvent event{line["t_ns"].get<std::int64_t>(), {}, line["src"], line["type"], {}};
  if (line.contains("tick") && line["tick"].is_number_unsigned()) event.tick = line["tick"].get<std::uint64_t>();
  for (const auto& [key, value] : line["data"].items()) {
    if (value.is_boolean()) event.data.emplace_back(key, value.get<bool>());
    if (value.is_number_integer()) event.data.emplace_back(key, value.get<std::int64_t>());
    if (value.is_number_float()) event.data.emplace_back(key, value.get<double>());
    if (value.is_string()) event.data.emplace_back(key, value.get<std::string>());
  }
  return event;
}

}  // namespace

const std::string* LogEvent::text(std::string_view key) const { return valueOf<std::string>(*this, key); }

std::string LogEvent::textOr(std::string_view key) const {
  const std::string* const found = text(key);
  return found == nullptr ? "" : *found;
}

std::optional<double> LogEvent::number(std::string_view key) const {
  if (const auto* whole = valueOf<std::int64_t>(*this, key)) return static_cast<double>(*whole);
  const auto* value = valueOf<double>(*this, key);
  return value == nullptr ? std::nullopt : std::optional(*value);
}

std::optional<bool> LogEvent::flag(std::string_view key) const {
  const auto* value = valueOf<bool>(*this, key);
  return value == nullptr ? std::nullopt : std::optional(*value);
}

struct SessionLogWriter::Impl {
  int file = -1;
  std::uint64_t number = 0;
  std::string digest;
  std::optional<std::string> trouble;
  mutable std::mutex mutex;
  std::condition_variable wakes;
  std::uint64_t handed = 0, on_disk = 0;
  bool is_dirty = false, ends = false;
  std::thread syncs;

  void keepOnDisk() {
    std::unique_lock lock(mutex);
    while (!ends) {
      wakes.wait_for(lock, kBetweenSyncs, [this] { return ends; });
      if (!std::exchange(is_dirty, false)) continue;
      const std::uint64_t synced = handed;
      lock.unlock();
      const bool is_kept = fdatasync(file) == 0;
      lock.lock();
      if (is_kept) on_disk = synced;
    }
  }
};

SessionLogWriter::SessionLogWriter(const std::string& path) : impl_(std::make_unique<Impl>()) {
  constexpr mode_t kOwnerAlone = 0600;
  impl_->file = open(path.c_str(), O_WRONLY | O_CREAT | O_EXCL | O_APPEND | O_CLOEXEC, kOwnerAlone);
  if (impl_->file < 0)
    throw calibration::CalibrationError(path + ": cannot be made (" + std::strerror(errno) + "), give another folder");
  impl_->syncs = std::thread([this] { impl_->keepOnDisk(); });
}

SessionLogWriter::~SessionLogWriter() {
  {
    const std::scoped_lock lock(impl_->mutex);
    impl_->ends = true;
  }
  impl_->wakes.notify_one();
  impl_->syncs.join();
  fsync(impl_->file);
  close(impl_->file);
}

void SessionLogWriter::add(const LogEvent& event) {
  Impl& log = *impl_;
  if (log.trouble) return;
  const auto [bytes, digest] = lineAfter(log.digest, event, log.number);
  if (write(log.file, bytes.data(), bytes.size()) != static_cast<ssize_t>(bytes.size())) {
    log.trouble = std::string("the event log has ended: ") + std::strerror(errno) + ", make room on the disk";
    return;
  }
  log.digest = digest;
  ++log.number;
  const std::scoped_lock lock(log.mutex);
  log.handed = log.number;
  log.is_dirty = true;
}

std::uint64_t SessionLogWriter::onDisk() const {
  const std::scoped_lock lock(impl_->mutex);
  return impl_->on_disk;
}

std::optional<std::string> SessionLogWriter::trouble() const { return impl_->trouble; }

SessionLog readSessionLog(const std::string& path) {
  const std::string text = assets::readSmallFile(path, kMostLogBytes);
  SessionLog log;
  std::string digest;
  std::uint64_t number = 0;
  for (std::size_t at = 0, end = 0; (end = text.find('\n', at)) != std::string::npos; at = end + 1, ++number) {
    ordered_json line = ordered_json::parse(text.begin() + static_cast<std::ptrdiff_t>(at),
                                            text.begin() + static_cast<std::ptrdiff_t>(end), nullptr, false);
    const bool has_digest = line.is_object() && line.contains("digest") && line["digest"].is_string();
    const std::string stated = has_digest ? line["digest"].get<std::string>() : "";
    if (has_digest) line.erase("digest");
    digest = line.is_discarded() ? "" : digestOf(digest, textOf(line));
    auto event = eventFrom(line);
    if (!event || stated != digest) {
      log.damage = path + ": line " + std::to_string(number + 1) + " was changed after it was written";
      break;
    }
    log.events.push_back(std::move(*event));
    log.digest = digest;
  }
  log.is_closed = !log.damage && !log.events.empty() && log.events.back().type == "session.stop";
  return log;
}

void appendToLog(const std::string& path, const LogEvent& event) {
  constexpr mode_t kOwnerAlone = 0600;
  const auto refuse = [&] {
    throw calibration::CalibrationError(path + ": cannot be written (" + std::strerror(errno) + "), make room for it");
  };
  const int file = open(path.c_str(), O_WRONLY | O_CREAT | O_APPEND | O_CLOEXEC, kOwnerAlone);
  if (file < 0) refuse();
  const std::unique_ptr<const int, void (*)(const int*)> closes(&file, [](const int* one) { close(*one); });
  flock(file, LOCK_EX);
  const SessionLog log = readSessionLog(path);
  if (log.damage) throw assets::LoadError(*log.damage + ": put it aside, a new one is begun");
  const std::string bytes = lineAfter(log.digest, event, log.events.size()).bytes;
  // What a kill left of a line is no line.
  const off_t end = static_cast<off_t>(assets::readSmallFile(path, kMostLogBytes).rfind('\n') + 1);
  if (ftruncate(file, end) != 0 || write(file, bytes.data(), bytes.size()) != static_cast<ssize_t>(bytes.size()) ||
      fsync(file) != 0)
    refuse();
}

}  // namespace app
