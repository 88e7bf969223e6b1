#include "app/session/socket_event.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "tests/mutants.h"

namespace app {
namespace {

SocketRecord someSocket() {
  SocketRecord socket;
  socket.chips = {3, 1.2};
  socket.chip_places = {{0.9, {1.0, 2.0, 3.0}}, {0.2, {1.5, 2.0, 3.0}}, {0.1, {0.5, 2.0, 3.0}}};
  socket.chips_taken = {12, 2.5};
  socket.follicle_left = 0.4;
  socket.retained = {{34.25, {1.0, -2.0, 3.5}}, {2.0, {4.0, 5.0, 6.0}}};
  socket.canal = {2.5, {0.0, 1.0, -12.25}};
  socket.canal_by_root_mm2 = 0.75;
  socket.lingual = {{4.0, {6.0, 0.0, -5.0}}};
  socket.edges = {{12.0, {1.0, 1.0, 0.0}}, {1.5, {2.0, 2.0, 0.0}}};
  socket.stitches = 2;
  socket.stitch_places = 3;
  return socket;
}

TEST(SocketEvent, ReadsBackWhatWasWritten) {
  EXPECT_EQ(socketFrom(socketText(someSocket())), someSocket());
  EXPECT_EQ(socketFrom(socketText({})), SocketRecord{});
}

TEST(SocketEvent, OtherWordsAreNone) {
  for (const char* const text :
       {"", "no piece is out", "{}", "[]", R"({"retained":[],"canal":[0,0,0,0],"lingual":[]})"})
    EXPECT_FALSE(socketFrom(text)) << text;
  // One member spoilt each.
  const std::string good = socketText(someSocket());
  const auto spoilt = [&](const std::string& from, const std::string& to) {
    std::string text = good;
    const std::size_t at = text.find(from);
    EXPECT_NE(at, std::string::npos) << from;
    return at == std::string::npos ? text : text.replace(at, from.size(), to);
  };
  EXPECT_TRUE(socketFrom(good));
  for (const auto& [from, to] :
       std::vector<std::pair<std::string, std::string>>{{"34.25", "-34.25"},
                                                        {"34.25", "\"34\""},
                                                        {"34.25,", ""},
                                                        {"\"follicle\":0.4", "\"follicle\":1.4"},
                                                        {"[12,2.5]", "[-1,2.5]"},
                                                        {"[12,2.5]", "[12,-2.5]"},
                                                        {"\"out\":true", "\"out\":1"},
                                                        {"\"canal_by_root\":0.75", "\"canal_by_root\":-1"},
                                                        {"\"canal_by_root\":0.75", "\"canal_by_root\":\"1\""},
                                                        {"\"canal_by_root\":0.75", "\"canal_by_root\":3.5"},
                                                        {"[2,3]", "[2]"},
                                                        {"[2,3]", "[2,1000]"}})
    EXPECT_FALSE(socketFrom(spoilt(from, to))) << to;
}

TEST(SocketEvent, AnOlderOneDoesNotTellWhereTheToothLayOnTheCanal) {
  std::string text = socketText(someSocket());
  const std::string by_root = "\"canal_by_root\":0.75,";
  text.erase(text.find(by_root), by_root.size());
  const auto read = socketFrom(text);
  ASSERT_TRUE(read);
  EXPECT_EQ(read->canal_by_root_mm2, 0.0);
  EXPECT_EQ(read->canal.amount, 2.5);
}

TEST(SocketEvent, KeepsTheLargestWhereThereAreTooMany) {
  SocketRecord socket;
  socket.edges.assign(kMostPlaces + 5, {1.0, glm::dvec3(0.0)});
  EXPECT_EQ(socketFrom(socketText(socket))->edges.size(), kMostPlaces);
}

TEST(SocketEvent, SaysWhatIsLeftAndWhatWasHarmed) {
  EXPECT_EQ(socketInWords({}), "clean");
  EXPECT_EQ(
      socketInWords(someSocket()),
      "not clean: 2 pieces of tooth 36.2 mm³, 3 chips 1.2 mm³, follicle 40 %, sharp edges 14 mm; canal laid open 2.5 "
      "mm² (0.8 of it where the tooth lay on it), lingual plate broken through 4.0 mm²; 2 of 3 stitches");
  SocketRecord opened;
  opened.canal.amount = 1.0;
  opened.edges = {{1.9, glm::dvec3(0.0)}};
  EXPECT_TRUE(opened.isClean());
  EXPECT_EQ(socketInWords(opened), "clean; canal laid open 1.0 mm²");
}

TEST(SocketEventMutants, AreReadOrRefused) {
  mutants::forEachMutant({socketText(someSocket())}, 500, [](const std::string& text, std::size_t, std::uint64_t) {
    if (const auto socket = socketFrom(text)) {
      EXPECT_LE(socket->edges.size(), kMostPlaces);
      EXPECT_TRUE(!socket->is_out || !socketInWords(*socket).empty());
    }
  });
}

}  // namespace
}  // namespace app
