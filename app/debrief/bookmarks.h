// Bookmarks with a note that supervisor or surgeon set in a recorded session, in a file beside it:
// NAME.bookmarks.json, {"molar_bookmarks": 1, "bookmarks": [{"t_s": 12.5, "note": "too close to the canal"}]}. The
// session itself is never changed. A file may be a stranger's: whatever its bytes, reading gives bookmarks or throws
// SessionError, one line. Any thread; milliseconds.
#pragma once

#include <string>
#include <vector>

namespace app {

struct Bookmark {
  double t_s = 0.0;
  std::string note;  ///< one line of UTF-8; may be empty

  bool operator==(const Bookmark&) const = default;
};

class Bookmarks {
 public:
  static constexpr std::size_t kMost = 1000, kMostLetters = 300;

  /// Beside the session.
  static std::string fileFor(const std::string& session);

  /// Of a file that need not exist.
  explicit Bookmarks(std::string file);

  /// In order of time.
  const std::vector<Bookmark>& all() const { return all_; }
  /// Replaces one at the same tenth of a second. Control characters and what is too long are left out. False: there are
  /// kMost.
  bool set(double t_s, const std::string& note);
  /// The nearest within half a second of a moment; false: there is none.
  bool removeAt(double t_s);
  /// Whole or not at all. Throws CalibrationError: no right, no space.
  void save() const;

  const std::string& file() const { return file_; }

 private:
  std::string file_;
  std::vector<Bookmark> all_;
};

/// Without control characters, invalid UTF-8 and what is beyond kMostLetters.
std::string plainNote(const std::string& text);

}  // namespace app
