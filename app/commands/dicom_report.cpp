#include "app/commands/dicom_report.h"

#include <fmt/core.h>
#include <nlohmann/json.hpp>

namespace app {
namespace {

using Json = nlohmann::json;

Json orNull(const std::string& text) { return text.empty() ? Json(nullptr) : Json(text); }

Json jsonOf(const assets::DicomSurvey& survey, std::size_t n) {
  const assets::DicomSeries& series = survey.sorted.series[n];
  const assets::DicomHeader& header = survey.folder.files[series.slices.front().file].header;
  Json out{{"number", n + 1},
           {"taken", survey.taken == n},
           {"slices", series.slices.size()},
           {"columns", series.columns},
           {"rows", series.rows},
           {"joined", series.joined},
           {"packing", std::string(header.syntax->name)},
           {"modality", orNull(header.modality)},
           {"manufacturer", orNull(header.manufacturer)},
           {"model", orNull(header.model)},
           {"kernel", orNull(header.kernel)}};
  out["row_spacing_mm"] = out["column_spacing_mm"] = out["step_mm"] = out["tilt_deg"] = nullptr;
  if (series.spacing_mm) out["row_spacing_mm"] = series.spacing_mm->x, out["column_spacing_mm"] = series.spacing_mm->y;
  if (series.stack.step_mm > 0.0) {
    out["step_mm"] = series.stack.step_mm;
    out["tilt_deg"] = series.stack.tilt_deg;
  }
  return out;
}

}  // namespace

std::string dicomReportJson(const assets::DicomSurvey& survey) {
  const assets::DicomCounts& counts = survey.sorted.counts;
  Json series = Json::array(), verdicts = Json::array();
  for (std::size_t n = 0; n < survey.sorted.series.size(); ++n) series.push_back(jsonOf(survey, n));
  for (const assets::DicomVerdict& verdict : survey.verdicts)
    verdicts.push_back(
        {{"code", verdict.code}, {"sentence", verdict.sentence}, {"files", verdict.files}, {"stops", verdict.stops}});
  const Json out{{"kind", "dicom"},
                 {"files", counts.files},
                 {"passed_over",
                  {{"left_out", counts.left_out},
                   {"not_dicom", counts.not_dicom},
                   {"no_image", counts.not_images},
                   {"localizer", counts.localizers},
                   {"capture", counts.captures},
                   {"other_modality", counts.other_modalities},
                   {"small", counts.small}}},
                 {"series", series},
                 {"verdicts", verdicts},
                 {"can_be_imported", survey.refusal() == nullptr}};
  return out.dump(2) + "\n";
}

std::string dicomReportText(const assets::DicomSurvey& survey) {
  std::string text;
  for (std::size_t n = 0; n < survey.sorted.series.size(); ++n) {
    const assets::DicomSeries& series = survey.sorted.series[n];
    const std::string pixel =
        series.spacing_mm ? fmt::format("{:.3f} x {:.3f} mm", series.spacing_mm->y, series.spacing_mm->x) : "unknown";
    const std::string step = series.stack.step_mm > 0.0 ? fmt::format("{:.3f} mm", series.stack.step_mm) : "unknown";
    text += fmt::format("{} volume {}   {} x {} x {} voxels, pixel {}, step {}, {}\n", survey.taken == n ? "*" : " ",
                        n + 1, series.columns, series.rows, series.slices.size(), pixel, step,
                        survey.folder.files[series.slices.front().file].header.syntax->name);
  }
  for (const assets::DicomVerdict& verdict : survey.verdicts)
    text += fmt::format("{} {}   {}\n", verdict.stops ? "!" : " ", verdict.code, assets::lineOf(verdict));
  if (survey.refusal() == nullptr) text += "can be imported\n";
  return text;
}

}  // namespace app
