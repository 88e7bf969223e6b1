#include "app/calibrate/report/calibration_report.h"

#include <algorithm>
#include <cmath>
#include <optional>

#include "app/calibrate/report/report_views.h"
#include "app/report/drawing.h"
#include "app/report/html_page.h"
#include "app/report/markup.h"
#include "calibration/fit/expected_error_map.h"
#include "calibration/record/drift_review.h"

namespace app {
namespace {

using calibration::ArmModel;
using calibration::DriftEntry;
using calibration::Residual;
using calibration::RigRecord;
using calibration::Verdict;

constexpr std::size_t kMaxAlarms = 10;

/// A shape of its own for each verdict.
std::string symbolOf(const std::optional<Verdict>& verdict) {
  Drawing drawing({44.0, 44.0});
  if (!verdict)
    drawing.outline({4.0, 4.0}, {36.0, 36.0}, 3.0, paper::kQuiet, {6.0, 4.0});
  else if (*verdict == Verdict::green)
    drawing.disc({22.0, 22.0}, 19.0, paper::kGreen);
  else if (*verdict == Verdict::amber)
    drawing.polygon({{22.0, 3.0}, {42.0, 40.0}, {2.0, 40.0}}, paper::kAmber);
  else
    drawing.box({4.0, 4.0}, {36.0, 36.0}, paper::kOrange);
  return drawing.markup("");
}

std::string wordsOf(const std::optional<Verdict>& verdict) {
  if (!verdict) return "Not verified: verify it with touches that were not fitted";
  if (*verdict == Verdict::green) return "Green: use it";
  if (*verdict == Verdict::amber) return "Amber: usable, with a larger error than intended";
  return "Red: locked on a real device, calibrate again";
}

std::string sentence(std::string clause) {
  if (clause.empty()) return clause;
  if (clause[0] >= 'a' && clause[0] <= 'z') clause[0] = static_cast<char>(clause[0] - 'a' + 'A');
  return clause + ".";
}

/// "worst: back left low, 0.9 mm" as a sentence of its own.
std::string worstOf(const RigRecord& record) {
  std::string worst = record.verification ? record.verification->worst : "";
  const bool held_out = record.verification && !record.verification->residuals.empty();
  const std::vector<Residual>& touches = held_out ? record.verification->residuals : record.residuals;
  if (worst.empty() && !touches.empty()) worst = calibration::worstErrorSentence(touches, {});
  return sentence(worst);
}

/// The error of one touch, from the residual of the fit (reference/calibration 4.1).
double touchError_mm(const calibration::RigProcedure& procedure, double used) {
  const double parameters = procedure.model == ArmModel::rigid ? 6.0 : procedure.model == ArmModel::full ? 28.0 : 15.0;
  const double freedom = 1.0 - parameters / (3.0 * used);
  // With nearly as many parameters as data the residual is meaningless.
  return freedom > 0.3 ? procedure.fre_rms_mm / std::sqrt(freedom) : procedure.cv_rms_mm;
}

void addMap(HtmlPage& page, const RigRecord& record) {
  std::vector<calibration::Point<calibration::World>> touches_W;
  for (const Residual& one : record.residuals)
    if (one.used) touches_W.push_back(one.target_W);
  if (touches_W.size() < 4 || !record.procedure) return;
  const double fle_mm = touchError_mm(*record.procedure, static_cast<double>(touches_W.size()));
  if (!(fle_mm > 0.0)) return;
  const calibration::ExpectedErrorMap expected(touches_W, fle_mm);
  page.section(
      "Where more touches would help",
      figureMarkup(errorMapView([&](const auto& position_W) { return expected.at_mm(position_W); }, touches_W),
                   "Expected error over the plane through the site (z = 0), from the positions of the touches and "
                   "a random error of " +
                       fixedText(fle_mm, 2) +
                       " mm per touch (Fitzpatrick 1998). Random errors only: errors that the model of the arm "
                       "cannot express are in the figures above."));
}

void addHistory(HtmlPage& page, const std::vector<DriftEntry>& history) {
  const calibration::DriftReview review = calibration::reviewOf(history);
  std::string content = "<p>" + escaped(review.sentence) + "</p>\n";
  if (history.empty()) return page.section("History", content);
  std::string drawings;
  for (const calibration::DriftQuantity quantity : calibration::kDriftQuantities)
    drawings += historyView(history, review, quantity);
  content += figureMarkup(
      drawings,
      "Errors before any correction: dots are checks, squares re-zeros, black dots calibrations with their "
      "held-out error. Green: mean; dashed: 3 \u03c3; dotted: 2 \u03c3, of at most the first twenty checks "
      "since the calibration. Ringed: alarms by the Western Electric rules.");
  if (!review.alarms.empty()) {
    content += "<p>Alarms since the last calibration" +
               std::string(review.alarms.size() > kMaxAlarms ? ", the newest ten" : "") + ":</p>\n<ul>\n";
    for (std::size_t i = review.alarms.size() - std::min(review.alarms.size(), kMaxAlarms); i < review.alarms.size();
         ++i)
      content += "<li>" + escaped(review.alarms[i].sentence) + "</li>\n";
    content += "</ul>\n";
  }
  page.section("History", content);
}

std::string subtitle(const RigRecord& record) {
  std::string line;
  const auto add = [&](const std::string& part) {
    if (!part.empty()) line += (line.empty() ? "" : " \u00b7 ") + escaped(part);
  };
  if (record.rig.device) {
    add(record.rig.device->model + " " + record.rig.device->serial);
    if (!record.rig.device->mount.empty()) add("mount: " + record.rig.device->mount);
  }
  add(timeText(record.provenance.created_utc));
  if (record.procedure) add(record.procedure->method);
  return line;
}

std::string verdictBox(const RigRecord& record) {
  std::optional<Verdict> verdict;
  if (record.verification) verdict = record.verification->verdict;
  std::string box = "<div class=\"verdict\">\n" + symbolOf(verdict) + "<div><b>" + escaped(wordsOf(verdict)) +
                    ".</b><br>" + escaped(worstOf(record));
  if (record.verification)
    box += "<br><span class=\"quiet\">" +
           escaped(sentence(calibration::assess(record.verification->errors, record.verification->kind).reason)) +
           "</span>";
  return box + "</div>\n</div>\n";
}

}  // namespace

std::string reportHtml(const RigRecord& record, const std::vector<DriftEntry>& history, const std::string& now_utc) {
  const std::string name = record.provenance.rig_id.empty() ? "a rig" : record.provenance.rig_id;
  HtmlPage page("Calibration of " + name, subtitle(record));
  page.add(verdictBox(record));
  page.section("Accuracy", figuresTable(record));
  const std::vector<Residual> none;
  const std::vector<Residual>& held_out = record.verification ? record.verification->residuals : none;
  if (!record.residuals.empty() || !held_out.empty())
    page.section(
        "Where the error is",
        figureMarkup(residualViews(record.residuals, held_out),
                     "Each arrow points from the touched target to the tip as computed by the arm. Parallel arrows "
                     "mean a shift, arrows around a centre a rotation, unordered arrows random error."));
  addMap(page, record);
  addHistory(page, history);
  page.section("Touches set aside", outliersTable(record));
  page.section("Origin", originTable(record, now_utc));
  return page.text(
      "Frame W: origin in the middle of the virtual screen, x to the right, y up, z towards the viewer. A training "
      "device, not a clinical one.");
}

}  // namespace app
