#include "assets/scan/exact_distance.h"

#include <itkImage.h>
#include <itkSignedMaurerDistanceMapImageFilter.h>

#include <algorithm>
#include <cassert>
#include <limits>

#include "assets/volume_grid.h"

namespace assets {

std::vector<float> exactDistance_mm(glm::ivec3 size, double spacing_mm, std::span<const std::uint8_t> is_chosen) {
  assert(is_chosen.size() == countIn(size));
  const auto is_set = [](std::uint8_t chosen) { return chosen != 0; };
  if (std::ranges::none_of(is_chosen, is_set))
    return std::vector<float>(is_chosen.size(), std::numeric_limits<float>::infinity());
  if (std::ranges::all_of(is_chosen, is_set)) return std::vector<float>(is_chosen.size(), 0.0F);

  using Mask = itk::Image<unsigned char, 3>;
  using Distances = itk::Image<float, 3>;
  const auto mask = Mask::New();
  Mask::SizeType cells;
  for (int axis = 0; axis < 3; ++axis) cells[static_cast<unsigned>(axis)] = static_cast<itk::SizeValueType>(size[axis]);
  mask->SetRegions(Mask::RegionType(cells));
  Mask::SpacingType spacing;
  spacing.Fill(spacing_mm);
  mask->SetSpacing(spacing);
  mask->Allocate();
  std::ranges::transform(is_chosen, mask->GetBufferPointer(),
                         [&](std::uint8_t chosen) -> unsigned char { return is_set(chosen) ? 1 : 0; });
  const auto filter = itk::SignedMaurerDistanceMapImageFilter<Mask, Distances>::New();
  filter->SetInput(mask);
  filter->SetBackgroundValue(0);
  filter->SetSquaredDistance(false);
  filter->SetUseImageSpacing(true);
  filter->SetInsideIsPositive(false);
  filter->Update();
  const float* const found = filter->GetOutput()->GetBufferPointer();
  return {found, found + is_chosen.size()};
}

}  // namespace assets
