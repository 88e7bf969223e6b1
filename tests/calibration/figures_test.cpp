#include <gtest/gtest.h>

#include "tests/bench/calibration/figures.h"

namespace bench {
namespace {

/// The benchmark's figures over few of its rigs: the same seeds, the same limits.
constexpr int kRigs = 12;

void expectAll(const Figures& figures) {
  for (const Figure& figure : figures)
    EXPECT_TRUE(figure.holds) << figure.what << ": asked " << figure.asked << ", measured " << figure.measured;
}

TEST(CalibrationFigures, HoldForTheJig) { expectAll(jigFigures(kRigs)); }
TEST(CalibrationFigures, AreForetoldByCrossValidation) { expectAll(crossValidationFigures(kRigs)); }
TEST(CalibrationFigures, AreNotChangedByASlip) { expectAll(outlierFigures(kRigs)); }
TEST(CalibrationFigures, HoldForCrossesAimedAtByEye) { expectAll(visualFigures(kRigs)); }
TEST(CalibrationFigures, ComeBackWithFiveTouches) { expectAll(rezeroFigures(kRigs)); }
TEST(CalibrationFigures, AreNotReachedUnnoticedByAFlipOrOneTilt) { expectAll(guardFigures(kRigs)); }
TEST(CalibrationFigures, HoldForWhatIsSeen) { expectAll(seenFigures(kRigs)); }
TEST(CalibrationFigures, HoldForTheWebcam) { expectAll(webcamFigures(kRigs)); }

}  // namespace
}  // namespace bench
