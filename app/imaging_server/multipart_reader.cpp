#include "app/imaging_server/multipart_reader.h"

#include <algorithm>
#include <cctype>
#include <utility>

#include "app/text/usage_error.h"

namespace app {
namespace {

constexpr std::size_t kLongestHead = 16'384, kLongestBefore = 65'536, kLongestLine = 1'024;

std::string inLowerCase(std::string_view text) {
  std::string lower(text);
  std::ranges::transform(lower, lower.begin(), [](unsigned char c) { return static_cast<char>(std::tolower(c)); });
  return lower;
}

/// Value of a parameter of a content type; empty: it has none. In quotes or not.
std::string parameterOf(std::string_view content_type, std::string_view name) {
  const std::string lower = inLowerCase(content_type);
  for (std::size_t at = lower.find(';'); at != std::string::npos; at = lower.find(';', at + 1)) {
    std::size_t from = at + 1;
    while (from < lower.size() && (lower[from] == ' ' || lower[from] == '\t')) ++from;
    if (lower.compare(from, name.size(), name) != 0 || from + name.size() >= lower.size() ||
        lower[from + name.size()] != '=')
      continue;
    std::string_view value = content_type.substr(from + name.size() + 1);
    if (value.starts_with('"')) {
      value.remove_prefix(1);
      return std::string(value.substr(0, std::min(value.find('"'), value.size())));
    }
    return std::string(value.substr(0, std::min(value.find_first_of("; \t"), value.size())));
  }
  return {};
}

}  // namespace

MultipartReader::MultipartReader(std::string_view content_type, std::string where, const ReceiveLimits& limits,
                                 assets::ReceivedFiles& files)
    : where_(std::move(where)), limits_(limits), files_(files) {
  constexpr std::size_t kLongestBoundary = 70;
  const std::string boundary = parameterOf(content_type, "boundary");
  const std::string type = inLowerCase(parameterOf(content_type, "type"));
  if (!inLowerCase(content_type).starts_with("multipart/related") || (!type.empty() && type != "application/dicom"))
    refuse("its answer holds no DICOM files; check that this is DICOMweb");
  if (boundary.empty() || boundary.size() > kLongestBoundary)
    refuse("its answer does not say where files begin; nothing was imported");
  delimiter_ = "\r\n--" + boundary;
  // The first one may stand at the very beginning.
  held_ = "\r\n";
}

void MultipartReader::refuse(const std::string& why) const { throw UsageError(where_ + ": " + why); }

void MultipartReader::takeBody(std::size_t end) {
  const std::size_t count = end - at_;
  file_bytes_ += count;
  if (file_bytes_ > limits_.file_bytes) refuse("one file is larger than any scan; nothing was imported");
  if (files_.bytes() + file_bytes_ > limits_.all_bytes)
    refuse("it sends more than 8 GB; choose one study with --study, or take its scan on a disc");
  files_.append({held_.data() + at_, count});
  at_ = end;
}

bool MultipartReader::step() {
  const std::string_view rest = std::string_view(held_).substr(at_);
  switch (state_) {
    case State::before: {
      const std::size_t found = rest.find(delimiter_);
      if (found == std::string_view::npos) {
        if (rest.size() > kLongestBefore) refuse("its answer has no boundary where one belongs; nothing was imported");
        return false;
      }
      at_ += found + delimiter_.size();
      state_ = State::boundary;
      return true;
    }
    case State::boundary: {
      if (rest.size() < 2) return false;
      if (rest.starts_with("--")) {
        state_ = State::after;
        return true;
      }
      const std::size_t end = rest.find("\r\n");
      const std::string_view line = rest.substr(0, std::min(end, rest.size()));
      if (line.size() > kLongestLine || line.find_first_not_of(" \t\r") != std::string_view::npos)
        refuse("its answer has a damaged boundary; nothing was imported");
      if (end == std::string_view::npos) return false;
      if (files_.count() >= limits_.files) refuse("it sends more than 20,000 files; choose one study with --study");
      at_ += end;  // the end of this line begins the head
      state_ = State::head;
      return true;
    }
    case State::head: {
      const std::size_t end = rest.find("\r\n\r\n");
      if (end == std::string_view::npos || end > kLongestHead) {
        if (rest.size() > kLongestHead) refuse("a file in its answer has an endless head; nothing was imported");
        return false;
      }
      const std::string head = inLowerCase(rest.substr(0, end));
      const std::size_t type = head.find("\r\ncontent-type:");
      if (type != std::string::npos && head.substr(type, 64).find("application/dicom") == std::string::npos)
        refuse("a file in its answer is no DICOM file; check that this is DICOMweb");
      at_ += end + 4;
      file_bytes_ = 0;
      state_ = State::body;
      return true;
    }
    case State::body: {
      const std::size_t found = rest.find(delimiter_);
      if (found == std::string_view::npos) {
        // A delimiter may begin at the end of what is there.
        if (rest.size() >= delimiter_.size()) takeBody(held_.size() - (delimiter_.size() - 1));
        return false;
      }
      takeBody(at_ + found);
      files_.endFile();
      at_ += delimiter_.size();
      state_ = State::boundary;
      return true;
    }
    case State::after:
      at_ = held_.size();
      return false;
  }
  return false;
}

void MultipartReader::read(std::span<const char> bytes) {
  held_.append(bytes.data(), bytes.size());
  while (step()) {
  }
  held_.erase(0, at_);
  at_ = 0;
}

void MultipartReader::finish() const {
  if (state_ != State::after) refuse("its answer ends within a file; nothing was imported, try again");
}

}  // namespace app
