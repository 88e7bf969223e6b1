// Runs the built `molar` and keeps its output. For tests of the command line.
#pragma once

#include <cstdlib>
#include <filesystem>
#include <fstream>
#include <sstream>
#include <string>

#include <sys/wait.h>
#include <unistd.h>

#include <gtest/gtest.h>

namespace app {

struct ProgramOutput {
  int status = -1;  ///< exit status; 128 + signal after a crash
  std::string out, err;
};

/// A temporary folder for each test.
class ProgramTest : public testing::Test {
 protected:
  void SetUp() override {
    const auto* info = testing::UnitTest::GetInstance()->current_test_info();
    folder_ = std::filesystem::path(testing::TempDir()) /
              (std::string("molar_") + info->test_suite_name() + "_" + info->name() + "_" + std::to_string(getpid()));
    std::filesystem::remove_all(folder_);
    std::filesystem::create_directories(folder_);
    // Rehearsals are recorded there, beside the files of the test.
    std::filesystem::remove_all(dataFolder());
    setenv("XDG_DATA_HOME", dataFolder().c_str(), 1);
    setenv("XDG_CONFIG_HOME", (dataFolder() + ".config").c_str(), 1);
  }
  void TearDown() override {
    std::filesystem::remove_all(folder_);
    std::filesystem::remove_all(dataFolder());
    std::filesystem::remove_all(dataFolder() + ".config");
  }

  std::string dataFolder() const { return folder_.string() + ".data"; }

  std::string at(const std::string& name) const { return (folder_ / name).string(); }
  std::string write(const std::string& name, const std::string& bytes) const {
    std::ofstream(at(name), std::ios::binary) << bytes;
    return at(name);
  }
  std::string read(const std::string& name) const {
    std::ifstream file(at(name), std::ios::binary);
    std::ostringstream text;
    text << file.rdbuf();
    return text.str();
  }
  std::size_t fileCount() const {
    return static_cast<std::size_t>(std::distance(std::filesystem::directory_iterator(folder_), {}));
  }

  /// `arguments` as a shell would read them; `input` names a file.
  ProgramOutput molar(const std::string& arguments, const std::string& input = "/dev/null") const {
    const std::string out = folder_.string() + ".out", err = folder_.string() + ".err";
    const std::string line =
        std::string(MOLAR_PROGRAM) + " " + arguments + " >'" + out + "' 2>'" + err + "' <'" + input + "'";
    const int status = std::system(line.c_str());
    ProgramOutput said;
    said.status = WIFEXITED(status) ? WEXITSTATUS(status) : 128 + WTERMSIG(status);
    for (const auto& [path, text] : {std::pair{out, &said.out}, std::pair{err, &said.err}}) {
      std::ifstream file(path, std::ios::binary);
      std::ostringstream all;
      all << file.rdbuf();
      *text = all.str();
      std::filesystem::remove(path);
    }
    return said;
  }

  /// Bad input: exit 2 and exactly one line that starts with the program's name.
  void expectRefusal(const std::string& arguments, const std::string& word = "") const {
    const ProgramOutput said = molar(arguments);
    EXPECT_EQ(said.status, 2) << arguments << "\n" << said.err;
    EXPECT_EQ(said.out, "") << arguments;
    // Whichever test comes first has the built-in patient made.
    const std::string made = "molar: generating the built-in patient (once, up to a minute)\n";
    const std::string refusal = said.err.substr(said.err.starts_with(made) ? made.size() : 0);
    EXPECT_TRUE(refusal.starts_with("molar: ")) << arguments << "\n" << said.err;
    EXPECT_EQ(std::count(refusal.begin(), refusal.end(), '\n'), 1) << arguments << "\n" << said.err;
    EXPECT_NE(said.err.find(word), std::string::npos) << arguments << "\n" << said.err;
  }

  std::filesystem::path folder_;
};

}  // namespace app
