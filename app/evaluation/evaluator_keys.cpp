#include "app/evaluation/evaluator_keys.h"

#include <utility>

namespace app {
namespace {

constexpr char kEscape = 27, kBackspace = 8, kDelete = 127;
constexpr std::size_t kLongest = 1000;

LogEvent eventOf(std::string type, std::int64_t t_ns, std::vector<std::pair<std::string, LogValue>> data) {
  return {t_ns, {}, "evaluator", std::move(type), std::move(data)};
}

}  // namespace

std::optional<LogEvent> EvaluatorKeys::takeFree(char c, std::int64_t t_ns) {
  severity_ = 0, is_rated_ = false, began_ns_ = 0;
  text_.clear();
  switch (c) {
    case '1':
      open_ = Open::behaviour;
      break;
    case '2':
      open_ = Open::comment;
      break;
    case '3':
      if (!prompts_.empty()) return eventOf("prompt", t_ns, {{"prompt", prompts_[marked_]}});
      break;
    case '+':
      if (!prompts_.empty()) marked_ = (marked_ + 1) % prompts_.size();
      break;
    case '4':
      return eventOf("bookmark", t_ns, {});
    case '5':
      open_ = Open::task;
      break;
    case '6':
      open_ = Open::help;
      break;
    case '7':
      open_ = Open::problem;
      break;
    case '8':
      open_ = Open::withdrawal;
      break;
    default:
      break;
  }
  return {};
}

void EvaluatorKeys::takeTask(char c) {
  open_ = c == '1' ? Open::success : c == '2' ? Open::partly : c == '3' ? Open::failed : Open::none;
}

LogEvent EvaluatorKeys::said() const {
  std::vector<std::pair<std::string, LogValue>> data;
  std::string type = "note";
  switch (open_) {
    case Open::none:
    case Open::task:
    case Open::behaviour:
      data = {{"kind", std::string("behaviour")}, {"text", text_}};
      break;
    case Open::comment:
      data = {{"kind", std::string("comment")}, {"text", text_}};
      break;
    case Open::success:
    case Open::partly:
    case Open::failed:
      type = "task";
      data = {{"result", std::string(open_ == Open::success  ? "success"
                                     : open_ == Open::partly ? "partly"
                                                             : "failed")},
              {"reason", text_}};
      break;
    case Open::help:
      type = "help";
      data = {{"reason", text_}};
      break;
    case Open::problem: {
      type = "problem";
      const std::size_t colon = text_.find(": ");
      data = {{"problem", text_.substr(0, colon)},
              {"title", colon == std::string::npos ? text_ : text_.substr(colon + 2)}};
      break;
    }
    case Open::withdrawal:
      type = "consent";
      data = {{"stream", text_}, {"given", false}};
      break;
  }
  if (is_rated_) data.emplace_back("severity", static_cast<std::int64_t>(severity_));
  return eventOf(std::move(type), began_ns_, std::move(data));
}

std::optional<LogEvent> EvaluatorKeys::take(char c, std::int64_t t_ns) {
  if (open_ == Open::none) return takeFree(c, t_ns);
  if (open_ == Open::task) {
    if (c == '5') {
      open_ = Open::none;
      return eventOf("task", t_ns, {{"result", std::string("next")}});
    }
    if (c == '4') {
      open_ = Open::none;
      return eventOf("task", t_ns, {{"result", std::string("pause")}});
    }
    takeTask(c);
    return {};
  }
  if (c == kEscape) {
    open_ = Open::none;
  } else if (c == '\n' || c == '\r') {
    std::optional<LogEvent> event;
    if (!text_.empty()) event = said();
    open_ = Open::none;
    return event;
  } else if (c == '\t') {
    constexpr int kSeverities = 5;
    severity_ = is_rated_ ? (severity_ + 1) % kSeverities : 0;
    is_rated_ = true;
  } else if (c == kBackspace || c == kDelete) {
    // A whole letter of UTF-8.
    while (!text_.empty() && (static_cast<unsigned char>(text_.back()) & 0xC0U) == 0x80U) text_.pop_back();
    if (!text_.empty()) text_.pop_back();
  } else if (text_.size() < kLongest && (static_cast<unsigned char>(c) >= ' ')) {
    if (text_.empty()) began_ns_ = t_ns;
    text_ += c;
  }
  return {};
}

std::string EvaluatorKeys::line() const {
  constexpr const char* kNames[] = {"",
                                    "behaviour",
                                    "comment",
                                    "task: 1 success 2 partly 3 failed 4 pause 5 next",
                                    "success",
                                    "partly",
                                    "failed",
                                    "help",
                                    "problem (name: sentence)",
                                    "withdrawn stream"};
  if (open_ == Open::none) return "";
  const std::string severity = is_rated_ ? " s" + std::to_string(severity_) : "";
  return std::string(kNames[static_cast<std::size_t>(open_)]) + severity + "> " + text_;
}

}  // namespace app
