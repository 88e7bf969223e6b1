#include "app/debrief/bookmarks.h"

#include <filesystem>
#include <fstream>
#include <iterator>
#include <random>

#include <gtest/gtest.h>

#include "app/session/session_error.h"
#include "tests/scratch_folder.h"

namespace app {
namespace {

void write(const std::string& file, const std::string& bytes) {
  std::ofstream(file, std::ios::binary).write(bytes.data(), static_cast<std::streamsize>(bytes.size()));
}

TEST(Bookmarks, LieBesideTheirSession) {
  EXPECT_EQ(Bookmarks::fileFor("/a/b.molar"), "/a/b.bookmarks.json");
  EXPECT_EQ(Bookmarks::fileFor("odd name"), "odd name.bookmarks.json");
}

TEST(Bookmarks, AreReadAsTheyWereKept) {
  const tests::ScratchFolder folder;
  Bookmarks first(folder.file("s.bookmarks.json"));
  EXPECT_TRUE(first.all().empty()) << "there is no file yet";
  EXPECT_TRUE(first.set(12.5, "too close, \"zu nah\" für mich"));
  EXPECT_TRUE(first.set(3.0, ""));
  EXPECT_TRUE(first.set(12.52, "said again"));
  first.save();
  const Bookmarks second(first.file());
  EXPECT_EQ(second.all(), (std::vector<Bookmark>{{3.0, ""}, {12.5, "said again"}}));
  EXPECT_FALSE(first.removeAt(9.0));
  EXPECT_TRUE(first.removeAt(3.2));
  first.save();
  EXPECT_EQ(Bookmarks(first.file()).all().size(), 1u);
  EXPECT_EQ(std::distance(std::filesystem::directory_iterator(folder.file("")), {}), 1) << "nothing is left over";
}

TEST(Bookmarks, HoldPlainLines) {
  EXPECT_EQ(plainNote("a\nb\x1b[31m\tc"), "ab[31mc");
  EXPECT_EQ(plainNote("gr\xc3\xbc\xc3\x9f\x65 \xff\xc3"), "gr\xc3\xbc\xc3\x9f\x65 ");
  EXPECT_EQ(plainNote(std::string(5000, 'x')).size(), Bookmarks::kMostLetters);
}

TEST(Bookmarks, OfAStrangerAreReadOrRefused) {
  const tests::ScratchFolder folder;
  const std::string file = folder.file("s.bookmarks.json");
  const std::string good =
      R"({"molar_bookmarks": 1, "bookmarks": [{"t_s": 1.5, "note": "one"}, {"t_s": 0.5, "note": 7, "more": []}]})";
  write(file, good);
  EXPECT_EQ(Bookmarks(file).all(), (std::vector<Bookmark>{{0.5, ""}, {1.5, "one"}}));
  for (const char* bad : {"", "[]", "{}", "{\"molar_bookmarks\": 1}", "{\"molar_bookmarks\": 1, \"bookmarks\": {}}",
                          "{\"molar_bookmarks\": 1, \"bookmarks\": [{\"t_s\": -1}]}",
                          "{\"molar_bookmarks\": 1, \"bookmarks\": [{\"t_s\": 1e300}]}",
                          "{\"molar_bookmarks\": 1, \"bookmarks\": [{\"t_s\": \"1\"}]}",
                          "{\"molar_bookmarks\": 1, \"bookmarks\": [7]}"}) {
    write(file, bad);
    EXPECT_THROW(Bookmarks{file}, SessionError) << bad;
  }
  write(file, "{\"molar_bookmarks\": 1, \"bookmarks\": " + std::string(50'000, '['));
  EXPECT_THROW(Bookmarks{file}, SessionError);
  write(file, std::string(3 << 20, ' '));
  EXPECT_THROW(Bookmarks{file}, SessionError);
  EXPECT_THROW(Bookmarks{folder.file("")}, SessionError) << "a folder";
  std::mt19937 random(11);
  for (int n = 0; n < 200; ++n) {
    std::string bytes = good;
    for (int change = 0; change < 3; ++change) bytes[random() % bytes.size()] = static_cast<char>(random() % 256);
    write(file, bytes);
    try {
      const Bookmarks read(file);
      for (const Bookmark& one : read.all()) EXPECT_EQ(plainNote(one.note), one.note);
    } catch (const SessionError&) {
    }
  }
}

}  // namespace
}  // namespace app
