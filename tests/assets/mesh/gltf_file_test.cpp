#include "assets/mesh/gltf_file.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <algorithm>
#include <cstdlib>
#include <cstring>
#include <filesystem>
#include <fstream>
#include <map>
#include <nlohmann/json.hpp>
#include <set>

#include "assets/load_error.h"
#include "tests/mutants.h"
#include "tests/shared_data.h"

namespace assets {
namespace {

namespace fs = std::filesystem;
using testing::HasSubstr;
using testing::Not;

std::string bytesOf(const fs::path& path) {
  std::ifstream in(path, std::ios::binary);
  return {std::istreambuf_iterator<char>(in), {}};
}

nlohmann::json jsonOf(const fs::path& path) { return nlohmann::json::parse(bytesOf(path)); }

struct Refusal {
  bool refused = false;
  std::string text;
};

// Reads and returns the error, if any, which must be one line.
Refusal refusalOf(const fs::path& path, MeshModel* out = nullptr) {
  try {
    MeshModel model = readGltf(path.string());
    if (out != nullptr) *out = std::move(model);
    return {};
  } catch (const LoadError& error) {
    EXPECT_THAT(error.what(), Not(HasSubstr("\n"))) << path;
    return {true, error.what()};
  }
}

std::size_t triangleCount(const MeshModel& model) {
  std::size_t corners = 0;
  for (const MeshPart& part : model.parts) corners += part.triangles.size();
  return corners / 3;
}

// Every index in range, every number finite, one unit normal a vertex.
void expectSound(const MeshModel& model, const fs::path& path) {
  EXPECT_FALSE(model.parts.empty()) << path;
  for (const MeshPart& part : model.parts) {
    ASSERT_EQ(part.normal.size(), part.position_mm.size()) << path;
    ASSERT_TRUE(part.colour.empty() || part.colour.size() == part.position_mm.size()) << path;
    ASSERT_EQ(part.triangles.size() % 3, 0u) << path;
    for (const std::uint32_t vertex : part.triangles) ASSERT_LT(vertex, part.position_mm.size()) << path;
    for (const glm::vec3& n : part.normal) ASSERT_NEAR(glm::length(n), 1.0f, 1e-4f) << path;
    for (const glm::vec3& p : part.position_mm) ASSERT_TRUE(std::isfinite(p.x + p.y + p.z)) << path;
  }
}

class Scratch : public testing::Test {
 protected:
  void SetUp() override {
    std::string pattern = (fs::temp_directory_path() / "molar_gltf_").string() + std::string(6, 'X');
    folder_ = mkdtemp(pattern.data());
  }
  void TearDown() override { fs::remove_all(folder_); }
  fs::path write(const std::string& name, const std::string& bytes) const {
    std::ofstream(folder_ / name, std::ios::binary) << bytes;
    return folder_ / name;
  }
  fs::path folder_;
};

class GltfRead : public Scratch {};
class GltfMutants : public Scratch {};
class GltfRealData : public Scratch {};
class GltfWrite : public Scratch {};

MeshPart triangle(const std::string& name) {
  MeshPart part;
  part.name = name;
  part.material = {{0.1f, 0.2f, 0.3f, 0.5f}, 0.25f, 0.75f};
  part.position_mm = {{0, 0, 0}, {10, 0, 0}, {0, 20, 5}};
  part.normal.assign(3, glm::normalize(glm::vec3(0, -50, 200)));
  part.colour = {{1, 0, 0, 1}, {0, 1, 0, 1}, {0, 0, 0.001f, 1}};
  part.triangles = {0, 1, 2};
  return part;
}

TEST_F(GltfWrite, RoundTrips) {
  const MeshModel written{{triangle("Gum"), triangle("Bur")}};
  writeGltf(written, (folder_ / "model.glb").string());
  const MeshModel read = readGltf((folder_ / "model.glb").string());
  ASSERT_EQ(read.parts.size(), 2u);
  for (std::size_t p = 0; p < 2; ++p) {
    const MeshPart& a = written.parts[p];
    const MeshPart& b = read.parts[p];
    EXPECT_EQ(a.name, b.name);
    EXPECT_EQ(a.triangles, b.triangles);
    EXPECT_LT(glm::distance(a.material.base_colour, b.material.base_colour), 1e-6f);
    EXPECT_FLOAT_EQ(a.material.roughness, b.material.roughness);
    EXPECT_FLOAT_EQ(a.material.metallic, b.material.metallic);
    for (std::size_t i = 0; i < 3; ++i) {
      EXPECT_LT(glm::distance(a.position_mm[i], b.position_mm[i]), 1e-5f);
      EXPECT_LT(glm::distance(a.normal[i], b.normal[i]), 1e-6f);
      EXPECT_LT(glm::distance(a.colour[i], b.colour[i]), 1e-5f);
    }
  }
}

TEST_F(GltfWrite, ReplacesNothingUnlessRequested) {
  const std::string path = write("model.glb", "precious").string();
  const MeshModel model{{triangle("Gum")}};
  EXPECT_THROW(writeGltf(model, path), calibration::CalibrationError);
  EXPECT_EQ(bytesOf(path), "precious");
  writeGltf(model, path, true);
  EXPECT_EQ(triangleCount(readGltf(path)), 1u);
}

TEST_F(GltfWrite, LeavesNoFileForAnIncompletePart) {
  MeshModel model{{triangle("Gum")}};
  model.parts[0].normal.pop_back();
  EXPECT_THROW(writeGltf(model, (folder_ / "model.glb").string()), LoadError);
  EXPECT_TRUE(fs::is_empty(folder_));
}

TEST_F(GltfRealData, AgreesWithTheTruthOfGeneratedFiles) {
  const fs::path folder = tests::sharedData("gltf/generated");
  MOLAR_NEEDS(folder);
  const nlohmann::json truths = jsonOf(folder / "truth.json");
  for (const auto& [name, truth] : truths.items()) {
    MeshModel model;
    const Refusal refusal = refusalOf(folder / name, &model);
    EXPECT_EQ(refusal.refused, !truth["valid"].get<bool>()) << name << ": " << refusal.text;
    if (refusal.refused) continue;
    expectSound(model, name);
    if (truth.contains("triangles")) {
      EXPECT_EQ(triangleCount(model), truth["triangles"].get<std::size_t>()) << name;
    }
    for (const char* key : {"aabb", "aabb_world", "aabb_morphed"}) {
      if (!truth.contains(key)) continue;
      glm::vec3 low(1e9f);
      glm::vec3 high(-1e9f);
      for (const MeshPart& part : model.parts) {
        for (const glm::vec3& p : part.position_mm) low = glm::min(low, p), high = glm::max(high, p);
      }
      for (int axis = 0; axis < 3; ++axis) {
        EXPECT_NEAR(low[axis], 1000.0 * truth[key][0][static_cast<std::size_t>(axis)].get<double>(), 1e-3) << name;
        EXPECT_NEAR(high[axis], 1000.0 * truth[key][1][static_cast<std::size_t>(axis)].get<double>(), 1e-3) << name;
      }
    }
  }
}

TEST_F(GltfRealData, ReversesTheWindingOfAMirroredNode) {
  const fs::path file = tests::sharedData("gltf/generated/05_negative_scale_hierarchy.gltf");
  MOLAR_NEEDS(file);
  const MeshModel model = readGltf(file.string());
  const MeshPart& part = model.parts.at(0);
  for (std::size_t t = 0; t < part.triangles.size(); t += 3) {
    const auto corner = [&](std::size_t i) { return part.position_mm[part.triangles[t + i]]; };
    EXPECT_GT(glm::dot(glm::cross(corner(1) - corner(0), corner(2) - corner(0)), glm::vec3(0, 0, 1)), 0.0f);
  }
}

// Files without errors load; the exceptions have no triangles.
TEST_F(GltfRealData, ReadsWhatTheValidatorAccepts) {
  const fs::path folder = tests::sharedData("gltf/validator");
  MOLAR_NEEDS(folder);
  const std::map<std::string, std::string> may_refuse = {
      {"/primitive_no_position.gltf", "no POSITION, so nothing to draw"},
      {"/named_objects.gltf", "a buffer with no bytes anywhere"},
      {"/unused_objects.gltf", "a buffer with no bytes anywhere"},
      {"/integer_written_as_float.gltf", "a buffer with no bytes anywhere"},
      {"/mesh/valid.gltf", "indices without a buffer view, so every triangle is a point"},
  };
  int read = 0;
  int files = 0;
  for (const auto& entry : fs::recursive_directory_iterator(folder)) {
    const fs::path path = entry.path();
    if (path.extension() != ".gltf" && path.extension() != ".glb") continue;
    ++files;
    MeshModel model;
    const Refusal refusal = refusalOf(path, &model);
    if (!refusal.refused) expectSound(model, path);
    const fs::path report_path = path.string() + ".report.json";
    if (!fs::exists(report_path)) continue;
    const nlohmann::json report = jsonOf(report_path);
    const bool valid = report["issues"]["numErrors"] == 0;
    const bool draws = report.contains("info") && report["info"].value("totalTriangleCount", 0) > 0;
    const auto is_named = [&](const auto& exception) { return path.string().ends_with(exception.first); };
    if (!valid || !draws || std::ranges::any_of(may_refuse, is_named)) continue;
    EXPECT_FALSE(refusal.refused) << refusal.text;
    ++read;
  }
  EXPECT_GT(files, 300);
  EXPECT_GE(read, 14);
}

TEST_F(GltfRead, RefusesOtherFiles) {
  EXPECT_TRUE(refusalOf(folder_ / "absent.glb").refused);
  EXPECT_TRUE(refusalOf(folder_).refused);
  EXPECT_TRUE(refusalOf(write("empty.glb", "")).refused);
  EXPECT_TRUE(refusalOf(write("text.gltf", "hello")).refused);
  EXPECT_TRUE(refusalOf(write("magic.glb", "glTF")).refused);
  EXPECT_TRUE(refusalOf(write("list.gltf", "[1,2]")).refused);
  EXPECT_TRUE(refusalOf(write("bare.gltf", R"({"asset":{"version":"2.0"}})")).refused);
}

// tinygltf alone would read past the end of this one.
TEST_F(GltfRead, RefusesABinaryChunkThatEndsPastTheFile) {
  writeGltf({{triangle("Gum")}}, (folder_ / "whole.glb").string());
  std::string bytes = bytesOf(folder_ / "whole.glb");
  bytes.resize(bytes.size() - 8);
  const auto length = static_cast<std::uint32_t>(bytes.size());
  std::memcpy(bytes.data() + 8, &length, sizeof length);
  EXPECT_THAT(refusalOf(write("cut.glb", bytes)).text, HasSubstr("cut short"));
}

TEST_F(GltfRead, RefusesACycleOfNodesAndANodeUsedTwice) {
  for (const std::string nodes :
       {R"("scenes":[{"nodes":[0]}],"nodes":[{"children":[1]},{"children":[0]}])",
        R"("nodes":[{"children":[2]},{"children":[2]},{}])", R"("scenes":[{"nodes":[0,0]}],"nodes":[{}])"}) {
    EXPECT_THAT(refusalOf(write("model.gltf", R"({"asset":{"version":"2.0"},)" + nodes + "}")).text,
                HasSubstr("two parents"));
  }
}

TEST_F(GltfRead, NamesTheUnsupportedExtension) {
  EXPECT_THAT(refusalOf(write("draco.gltf", R"({"asset":{"version":"2.0"},"extensionsRequired":[
      "KHR_draco_mesh_compression"],"meshes":[{"primitives":[{"attributes":{"POSITION":0},"indices":1}]}],"accessors":[
      {"componentType":5126,"count":3,"type":"VEC3"},{"componentType":5125,"count":3,"type":"SCALAR"}]})"))
                  .text,
              HasSubstr("requires the extension 'KHR_draco_mesh_compression'"));
}

TEST_F(GltfRead, RefusesDeeplyNestedJson) {
  const std::string deep(100'000, '[');
  EXPECT_THAT(refusalOf(write("deep.gltf", R"({"asset":{"version":"2.0","extras":)" + deep)).text,
              HasSubstr("nested deeper"));
}

TEST_F(GltfRead, StaysInItsOwnFolder) {
  fs::create_directory(folder_ / "inner");
  const std::string positions(36, '\0');
  write("secret.bin", positions);
  const auto file = [](const std::string& uri) {
    return R"({"asset":{"version":"2.0"},"meshes":[{"primitives":[{"attributes":{"POSITION":0}}]}],"accessors":[
      {"bufferView":0,"componentType":5126,"count":3,"type":"VEC3"}],"bufferViews":[{"buffer":0,"byteLength":36}],
      "buffers":[{"byteLength":36,"uri":")" +
           uri + R"("}]})";
  };
  const std::string absolute = (folder_ / "secret.bin").string();
  for (const std::string& uri :
       {std::string("../secret.bin"), std::string("%2e%2e/secret.bin"), std::string("..%2Fsecret.bin"), absolute,
        "file://" + absolute, std::string("a/../../secret.bin"), std::string(""), std::string(".")}) {
    EXPECT_TRUE(refusalOf(write("inner/model.gltf", file(uri))).refused) << uri;
  }
  fs::create_symlink("../secret.bin", folder_ / "inner/link.bin");
  EXPECT_TRUE(refusalOf(write("inner/model.gltf", file("link.bin"))).refused);
  EXPECT_FALSE(refusalOf(write("model.gltf", file("secret%2Ebin"))).refused);
}

