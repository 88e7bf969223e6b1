#include "app/report/html_page.h"

#include "app/report/markup.h"

namespace app {
namespace {

constexpr const char* kStyle = R"(
body { font: 15px/1.45 "DejaVu Sans", Helvetica, Arial, sans-serif; color: #222; background: #fff;
       max-width: 800px; margin: 24px auto; padding: 0 16px; }
h1 { font-size: 24px; margin: 0 0 4px; }
h2 { font-size: 17px; margin: 28px 0 6px; border-bottom: 1px solid #ccc; padding-bottom: 3px; }
.verdict { display: flex; align-items: center; gap: 16px; border: 2px solid #222; border-radius: 6px;
           padding: 12px 16px; margin: 14px 0; break-inside: avoid; }
.beside { display: grid; grid-template-columns: repeat(auto-fit, minmax(min(340px, 100%), 1fr)); gap: 10px 16px; }
.beside .verdict, .beside figure { margin: 0; }
figure:target { grid-column: 1 / -1; outline: 3px solid #0072b2; outline-offset: 4px; scroll-margin-top: 8px; }
li:target { font-weight: bold; }
ol.columns { columns: 300px 2; column-gap: 24px; margin: 6px 0; padding-left: 28px; font-size: 14px; }
ol.columns li { break-inside: avoid; }
a { color: #0072b2; }
.verdict svg { flex: none; }
.verdict b { font-size: 20px; }
.quiet { color: #666; }
.unconfirmed, .unconfirmed b { color: #757575; font-style: italic; }
p.unconfirmed { border-left: 4px solid #9a9a9a; padding-left: 10px; }
table { border-collapse: collapse; width: 100%; font-size: 14px; margin: 0 0 14px; }
th { text-align: left; font-weight: normal; color: #666; }
th, td { padding: 3px 10px 3px 0; border-bottom: 1px solid #e4e4e4; vertical-align: top; }
td:nth-child(2) { white-space: normal; }
code { font-size: 11px; overflow-wrap: anywhere; }
.green { color: #00704f; } .amber { color: #9a5b00; } .red { color: #b03a00; font-weight: bold; }
figure { margin: 8px 0; break-inside: avoid; }
figure svg { max-width: 100%; height: auto; display: block; }
figcaption { font-size: 13px; color: #444; }
ul { margin: 6px 0; padding-left: 20px; }
h2, h3 { break-after: avoid; } h2, h3, tr { break-inside: avoid; }
@media print {
  body { margin: 0; max-width: none; font-size: 12px; } @page { size: A4; margin: 14mm; }
  table { font-size: 11px; } th, td { padding: 2px 8px 2px 0; } h2 { margin: 18px 0 4px; }
  .beside { grid-template-columns: 1fr 1fr; } .verdict { padding: 8px 12px; } a { color: inherit; }
  ol.columns { font-size: 11px; }
  .pairs figure { width: 134mm; margin: 4px auto; } section:last-of-type { break-inside: avoid; }
}
)";

}  // namespace

HtmlPage::HtmlPage(std::string_view title_words, const std::string& below_markup) : title_(escaped(title_words)) {
  body_ = "<h1>" + title_ + "</h1>\n<p class=\"quiet\">" + below_markup + "</p>\n";
}

void HtmlPage::section(std::string_view title_words, const std::string& content_markup) {
  if (content_markup.empty()) return;
  body_ += "<section>\n<h2>" + escaped(title_words) + "</h2>\n" + content_markup + "</section>\n";
}

std::string HtmlPage::text(std::string_view note_words) const {
  return "<!DOCTYPE html>\n<html lang=\"en\">\n<head>\n<meta charset=\"utf-8\">\n"
         "<meta http-equiv=\"Content-Security-Policy\" content=\"default-src 'none'; style-src 'unsafe-inline'; "
         "img-src data:\">\n<title>" +
         title_ + "</title>\n<style>" + kStyle + "</style>\n</head>\n<body>\n" + body_ + "<p class=\"quiet\">" +
         escaped(note_words) + "</p>\n</body>\n</html>\n";
}

std::string figureMarkup(const std::string& drawing, const std::string& caption_markup) {
  return "<figure>\n" + drawing + "<figcaption>" + caption_markup + "</figcaption>\n</figure>\n";
}

std::string tableMarkup(const std::vector<std::string>& heads, const std::vector<std::vector<std::string>>& rows) {
  std::vector<std::vector<std::string>> rows_markup = rows;
  for (std::vector<std::string>& row : rows_markup)
    for (std::string& cell : row) cell = escaped(cell);
  return tableOfMarkup(heads, rows_markup);
}

std::string tableOfMarkup(const std::vector<std::string>& heads,
                          const std::vector<std::vector<std::string>>& rows_markup) {
  std::string table = "<table>\n";
  if (!heads.empty()) {
    // A head of its own: print repeats it on every page.
    table += "<thead><tr>";
    for (const std::string& head : heads) table += "<th>" + escaped(head) + "</th>";
    table += "</tr></thead>\n";
  }
  for (const std::vector<std::string>& row : rows_markup) {
    table += "<tr>";
    for (const std::string& cell : row) table += "<td>" + cell + "</td>";
    table += "</tr>\n";
  }
  return table + "</table>\n";
}

}  // namespace app
