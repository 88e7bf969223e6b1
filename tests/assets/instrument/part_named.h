// A part of a model by its name.
#pragma once

#include <algorithm>
#include <string>

#include <gtest/gtest.h>

#include "assets/mesh.h"

namespace tests {

inline const assets::MeshPart& partNamed(const assets::MeshModel& model, const std::string& name) {
  const auto found = std::ranges::find(model.parts, name, &assets::MeshPart::name);
  EXPECT_NE(found, model.parts.end()) << name;
  return *found;
}

}  // namespace tests
