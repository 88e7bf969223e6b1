#include "assets/patient/patient_folder.h"
#include "tests/app/commands/program.h"

namespace app {
namespace {

class RadiographCommand : public ProgramTest {
 protected:
  /// A block of bone with a numbered tooth of enamel over dentine.
  std::string patientWithTooth(int fdi) const {
    assets::Patient patient;
    patient.title = "block";
    patient.ct.grid = {{40, 40, 60}, 0.5, {0.0, 0.0, 0.0}};
    const std::size_t voxels = patient.ct.grid.voxelCount();
    patient.ct.hounsfield.assign(voxels, 1300);
    patient.ct.label.assign(voxels, static_cast<std::uint8_t>(assets::Tissue::cortical));
    patient.ct.solid.assign(voxels, 255);
    patient.ct.tooth.assign(voxels, 0);
    assets::forVoxels(patient.ct.grid, [&](glm::ivec3 ijk, std::size_t v) {
      if (glm::any(glm::lessThan(ijk, glm::ivec3(12))) || glm::any(glm::greaterThan(ijk, glm::ivec3(28, 28, 48))))
        return;
      patient.ct.label[v] = static_cast<std::uint8_t>(ijk.z > 36 ? assets::Tissue::enamel : assets::Tissue::dentine);
      patient.ct.tooth[v] = static_cast<std::uint8_t>(fdi);
    });
    assets::savePatient(patient, at("patient"), false);
    return at("patient");
  }
};

TEST_F(RadiographCommand, DrawsATooth) {
  const std::string patient = patientWithTooth(36);
  for (const auto& [shift, name] : {std::pair{"0", "a.png"}, std::pair{"20", "b.png"}, std::pair{"-20", "c.png"}}) {
    const ProgramOutput said = molar("radiograph " + patient + " --tooth 36 --shift " + shift + " --out " + at(name));
    ASSERT_EQ(said.status, 0) << said.err;
  }
  EXPECT_EQ(read("a.png").substr(1, 3), "PNG");
  EXPECT_NE(read("a.png"), read("b.png"));
  EXPECT_NE(read("b.png"), read("c.png"));
}

TEST_F(RadiographCommand, RefusesInOneLine) {
  const std::string patient = patientWithTooth(36), out = " --out " + at("r.png");
  expectRefusal("radiograph " + patient + " --tooth 46" + out, "no voxel is labelled as tooth 46");
  expectRefusal("radiograph " + patient + " --tooth 49" + out, "FDI");
  expectRefusal("radiograph " + patient + " --tooth 36 --shift 80" + out, "--shift");
  expectRefusal("radiograph " + patient + " --tooth 36 --out " + at("r.jpg"), ".png");
  expectRefusal("radiograph --tooth 36" + out, "exactly one");
  expectRefusal("radiograph " + patient + " --session last --tooth 36" + out, "one of");
  EXPECT_FALSE(std::filesystem::exists(at("r.png")));
}

}  // namespace
}  // namespace app