TEST_F(GltfRead, BoundsTheMemoryOfAShortFile) {
  // Zeros without a buffer, and one mesh with many instances.
  EXPECT_TRUE(refusalOf(write("zeros.gltf", R"({"asset":{"version":"2.0"},"meshes":[{"primitives":[{"attributes":{
      "POSITION":0}}]}],"accessors":[{"componentType":5126,"count":4000000000,"type":"VEC3"}]})"))
                  .refused);
  std::string nodes;
  for (int i = 0; i < 100'000; ++i) nodes += R"({"mesh":0},)";
  nodes.pop_back();
  EXPECT_THAT(refusalOf(write("many.gltf", R"({"asset":{"version":"2.0"},"nodes":[)" + nodes +
                                               R"(],"meshes":[{"primitives":[{"attributes":{"POSITION":0}}]}],
      "accessors":[{"componentType":5126,"count":100000,"type":"VEC3"}]})"))
                  .text,
              HasSubstr("20 million"));
}

TEST_F(GltfRead, ReadsADeepHierarchyWithoutRecursion) {
  std::string nodes;
  for (int i = 1; i <= 100'000; ++i) nodes += R"({"children":[)" + std::to_string(i) + "]},";
  MeshModel model;
  const Refusal refusal = refusalOf(
      write("deep.gltf", R"({"asset":{"version":"2.0"},"nodes":[)" + nodes + R"({"mesh":0}],"meshes":[{"primitives":[{
      "attributes":{"POSITION":0}}]}],"accessors":[{"componentType":5126,"count":3,"type":"VEC3"}]})"),
      &model);
  EXPECT_FALSE(refusal.refused) << refusal.text;
  EXPECT_EQ(triangleCount(model), 1u);
}

