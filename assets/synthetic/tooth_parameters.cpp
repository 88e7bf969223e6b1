#include "assets/synthetic/tooth_parameters.h"

#include <algorithm>
#include <cassert>

namespace assets {
namespace {

ToothParameters firstPremolar() {
  ToothParameters form;
  form.mesial_mm = {{-2.0, 2.2}, {0.0, 2.5}, {3.0, 3.1}, {5.2, 3.45}, {7.0, 3.0}, {9.0, 2.2}};
  form.distal_mm = {{-2.0, 2.2}, {0.0, 2.5}, {3.0, 3.1}, {4.9, 3.5}, {7.0, 3.0}, {9.0, 2.2}};
  form.buccal_mm = {{-2.0, 3.2}, {0.0, 3.5}, {2.5, 4.1}, {5.0, 3.7}, {7.0, 2.7}, {8.6, 1.6}};
  form.lingual_mm = {{-2.0, 3.0}, {0.0, 3.2}, {3.0, 3.5}, {4.5, 3.6}, {6.0, 3.2}, {8.0, 2.4}};
  form.squareness = 2.25;
  form.cusps = {{{0.1, 0.8}, 8.5, 0.66, 0.0}, {{-0.2, -2.5}, 5.7, 0.5, 0.0}};
  form.ridges = {{{2.3, 0.2}, {1.2, -2.4}, 5.1}, {{-2.4, 0.3}, {-1.4, -2.4}, 5.3}, {{0.1, 0.8}, {0.0, -2.2}, 5.2}};
  form.grooves = {{-1.0, 0.06, 0.25}};
  form.roots = {{{0.0, 0.0}, {-1.0, -0.1}, 14.0, {2.45, 3.3}, {0.7, 0.8}, 0.35, 0.06, 1}};
  return form;
}

ToothParameters secondPremolar() {
  ToothParameters form;
  form.mesial_mm = {{-2.0, 2.3}, {0.0, 2.6}, {3.0, 3.3}, {5.0, 3.55}, {7.0, 3.05}, {9.0, 2.4}};
  form.distal_mm = {{-2.0, 2.3}, {0.0, 2.6}, {3.0, 3.3}, {4.7, 3.55}, {7.0, 3.05}, {9.0, 2.4}};
  form.buccal_mm = {{-2.0, 3.4}, {0.0, 3.7}, {2.5, 4.3}, {5.0, 3.9}, {7.0, 3.0}, {8.5, 2.0}};
  form.lingual_mm = {{-2.0, 3.3}, {0.0, 3.5}, {3.0, 4.0}, {4.7, 4.0}, {6.5, 3.4}, {8.5, 2.4}};
  form.squareness = 2.4;
  form.cusps = {{{0.2, 1.6}, 8.0, 0.62, 0.0}, {{1.4, -2.3}, 7.2, 0.7, 0.3}, {{-1.7, -2.2}, 6.8, 0.7, -0.3}};
  form.ridges = {{{2.7, 1.0}, {2.6, -1.6}, 6.0}, {{-2.7, 1.0}, {-2.7, -1.5}, 5.8}};
  form.grooves = {{-1.5, 0.06, 0.2}};
  form.roots = {{{0.0, 0.0}, {-1.3, 0.0}, 14.3, {2.55, 3.5}, {0.7, 0.9}, 0.4, 0.05, 1}};
  return form;
}

ToothParameters firstMolar() {
  ToothParameters form;
  form.mesial_mm = {{-2.0, 4.3}, {0.0, 4.6}, {2.5, 5.2}, {4.8, 5.6}, {6.3, 5.1}, {8.0, 4.2}};
  form.distal_mm = {{-2.0, 4.2}, {0.0, 4.5}, {2.5, 5.1}, {4.5, 5.55}, {6.0, 5.0}, {8.0, 4.0}};
  form.buccal_mm = {{-2.0, 4.1}, {0.0, 4.5}, {2.0, 5.3}, {4.0, 5.1}, {6.0, 4.5}, {7.5, 3.6}};
  form.lingual_mm = {{-2.0, 4.0}, {0.0, 4.3}, {2.5, 4.9}, {4.0, 5.0}, {6.0, 4.6}, {8.0, 3.7}};
  form.squareness = 2.9;
  form.cusps = {{{2.65, 2.7}, 7.2, 0.72, 0.10},
                {{-0.75, 2.95}, 7.0, 0.74, -0.08},
                {{-3.7, 1.7}, 6.4, 0.72, -0.55},
                {{2.45, -2.75}, 7.6, 0.74, 0.12},
                {{-2.15, -2.8}, 7.4, 0.74, -0.12}};
  form.ridges = {{{4.4, 1.2}, {4.4, -1.8}, 5.9}, {{-4.5, 0.3}, {-4.1, -1.9}, 5.6}};
  form.grooves = {{1.19, 0.085, 0.13}, {2.34, 0.08, 0.14}, {-1.53, 0.075, 0.14}};
  form.roots = {{{2.35, 0.0}, {1.7, -0.1}, 13.6, {2.25, 4.0}, {0.75, 1.5}, 1.15, 0.20, 2},
                {{-2.35, 0.0}, {-4.0, 0.1}, 12.8, {2.15, 3.75}, {0.75, 1.15}, 0.35, 0.12, 1}};
  return form;
}

ToothParameters secondMolar() {
  ToothParameters form;
  form.mesial_mm = {{-2.0, 4.2}, {0.0, 4.5}, {2.5, 5.0}, {4.6, 5.3}, {6.0, 4.9}, {8.0, 4.0}};
  form.distal_mm = {{-2.0, 4.0}, {0.0, 4.4}, {2.5, 4.9}, {4.3, 5.2}, {6.0, 4.8}, {8.0, 3.9}};
  form.buccal_mm = {{-2.0, 4.0}, {0.0, 4.4}, {2.0, 5.15}, {4.0, 4.95}, {6.0, 4.4}, {7.5, 3.5}};
  form.lingual_mm = {{-2.0, 3.9}, {0.0, 4.2}, {2.5, 4.75}, {4.0, 4.85}, {6.0, 4.4}, {8.0, 3.6}};
  form.squareness = 3.0;
  form.cusps = {{{2.55, 2.7}, 7.0, 0.72, 0.10},
                {{-2.3, 2.7}, 6.8, 0.72, -0.10},
                {{2.4, -2.6}, 7.2, 0.74, 0.10},
                {{-2.4, -2.6}, 7.0, 0.74, -0.10}};
  form.ridges = {{{4.2, 1.2}, {4.2, -1.7}, 5.6}, {{-4.2, 1.1}, {-4.1, -1.6}, 5.4}};
  form.grooves = {{1.55, 0.085, 0.14}, {-1.57, 0.075, 0.14}};
  form.roots = {{{2.1, 0.0}, {0.9, -0.1}, 13.0, {2.2, 3.8}, {0.75, 1.4}, 0.95, 0.18, 2},
                {{-2.2, 0.0}, {-3.6, 0.1}, 12.4, {2.1, 3.6}, {0.7, 1.1}, 0.30, 0.10, 1}};
  return form;
}

/// Young and impacted: wrinkled crown with a fifth cusp, short converging roots that bend distally, wide pulp.
ToothParameters thirdMolar() {
  ToothParameters form;
  form.mesial_mm = {{-2.0, 4.3}, {0.0, 4.7}, {2.4, 5.3}, {4.3, 5.55}, {5.7, 5.1}, {7.5, 4.1}};
  form.distal_mm = {{-2.0, 4.0}, {0.0, 4.4}, {2.4, 4.9}, {4.0, 5.1}, {5.5, 4.7}, {7.5, 3.7}};
  form.buccal_mm = {{-2.0, 4.1}, {0.0, 4.5}, {1.9, 5.2}, {3.8, 5.0}, {5.6, 4.1}, {7.0, 3.2}};
  form.lingual_mm = {{-2.0, 3.9}, {0.0, 4.3}, {2.3, 4.8}, {3.8, 4.9}, {5.6, 4.4}, {7.5, 3.6}};
  form.squareness = 2.6;
  form.cusps = {{{2.75, 2.2}, 6.9, 0.70, 0.15},
                {{-0.9, 2.55}, 6.5, 0.74, -0.05},
                {{-3.55, 0.9}, 5.9, 0.74, -0.6},
                {{2.5, -2.6}, 7.0, 0.72, 0.05},
                {{-1.95, -2.75}, 6.7, 0.74, -0.2}};
  form.ridges = {{{4.4, 1.2}, {4.3, -1.7}, 5.5}, {{-4.2, 0.0}, {-3.6, -2.0}, 5.2}, {{2.7, 2.2}, {0.6, 0.2}, 5.3}};
  form.grooves = {{1.22, 0.08, 0.14}, {2.40, 0.08, 0.16}, {-1.50, 0.08, 0.15}};
  form.roots = {{{2.1, 0.0}, {-0.3, -0.2}, 10.8, {2.45, 3.9}, {0.9, 1.5}, 1.2, 0.14, 2},
                {{-2.0, 0.1}, {-2.9, 0.3}, 10.0, {2.25, 3.6}, {0.9, 1.2}, 0.5, 0.10, 1}};
  form.pulp = 1.25;
  return form;
}

}  // namespace

double ToothParameters::crownHeight_mm() const {
  double height_mm = 0.0;
  for (const CuspParameters& cusp : cusps) height_mm = std::max(height_mm, cusp.height_mm);
  return height_mm;
}

double ToothParameters::rootLength_mm() const {
  double length_mm = 0.0;
  for (const RootParameters& root : roots) length_mm = std::max(length_mm, root.length_mm);
  return length_mm;
}

ToothParameters lowerToothParameters(int position) {
  switch (position) {
    case 4:
      return firstPremolar();
    case 5:
      return secondPremolar();
    case 6:
      return firstMolar();
    case 7:
      return secondMolar();
    case 8:
      return thirdMolar();
    default:
      assert(false && "lower tooth 4..8");
      return thirdMolar();
  }
}

}  // namespace assets
