#include <gtest/gtest.h>

#include "tests/bench/calibration/figures.h"

namespace bench {
namespace {

/// The benchmark's figures over fewer rigs: the same seeds, the same limits.
constexpr int kRigs = 12;

void expectAll(const Figures& figures) {
  for (const Figure& figure : figures)
    EXPECT_TRUE(figure.holds) << figure.what << ": asked " << figure.asked << ", measured " << figure.measured;
}

TEST(CalibrationFigures, HoldForTheJig) { expectAll(jigFigures(kRigs)); }
TEST(CalibrationFigures, ArePredictedByCrossValidation) { expectAll(crossValidationFigures(kRigs)); }
TEST(CalibrationFigures, AreNotChangedByAnOutlier) { expectAll(outlierFigures(kRigs)); }
TEST(CalibrationFigures, HoldForCrossesAimedAtByEye) { expectAll(visualFigures(kRigs)); }
TEST(CalibrationFigures, AreRestoredByFiveTouches) { expectAll(rezeroFigures(kRigs)); }
TEST(CalibrationFigures, DetectAFlipAndASingleTilt) { expectAll(guardFigures(kRigs)); }
TEST(CalibrationFigures, HoldForTheSeenError) { expectAll(seenFigures(kRigs)); }
TEST(CalibrationFigures, HoldForTheWebcam) { expectAll(webcamFigures(kRigs)); }

}  // namespace
}  // namespace bench
