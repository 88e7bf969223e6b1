#include "app/study/audit.h"

#include <algorithm>
#include <chrono>
#include <filesystem>

#include "assets/load_error.h"
#include "calibration/record/utc.h"

namespace app {
namespace {

constexpr std::int64_t kSecondInNs = 1'000'000'000;

std::string auditPath(const std::string& study) { return (std::filesystem::path(study) / kAuditName).string(); }

}  // namespace

std::int64_t nowUnix_s() {
  return std::chrono::floor<std::chrono::seconds>(std::chrono::system_clock::now()).time_since_epoch().count();
}

void audit(const std::string& study, std::int64_t now_s, const std::string& did,
           std::vector<std::pair<std::string, LogValue>> what) {
  what.insert(what.begin(), {"utc", calibration::utcOf(now_s)});
  appendToLog(auditPath(study), {now_s * kSecondInNs, {}, "owner", did, std::move(what)});
}

std::optional<std::int64_t> newestAudit_s(const std::string& study) {
  std::error_code failed;
  if (!std::filesystem::exists(auditPath(study), failed)) return {};
  const SessionLog log = readSessionLog(auditPath(study));
  if (log.damage) throw assets::LoadError(*log.damage + ": put it aside, a new one is begun");
  std::optional<std::int64_t> newest;
  for (const LogEvent& event : log.events) newest = std::max(newest.value_or(0), event.t_ns / kSecondInNs);
  return newest;
}

}  // namespace app
