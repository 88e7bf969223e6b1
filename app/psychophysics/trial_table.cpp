#include "app/psychophysics/trial_table.h"

#include <fcntl.h>
#include <sys/stat.h>
#include <unistd.h>

#include <cerrno>
#include <cstring>

#include "app/options/law_text.h"
#include "app/text/usage_error.h"
#include "assets/toml_reader.h"

namespace app {
namespace {

constexpr const char* kHeader =
    "trial,participant,method,track,first,parameter,unit,standard_law,standard,comparison_law,comparison,response,"
    "comparison_harder,correct,reversal,reversals,response_s,standard_stiffness_N_per_mm,standard_peak_N,"
    "standard_depth_mm,standard_work_Nmm,comparison_stiffness_N_per_mm,comparison_peak_N,comparison_depth_mm,"
    "comparison_work_Nmm\n";

std::string orEmpty(const std::optional<double>& value) { return value ? assets::numberText(*value) : std::string(); }

std::string measuresText(const ProbeMeasures& felt) {
  return assets::numberText(felt.stiffness_N_per_mm) + "," + assets::numberText(felt.peak_force_N) + "," +
         assets::numberText(felt.depth_mm) + "," + assets::numberText(felt.work_Nmm);
}

}  // namespace

std::string methodName(Method method) {
  return method == Method::constant ? "2afc-constant" : method == Method::staircase ? "staircase" : "2afc";
}

TrialTable::TrialTable(const std::string& path, bool overwrite, const Protocol& protocol)
    : path_(path),
      participant_(protocol.participant),
      method_(methodName(protocol.method)),
      parameter_(protocol.parameter),
      unit_(protocol.unit),
      standard_law_(lawName(protocol.standard.kind)),
      comparison_law_(lawName(protocol.comparison.kind)) {
  file_ = ::open(path.c_str(), O_WRONLY | O_CREAT | O_CLOEXEC | (overwrite ? 0 : O_EXCL), 0644);
  if (file_ < 0 && errno == EEXIST)
    throw UsageError("--out " + path + ": it is there already, give another name or --force");
  if (file_ < 0) throw UsageError("--out " + path + ": " + std::strerror(errno) + ", choose another place");
  struct stat status {};
  if (::fstat(file_, &status) != 0 || !S_ISREG(status.st_mode) || ::ftruncate(file_, 0) != 0) {
    ::close(file_);
    throw UsageError("--out " + path + ": it is not a plain file, choose another name");
  }
  write(kHeader);
}

TrialTable::~TrialTable() { ::close(file_); }

void TrialTable::add(const TrialRecord& r) {
  std::string line = std::to_string(r.trial) + "," + participant_ + "," + method_ + "," + std::to_string(r.track + 1) +
                     "," + (r.comparison_first ? "comparison" : "standard") + "," + parameter_ + "," + unit_ + "," +
                     standard_law_ + "," + orEmpty(r.standard) + "," + comparison_law_ + "," + orEmpty(r.comparison);
  line += r.comparison_harder == r.comparison_first ? ",first" : ",second";
  line += r.comparison_harder ? ",1," : ",0,";
  line += r.correct ? (*r.correct ? "1" : "0") : "";
  line += r.reversal ? ",1," : ",0,";
  line += std::to_string(r.reversals) + "," + orEmpty(r.response_s) + "," + measuresText(r.standard_measures) + "," +
          measuresText(r.comparison_measures) + "\n";
  write(line);
}

void TrialTable::write(const std::string& line) {
  // One write per row: only the last row can be incomplete.
  for (std::size_t done = 0; done < line.size();) {
    const ssize_t n = ::write(file_, line.data() + done, line.size() - done);
    if (n < 0 && errno == EINTR) continue;
    if (n <= 0)
      throw UsageError("--out " + path_ + ": " + std::strerror(errno) + ", make room; the rows before this one stand");
    done += static_cast<std::size_t>(n);
  }
  ::fdatasync(file_);
}

}  // namespace app
