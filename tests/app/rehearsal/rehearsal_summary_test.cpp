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

TEST(RehearsalSummary, ShowsTheStateAtTheEnd) {
  RehearsalFigures figures;
  figures.last.patient_title = "block of bone";
  figures.last.bur = "sphere:1.5";
  figures.last.tick.t_s = 11.999;
  figures.last.tick.dt_s = 0.001;
  figures.last.quality = "as requested";
  figures.removed_mm3[1] = 4.0;
  figures.recording = RecordingSummary{12000, 3, std::nullopt, "s.molar.new"};
  const std::string text = summaryText(figures);
  for (const char* line : {"patient          block of bone\n", "bur              sphere:1.5 mm\n",
                           "duration         12.0 s\n", "removed          4.0 mm³\n", "quality: as requested\n",
                           "recorded         12000 ticks, 3 lost, in s.molar.new\n"})
    EXPECT_NE(text.find(line), std::string::npos) << line << text;
}

}  // namespace
}  // namespace app
