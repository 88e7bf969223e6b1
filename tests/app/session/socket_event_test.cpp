#include "app/session/socket_event.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "tests/mutants.h"

namespace app {
namespace {

SocketRecord someSocket() {
  return {{{34.25, {1.0, -2.0, 3.5}}, {2.0, {4.0, 5.0, 6.0}}},
          {2.5, {0.0, 1.0, -12.25}},
          {{4.0, {6.0, 0.0, -5.0}}},
          {{12.0, {1.0, 1.0, 0.0}}, {1.5, {2.0, 2.0, 0.0}}}};
}

TEST(SocketEvent, ReadsBackWhatWasWritten) {
  EXPECT_EQ(socketFrom(socketText(someSocket())), someSocket());
  EXPECT_EQ(socketFrom(socketText({})), SocketRecord{});
}

TEST(SocketEvent, OtherWordsAreNone) {
  for (const char* const text : {"", "no piece is out", "{}", "[]", R"({"retained":[],"canal":[0,0,0,0],"lingual":[]})",
                                 R"({"retained":[[1,2,3]],"canal":[0,0,0,0],"lingual":[],"edges":[]})",
                                 R"({"retained":[["1",2,3,4]],"canal":[0,0,0,0],"lingual":[],"edges":[]})",
                                 R"({"retained":[[-1,2,3,4]],"canal":[0,0,0,0],"lingual":[],"edges":[]})",
                                 R"({"retained":[[1e999,2,3,4]],"canal":[0,0,0,0],"lingual":[],"edges":[]})"})
    EXPECT_FALSE(socketFrom(text)) << text;
}

TEST(SocketEvent, KeepsTheLargestWhereThereAreTooMany) {
  SocketRecord socket;
  socket.edges.assign(kMostPlaces + 5, {1.0, glm::dvec3(0.0)});
  EXPECT_EQ(socketFrom(socketText(socket))->edges.size(), kMostPlaces);
}

TEST(SocketEvent, SaysWhatIsLeftAndWhatWasHarmed) {
  EXPECT_EQ(socketInWords({}), "clean");
  EXPECT_EQ(socketInWords(someSocket()),
            "not clean: 2 pieces of tooth 36.2 mm³, sharp edges 14 mm; canal laid open 2.5 mm², lingual plate broken "
            "through 4.0 mm²");
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
      EXPECT_FALSE(socketInWords(*socket).empty());
    }
  });
}

}  // namespace
}  // namespace app
