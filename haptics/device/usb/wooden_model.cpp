#include "haptics/device/usb/wooden_model.h"

namespace haptics {

WoodenModel woodenHaptics2015() {
  WoodenModel model;
  model.name = "WoodenHaptics v2015";
  model.full_scale_mA = 6000.0;
  return model;
}

WoodenModel woodenHaptics2019() {
  WoodenModel model;
  model.name = "WoodenHaptics v2019";
  model.motor_Nmm_per_A = {321.0, 60.3, 60.3};
  return model;
}

std::optional<WoodenModel> woodenModelNamed(std::string_view name) {
  if (name == "v2015") return woodenHaptics2015();
  if (name == "v2019") return woodenHaptics2019();
  return {};
}

}  // namespace haptics
