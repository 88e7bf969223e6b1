// Small text files: read, or refused in one line.
#include <gtest/gtest.h>

#include <functional>

#include "app/check_page/check_edits.h"
#include "app/device/falcon_scale_file.h"
#include "app/device/pose_csv.h"
#include "app/evaluation/script.h"
#include "app/evaluation/study_template.h"
#include "app/options/command_settings.h"
#include "app/options/jaw_clicks_file.h"
#include "app/options/view_option.h"
#include "app/procedure/coach/coach_file.h"
#include "app/procedure/steps/step_file.h"
#include "app/psychophysics/protocol.h"
#include "app/text/usage_error.h"
#include "assets/load_error.h"
#include "assets/patient/patient_toml.h"
#include "assets/scenery/face_placement.h"
#include "assets/toml_reader.h"
#include "calibration/calibration_error.h"
#include "calibration/fit/touches_file.h"
#include "calibration/record/drift_history.h"
#include "calibration/record/rig_file.h"
#include "tests/app/typed.h"
#include "tests/assets/scan_on_disk.h"
#include "tests/calibration/record/full_record.h"
#include "tests/mutants.h"
#include "tests/refusal.h"

namespace {

template <class Refusal>
void judge(const std::string& good, const std::function<void(const std::string&)>& read) {
  EXPECT_EQ(tests::refusalOf<Refusal>([&] { read(good); }), "accepted");
  std::uint64_t refused = 0, tried = 0;
  const auto judge_one = [&](const std::string& mutant, std::size_t, std::uint64_t) {
    ++tried;
    refused += tests::refusalOf<Refusal>([&] { read(mutant); }) == "accepted" ? 0 : 1;
  };
  mutants::forEachMutant({good}, 500, judge_one);
  if (tried >= mutants::kEnoughToJudge) {
    EXPECT_GT(refused, 0u);
  }
}

template <class Refusal>
void judgeFile(const std::string& name, const std::string& good,
               const std::function<void(const std::string& path)>& read) {
  const on_disk::Folder folder;
  judge<Refusal>(good, [&](const std::string& text) {
    on_disk::write(folder.at(name), text);
    read(folder.at(name));
  });
}

TEST(TextMutants, PatientToml) {
  assets::Patient patient;
  patient.title = "somebody";
  patient.site.emplace();
  patient.mandibular_canal_P_mm = {{1, 2, 3}, {4, 5, 6}};
  patient.mandibular_canal_radius_mm = 1.1;
  judge<assets::LoadError>(assets::patientToml(patient),
                           [](const std::string& text) { assets::patientFromToml(text, "patient.toml"); });
}

TEST(TextMutants, PoseCsv) {
  std::string good = "t_s,px_mm,py_mm,pz_mm,qw,qx,qy,qz,drill\n";
  for (int i = 0; i < 20; ++i) good += std::to_string(0.1 * i) + ",1.5,-2,3e1,1,0,0,0,1\n";
  judgeFile<app::UsageError>("p.csv", good, [](const std::string& path) { app::readPoses(path); });
}

TEST(TextMutants, ForceSettingsToml) {
  const haptics::Command base;
  judge<std::runtime_error>("[law]\nname = \"agus\"\nstiffness_N_per_mm = 0.8\n", [&](const std::string& text) {
    assets::TomlReader keys(text, "settings.toml");
    app::commandFromToml(keys, base);
    keys.refuseUnknownKeys();
  });
}

TEST(TextMutants, ProtocolToml) {
  judge<std::runtime_error>(
      "participant = \"P07\"\nmethod = \"2afc-constant\"\n[standard]\nlaw = \"agus\"\nstiffness_N_per_mm = "
      "0.8\n[comparison]\nlaw = \"agus\"\n[vary]\nparameter = \"stiffness_N_per_mm\"\nlevels = [0.6, 0.8, 1.0]\n",
      [](const std::string& text) { app::protocolFromToml(text, "protocol.toml"); });
}

TEST(TextMutants, ProcedureToml) {
  judge<assets::LoadError>(app::shippedProcedureText("coronectomy"),
                           [](const std::string& text) { app::stepPlanFromToml(text, "procedure.toml"); });
}

TEST(TextMutants, CoachToml) {
  judge<assets::LoadError>(app::shippedCoachText(),
                           [](const std::string& text) { app::coachRulesFromToml(text, "coach.toml"); });
}

const std::string kStudyTemplate =
    "title = \"T\"\nlanguage = \"en\"\nconsent = \"c.md\"\norder = \"latin-square\"\n[[prompt]]\nid = \"why\"\n"
    "say = \"Why?\"\n[[task]]\nid = \"cut\"\nsay = \"Cut\"\ntool = \"round:3.0\"\ntime_box_s = 60\nsuccess = "
    "\"O1.removed >= 2 mm3 and not (S1.canal < 1.5 mm or pieces > 1)\"\nhold_s = 0.5\n[[questionnaire]]\nuse = "
    "\"sus\"\ngroups = [\"surgeon\"]\n";

TEST(TextMutants, StudyTemplateToml) {
  judge<assets::LoadError>(kStudyTemplate,
                           [](const std::string& text) { app::studyTemplateFrom(text, "template.toml"); });
}

TEST(TextMutants, EvaluationScript) {
  const app::StudyTemplate study = app::studyTemplateFrom(kStudyTemplate, "template.toml");
  judge<app::UsageError>(
      R"({"during": "cut", "at_s": 1.5, "type": "note", "for": ["P01"], "data": {"kind": "comment", "severity": 2}}
{"during": "consent", "type": "consent", "src": "participant", "data": {"stream": "log", "given": true}}
)",
      [&](const std::string& text) { app::EvaluationScript(text, "script.jsonl", study, "P01"); });
}

