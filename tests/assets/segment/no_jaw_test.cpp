#include <gtest/gtest.h>

#include "assets/segment/jaw_segmentation.h"
#include "tests/assets/segment/no_jaw_phantoms.h"

namespace {

class NoJaw : public testing::TestWithParam<unsigned> {};

/// Whatever is dense in it, nothing of a scan of another part of the body is taken for teeth.
TEST_P(NoJaw, IsRefused) {
  for (const tests::NoJawPhantom& phantom : tests::noJawPhantoms(GetParam())) {
    const assets::JawSegmentation jaw = assets::segmentJaw(phantom.grid, phantom.hounsfield);
    EXPECT_TRUE(jaw.refusal) << phantom.name << ": " << jaw.teeth.size() << " teeth";
  }
}

INSTANTIATE_TEST_SUITE_P(Scans, NoJaw, testing::Range(1u, 7u));

}  // namespace
