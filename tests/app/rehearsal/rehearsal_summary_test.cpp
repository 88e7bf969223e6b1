#include "app/rehearsal/rehearsal_summary.h"

#include <gtest/gtest.h>

namespace app {
namespace {

TEST(RehearsalSummary, ExitsWithOneWhereARecordingIsNotWhole) {
  RehearsalFigures figures;
  EXPECT_EQ(exitStatus(figures), 0) << "none was requested";
  figures.recording = RecordingSummary{1000, 0, std::nullopt};
  EXPECT_EQ(exitStatus(figures), 0);
  figures.recording->lost = 1;
  EXPECT_EQ(exitStatus(figures), 1);
  figures.recording = RecordingSummary{1000, 0, "the disk is full"};
  EXPECT_EQ(exitStatus(figures), 1);
}

RehearsalFigures afterWork() {
  RehearsalFigures figures;
  figures.last.patient_title = "block of bone";
  figures.last.command.tool.head = {haptics::ShapeKind::sphere, 1.5, 0.0};
  figures.last.tick.t_s = 71.999;
  figures.last.tick.dt_s = 0.001;
  figures.last.quality = "as requested";
  figures.removed_mm3[1] = 4.0;
  figures.removed_mm3[4] = 0.5;
  figures.removed_mm3[9] = 3.0;  // gingiva: counted in the scan's voxels, none that a surgeon sees
  figures.times = {31.0, 12.0};
  figures.touched = {{"lower right second molar", 2, 0.83}, {"mandibular canal", 1, 0.1}};
  figures.warnings = {{"cutting dry", 3}, {"force limited", 1}};
  figures.recording = RecordingSummary{12000, 3, std::nullopt, "s.molar.new"};
  return figures;
}

TEST(RehearsalSummary, AnswersTheSurgeonFirst) {
  RehearsalFigures figures = afterWork();
  figures.for_engineers = false;
  EXPECT_EQ(summaryText(figures),
            "Rehearsal\n"
            "  patient          block of bone\n"
            "  instrument       round 3.0 mm, ISO 030\n"
            "  time             1:12, cutting 0:31, 0:12 of it without water\n"
            "  bone removed     4.0 mm³ (cortical bone 4.0)\n"
            "  tooth removed    0.5 mm³ (enamel 0.5)\n"
            "  touched          lower right second molar 2 times, 0.8 s; mandibular canal once, 0.1 s\n"
            "  warnings         cutting dry 3 times, force limited once\n"
            "  recorded in      s.molar.new, 3 ticks lost\n");
}

TEST(RehearsalSummary, EngineersFiguresFollowAfterALine) {
  RehearsalFigures figures = afterWork();
  figures.last.servo.watchdog_trips = 2;
  const std::string text = summaryText(figures), engineers = text.substr(text.find("\n\n"));
  for (const char* line : {"duration         72.0 s\n", "removed          7.5 mm³\n", "quality: as requested\n",
                           "recorded         12000 ticks, 3 lost\n", "switched the motors off 2 times"})
    EXPECT_NE(engineers.find(line), std::string::npos) << line << text;
  figures.has_motors = false;
  EXPECT_EQ(summaryText(figures).find("motors"), std::string::npos) << "there are none";
}

TEST(WorkTimes, CountCuttingAndCuttingWithoutWater) {
  WorkTimes times;
  haptics::Tick tick;
  tick.dt_s = 0.1;
  for (int n = 1; n <= 100; ++n) {
    tick.drilling = n > 20;
    tick.depth_mm = n > 40 ? 0.1 : 0.0;
    times.add(tick, n <= 70);
  }
  EXPECT_NEAR(times.cutting_s, 6.0, 1e-9);
  EXPECT_NEAR(times.dry_s, 3.0, 1e-9);
}

}  // namespace
}  // namespace app
