// The head phantom as a folder of DICOM files, for timing an import of it as a user starts it:
// phantom_scan PATIENTS FOLDER [SPACING_MM], then `time molar import FOLDER --out P --json R.json`.

#include <fmt/core.h>

#include <cstdlib>
#include <filesystem>
#include <fstream>

#include "tests/assets/import/dicom/dicom_on_disk.h"
#include "tests/assets/segment/head_phantom.h"

int main(int argc, char** argv) {
  if (argc < 3) {
    fmt::print(stderr, "phantom_scan PATIENTS FOLDER [SPACING_MM]\n");
    return 2;
  }
  tests::HeadPhantomOptions options;
  options.spacing_mm = argc > 3 ? std::atof(argv[3]) : 0.35;
  const tests::HeadPhantom head = tests::headPhantom(argv[1], options);
  const glm::ivec3 size = head.grid.size;
  std::filesystem::create_directories(argv[2]);
  const auto pixels = static_cast<std::size_t>(size.x) * static_cast<std::size_t>(size.y);
  for (int k = 0; k < size.z; ++k) {
    const auto begin = head.grey.begin() + static_cast<std::ptrdiff_t>(static_cast<std::size_t>(k) * pixels);
    dicom_on_disk::Elements file = dicom_on_disk::slice(size.y, size.x, {begin, begin + static_cast<long>(pixels)});
    const glm::dvec3 p = head.grid.centre_P_mm({0, 0, k});
    file[0x00200032] = dicom_on_disk::decimals({p.x, p.y, p.z});
    file[0x00280030] = dicom_on_disk::decimals({head.grid.spacing_mm, head.grid.spacing_mm});
    file[0x00200013] = dicom_on_disk::text("IS", std::to_string(k + 1));
    std::ofstream(std::filesystem::path(argv[2]) / ("IM" + std::to_string(k)), std::ios::binary)
        << dicom_on_disk::bytesOf(file);
  }
  fmt::print("{} x {} x {} voxels of {} mm\n", size.x, size.y, size.z, head.grid.spacing_mm);
}
