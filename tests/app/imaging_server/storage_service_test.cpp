// The storage service against strangers, by messages written byte by byte (PS3.7, PS3.8).
#include "app/imaging_server/storage_service.h"

#include <gtest/gtest.h>

#include <arpa/inet.h>
#include <netinet/in.h>
#include <poll.h>
#include <signal.h>
#include <sys/mman.h>
#include <sys/socket.h>
#include <sys/wait.h>
#include <unistd.h>

#include <array>
#include <cstring>
#include <memory>
#include <new>

#include "assets/scan/confined_child.h"
#include "tests/app/imaging_server/orthanc.h"

namespace app {
namespace {

constexpr unsigned char kAccepted = 2, kRejected = 3, kData = 4, kAborted = 7;
constexpr const char* kCtStorage = "1.2.840.10008.5.1.4.1.1.2";

std::string big16(std::size_t n) { return {static_cast<char>(n >> 8), static_cast<char>(n)}; }
std::string big32(std::size_t n) { return big16(n >> 16) + big16(n & 0xffff); }
std::string little16(std::size_t n) { return {static_cast<char>(n), static_cast<char>(n >> 8)}; }
std::string little32(std::size_t n) { return little16(n & 0xffff) + little16(n >> 16); }
std::string padded(std::string text, std::size_t size) {
  text.resize(size, ' ');
  return text;
}
std::string item(unsigned char type, const std::string& content) {
  return std::string{static_cast<char>(type), '\0'} + big16(content.size()) + content;
}
std::string unit(unsigned char type, const std::string& content) {
  return std::string{static_cast<char>(type), '\0'} + big32(content.size()) + content;
}

std::string association(const std::string& calling, const std::string& called, const std::string& storage,
                        const std::string& syntax) {
  const std::string context = std::string{1, 0, 0, 0} + item(0x30, storage) + item(0x40, syntax);
  return unit(1, big16(1) + big16(0) + padded(called, 16) + padded(calling, 16) + std::string(32, '\0') +
                     item(0x10, "1.2.840.10008.3.1.1.1") + item(0x20, context) +
                     item(0x50, item(0x51, big32(16'384)) + item(0x52, "1.2.3")));
}

std::string element(unsigned number, std::string value) {
  if (value.size() % 2 != 0) value += '\0';
  return little16(0) + little16(number) + little32(value.size()) + value;
}
/// A C-STORE of a data set; `originator`: what it says of the move.
std::string store(const std::string& originator, const std::string& data) {
  std::string command = element(0x0002, kCtStorage) + element(0x0100, little16(1)) + element(0x0110, little16(7)) +
                        element(0x0700, little16(0)) + element(0x0800, little16(0)) + element(0x1000, "1.2.3.4") +
                        originator;
  command = element(0x0000, little32(command.size())) + command;
  const auto value = [](const std::string& bytes, char control) {
    return big32(bytes.size() + 2) + std::string{1, control} + bytes;
  };
  return unit(kData, value(command, 3)) + unit(kData, value(data, 2));
}

class Storage : public testing::Test {
 protected:
  void SetUp() override {
    settings_.receive_host = "127.0.0.1";
    settings_.receive_port = tests::freePort();
    address_.is_web = false, address_.host = "127.0.0.1", address_.ae_title = "PACS";
    limits_.idle_s = 5;
    void* const at = ::mmap(nullptr, sizeof(DicomTalk), PROT_READ | PROT_WRITE, MAP_SHARED | MAP_ANONYMOUS, -1, 0);
    ASSERT_NE(at, MAP_FAILED);
    talk_ = ::new (at) DicomTalk();
    child_ = ::fork();
    if (child_ != 0) return;
    assets::confineChild(std::uint64_t{1} << 30, files_.descriptor());
    ::signal(SIGPIPE, SIG_IGN);
    StorageService service(address_, settings_, limits_, *talk_, [] {});
    service.run();
    ::_exit(0);
  }
  void TearDown() override {
    ::kill(child_, SIGKILL);
    ::waitpid(child_, nullptr, 0);
    ::munmap(talk_, sizeof(DicomTalk));
  }

  /// Kinds of the units that come back, until the other side hangs up or says nothing more.
  std::vector<unsigned char> answersTo(const std::vector<std::string>& messages) {
    const int line = ::socket(AF_INET, SOCK_STREAM, 0);
    sockaddr_in there{};
    there.sin_family = AF_INET;
    there.sin_addr.s_addr = htonl(INADDR_LOOPBACK);
    there.sin_port = htons(static_cast<std::uint16_t>(settings_.receive_port));
    bool is_there = false;
    for (int tries = 0; tries < 400 && !is_there; ++tries) {
      is_there = ::connect(line, reinterpret_cast<sockaddr*>(&there), sizeof there) == 0;
      if (!is_there) ::usleep(25'000);
    }
    EXPECT_TRUE(is_there);
    std::vector<unsigned char> kinds;
    for (const std::string& message : messages) {
      ::send(line, message.data(), message.size(), MSG_NOSIGNAL);
      std::array<unsigned char, 6> head{};
      pollfd waiting{line, POLLIN, 0};
      if (::poll(&waiting, 1, 20'000) <= 0 || ::recv(line, head.data(), head.size(), MSG_WAITALL) != 6) break;
      kinds.push_back(head[0]);
      std::string rest(static_cast<std::size_t>(head[2] << 24 | head[3] << 16 | head[4] << 8 | head[5]), '\0');
      if (::recv(line, rest.data(), rest.size(), MSG_WAITALL) < 0) break;
    }
    ::close(line);
    return kinds;
  }
  /// A whole data set that belongs to our move.
  bool takesOurOwn() {
    const std::uint32_t before = talk_->files.load();
    const auto kinds = answersTo({association("PACS", "MOLAR", kCtStorage, "1.2.840.10008.1.2.4.90"),
                                  store(element(0x1030, "MOLAR") + element(0x1031, little16(1)), "a data set.."),
                                  unit(5, std::string(4, '\0'))});
    return kinds == std::vector<unsigned char>{kAccepted, kData, 6} && talk_->files.load() == before + 1;
  }

  ServerAddress address_;
  ServerSettings settings_;
  ReceiveLimits limits_;
  assets::ReceivedFiles files_;
  DicomTalk* talk_ = nullptr;
  pid_t child_ = 0;
};

TEST_F(Storage, TakesFilesOfOurMoveAsTheyCome) {
  ASSERT_TRUE(takesOurOwn());
  ASSERT_TRUE(takesOurOwn());
  for (int n = 0; n < 2; ++n) files_.takeWritten(talk_->file_bytes[static_cast<std::size_t>(n)]);
  files_.close();
  const std::string second(files_.file(1).begin(), files_.file(1).end());
  EXPECT_EQ(second.substr(128, 4), "DICM");
  EXPECT_NE(second.find("1.2.840.10008.1.2.4.90"), std::string::npos);
  EXPECT_TRUE(second.ends_with("a data set.."));
}

TEST_F(Storage, TakesNothingFromStrangersOrOfAnotherMove) {
  const std::string plain = "1.2.840.10008.1.2.1";
  using Kinds = std::vector<unsigned char>;
  EXPECT_EQ(answersTo({association("STRANGER", "MOLAR", kCtStorage, plain)}), Kinds{kRejected});
  EXPECT_EQ(answersTo({association("PACS", "OTHER", kCtStorage, plain)}), Kinds{kRejected});
  EXPECT_EQ(answersTo({association("PACS", "MOLAR", "1.2.840.10008.5.1.4.1.1.104.1", plain)}), Kinds{kRejected});
  EXPECT_EQ(answersTo({association("PACS", "MOLAR", kCtStorage, "1.2.840.10008.1.2.4.100")}), Kinds{kRejected});
  for (const std::string& originator :
       {std::string(), element(0x1030, "MOLAR"), element(0x1030, "MOLAR") + element(0x1031, little16(2)),
        element(0x1030, "OTHER") + element(0x1031, little16(1))})
    EXPECT_EQ(answersTo({association("PACS", "MOLAR", kCtStorage, plain), store(originator, "data")}),
              (Kinds{kAccepted, kAborted}));
  EXPECT_EQ(talk_->files.load(), 0u);
  EXPECT_TRUE(takesOurOwn());
}

TEST_F(Storage, OutlivesNoise) {
  answersTo({std::string(1000, 'x')});
  answersTo({unit(1, std::string(68, '\0'))});
  answersTo({std::string{1, 0} + big32(0xffffffff) + std::string(2000, '\0')});
  answersTo({association("PACS", "MOLAR", kCtStorage, "1.2.840.10008.1.2"), unit(kData, big32(0xfffffff0) + "ab")});
  EXPECT_EQ(talk_->files.load(), 0u);
  EXPECT_TRUE(takesOurOwn());
}

}  // namespace
}  // namespace app
