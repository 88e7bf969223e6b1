#include "app/debrief/bookmarks.h"

#include <algorithm>
#include <cmath>
#include <filesystem>
#include <fstream>
#include <iterator>

#include <fmt/core.h>
#include <nlohmann/json.hpp>

#include "app/session/session_error.h"
#include "assets/json_depth.h"
#include "calibration/output_file.h"

namespace app {
namespace {

using nlohmann::json;

constexpr std::uintmax_t kMostBytes = std::uintmax_t{2} << 20;
constexpr double kLongest_s = 1e6, kSamePlace_s = 0.05, kNear_s = 0.5;

/// Bytes of the letter that begins here; 0: it is none.
std::size_t letterBytes(const std::string& text, std::size_t at) {
  const auto first = static_cast<unsigned char>(text[at]);
  const std::size_t bytes = first < 0x80   ? 1
                            : first < 0xc2 ? 0
                            : first < 0xe0 ? 2
                            : first < 0xf0 ? 3
                            : first < 0xf5 ? 4
                                           : 0;
  if (bytes == 0 || at + bytes > text.size()) return 0;
  for (std::size_t n = 1; n < bytes; ++n)
    if ((static_cast<unsigned char>(text[at + n]) & 0xc0) != 0x80) return 0;
  return bytes;
}

[[noreturn]] void refuse(const std::string& file, const std::string& why) {
  throw SessionError(file + ": " + why + ": it is not a file of bookmarks, move it away", SessionErrorKind::refused);
}

std::string bytesIn(const std::string& file) {
  std::error_code failed;
  if (!std::filesystem::is_regular_file(file, failed)) refuse(file, "is not a plain file");
  if (std::filesystem::file_size(file, failed) > kMostBytes || failed) refuse(file, "is too large");
  std::ifstream in(file, std::ios::binary);
  return {std::istreambuf_iterator<char>(in), {}};
}

Bookmark bookmarkFrom(const json& one, const std::string& file) {
  if (!one.is_object() || !one.contains("t_s") || !one["t_s"].is_number()) refuse(file, "a bookmark has no t_s");
  const auto t_s = one["t_s"].get<double>();
  if (!(t_s >= 0.0) || t_s > kLongest_s) refuse(file, "a bookmark has no time of a session");
  const bool has_note = one.contains("note") && one["note"].is_string();
  return {t_s, has_note ? plainNote(one["note"].get<std::string>()) : std::string()};
}

}  // namespace

std::string plainNote(const std::string& text) {
  std::string plain;
  std::size_t letters = 0;
  for (std::size_t at = 0; at < text.size() && letters < Bookmarks::kMostLetters;) {
    const std::size_t bytes = letterBytes(text, at);
    const bool is_control = bytes == 1 && (static_cast<unsigned char>(text[at]) < 0x20 || text[at] == 0x7f);
    if (bytes > 0 && !is_control) plain.append(text, at, bytes), ++letters;
    at += std::max<std::size_t>(1, bytes);
  }
  return plain;
}

std::string Bookmarks::fileFor(const std::string& session) {
  constexpr std::string_view kEnding = ".molar";
  std::string name = session;
  if (name.ends_with(kEnding)) name.resize(name.size() - kEnding.size());
  return name + ".bookmarks.json";
}

Bookmarks::Bookmarks(std::string file) : file_(std::move(file)) {
  std::error_code failed;
  if (!std::filesystem::exists(file_, failed)) return;
  const std::string text = bytesIn(file_);
  if (assets::isNestedTooDeep(text)) refuse(file_, "is nested too deep");
  const json read = json::parse(text, nullptr, false);
  if (!read.is_object() || !read.contains("molar_bookmarks") || !read.contains("bookmarks") ||
      !read["bookmarks"].is_array())
    refuse(file_, "holds no bookmarks");
  if (read["bookmarks"].size() > kMost) refuse(file_, fmt::format("holds more than {} bookmarks", kMost));
  for (const json& one : read["bookmarks"]) all_.push_back(bookmarkFrom(one, file_));
  std::ranges::stable_sort(all_, {}, &Bookmark::t_s);
}

bool Bookmarks::set(double t_s, const std::string& note) {
  const auto same =
      std::ranges::find_if(all_, [&](const Bookmark& one) { return std::abs(one.t_s - t_s) < kSamePlace_s; });
  if (same != all_.end()) {
    same->note = plainNote(note);
    return true;
  }
  if (all_.size() >= kMost) return false;
  all_.insert(std::ranges::upper_bound(all_, t_s, {}, &Bookmark::t_s), {t_s, plainNote(note)});
  return true;
}

bool Bookmarks::removeAt(double t_s) {
  const auto nearest = std::ranges::min_element(all_, {}, [&](const Bookmark& one) { return std::abs(one.t_s - t_s); });
  if (nearest == all_.end() || std::abs(nearest->t_s - t_s) > kNear_s) return false;
  all_.erase(nearest);
  return true;
}

void Bookmarks::save() const {
  json list = json::array();
  for (const Bookmark& one : all_) list.push_back({{"t_s", std::round(1e3 * one.t_s) / 1e3}, {"note", one.note}});
  calibration::OutputFile(file_, true)
      .commit(json{{"molar_bookmarks", 1}, {"bookmarks", list}}.dump(1, ' ', false, json::error_handler_t::replace) +
              "\n");
}

}  // namespace app