// Seeded small damage: each file either loads as a valid model or is refused in one line.
TEST_F(GltfMutants, AreReadAsValidModelsOrRefused) {
  std::vector<std::string> seeds;
  MeshPart part = triangle("Gum");
  for (int i = 0; i < 40; ++i) {
    const auto first = static_cast<std::uint32_t>(part.position_mm.size());
    for (int c = 0; c < 3; ++c) part.position_mm.emplace_back(i, c, i * c), part.normal.emplace_back(0, 0, 1);
    part.triangles.insert(part.triangles.end(), {first, first + 1, first + 2});
  }
  part.colour.resize(part.position_mm.size(), glm::vec4(1.0f));
  writeGltf({{part}}, (folder_ / "seed.glb").string());
  seeds.push_back(bytesOf(folder_ / "seed.glb"));
  const fs::path generated = tests::sharedData("gltf/generated");
  for (const char* name : {"02_sparse_over_view.gltf", "05_negative_scale_hierarchy.gltf", "07_strip_and_fan.gltf",
                           "09_morph_default_weight.gltf", "10_u32_indices.glb"}) {
    if (fs::exists(generated / name)) seeds.push_back(bytesOf(generated / name));
  }

  std::uint64_t loaded = 0, tried = 0;
  mutants::forEachMutant(seeds, 3000, [&](const std::string& bytes, std::size_t, std::uint64_t) {
    ++tried;
    MeshModel model;
    const fs::path file = write("damaged.gltf", bytes);
    if (refusalOf(file, &model).refused) return;
    ++loaded;
    expectSound(model, file);
  });
  if (tried >= mutants::kEnoughToJudge) {
    EXPECT_GT(loaded, tried / 60);
  }
}

}  // namespace
}  // namespace assets