TEST(TextMutants, TouchesYaml) {
  judgeFile<calibration::CalibrationError>(
      "t.yaml",
      "%YAML:1.0\n---\ndevice_model: \"omni\"\nobservations:\n  - { id: 3, joints_rad: [0.1, 0.2, -0.3, 0.4, 0.5, "
      "0.6], p_W_mm: [1, 2.5, -3e1], used: 0 }\n  - { id: 4, joints_rad: [0, 0, 0, 0, 0, 0], p_W_mm: [10., 20., 30.] "
      "}\n",
      [](const std::string& path) { calibration::readTouches(path); });
}

TEST(TextMutants, CameraJson) {
  judgeFile<app::UsageError>(
      "camera.json", R"({"eye_mm": [-30, -80.5, 2e1], "look_at_mm": [0, 0, 0], "up": [0, 0, 1], "fov_y_deg": 30})",
      [](const std::string& path) {
        app::ViewOption view;
        tests::type("--camera " + path, [&](app::CommandLine& command) { view.addTo(command); });
        calibration::Rig rig;
        view.apply(rig, {{8, 8, 8}, 0.5, {0, 0, 0}});
      });
}

TEST(TextMutants, JawClicksJson) {
  judgeFile<app::UsageError>(
      "clicks.json",
      R"({"clicks": [{"edit": "number", "fdi": 48, "at_P_mm": [[1, -2.5, 3e1]]}, {"edit": "canal", "at_P_mm": [[0, 1, 2], [3, 4, 5]]},
{"edit": "two-teeth", "at_P_mm": [[0, 1, 2], [3, 4, 5]]}]})",
      [](const std::string& path) { app::readJawClicks(path); });
}

TEST(TextMutants, CheckPageEdits) {
  app::CheckEdits edits;
  edits.add(assets::ToothClick{.edit = assets::ToothEdit::number, .at_P_mm = {glm::dvec3(1.0, -2.5, 30.0)}, .fdi = 48});
  edits.add(app::CanalClicks{true, {{0.0, 1.0, 2.0}, {3.0, 4.0, 5.0}}});
  edits.add(app::CanalWord{true, false, 41.5});
  edits.undo();
  judge<app::UsageError>(edits.text(),
                         [](const std::string& text) { app::CheckEdits::fromText(text, "edits").clicks(); });
}

TEST(TextMutants, RigYaml) {
  judgeFile<calibration::CalibrationError>("rig.yaml", calibration::rigRecordText(calibration::fullRecord()),
                                           [](const std::string& path) { calibration::readRigRecord(path); });
}

TEST(TextMutants, DriftHistoryCsv) {
  const on_disk::Folder folder;
  calibration::appendHistory(folder.at("h.csv"), {"2026-11-22T08:20:00Z", calibration::DriftKind::check, 5, 0.25, {}});
  calibration::appendHistory(folder.at("h.csv"), {"2026-11-23T08:20:00Z", calibration::DriftKind::rezero, 8, 1.5, {}});
  judgeFile<calibration::CalibrationError>("history.csv", on_disk::read(folder.at("h.csv")),
                                           [](const std::string& path) { calibration::readHistory(path); });
}

TEST(TextMutants, FalconScaleToml) {
  const on_disk::Folder folder;
  app::writeFalconScale(folder.at("f.toml"), {12.5, 0.98, "FH000001"}, false);
  judgeFile<std::runtime_error>("falcon.toml", on_disk::read(folder.at("f.toml")),
                                [](const std::string& path) { app::readFalconScale(path); });
}

TEST(TextMutants, TeethJson) {
  std::string good = "{";
  for (int tooth = 1; tooth <= 8; ++tooth)
    good += "\"LR" + std::to_string(tooth) + "\": {\"open_mean_m\": [0.01, -0.02, 0.0" + std::to_string(tooth) + "]}" +
            (tooth < 8 ? ", " : "}");
  judgeFile<assets::LoadError>("teeth.json", good, [](const std::string& path) { assets::readFaceTeeth(path); });
}

}  // namespace
