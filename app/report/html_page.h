// A report as one HTML file: no other file, no script, readable in print and without colour. Text given as `words` is
// escaped here; as `markup` it is taken as it is. Pure; any thread.
#pragma once

#include <string>
#include <string_view>
#include <vector>

namespace app {

class HtmlPage {
 public:
  /// `below_markup`: a quiet line under the title.
  HtmlPage(std::string_view title_words, const std::string& below_markup);

  void add(const std::string& markup) { body_ += markup; }
  /// Nothing where there is no content.
  void section(std::string_view title_words, const std::string& content_markup);
  /// The whole file. `note_words`: a quiet last line.
  std::string text(std::string_view note_words) const;

 private:
  std::string title_, body_;
};

/// A drawing with its caption below it.
std::string figureMarkup(const std::string& drawing, const std::string& caption_markup);

/// A table of words, one row of heads above; no heads: none.
std::string tableMarkup(const std::vector<std::string>& heads, const std::vector<std::vector<std::string>>& rows);
/// The same of cells that are markup.
std::string tableOfMarkup(const std::vector<std::string>& heads,
                          const std::vector<std::vector<std::string>>& rows_markup);

}  // namespace app
