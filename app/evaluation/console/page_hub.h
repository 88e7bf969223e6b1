// The pages that look at a session, without any network: who writes, what each is still to be sent, what they say.
// Nothing waits in a queue but answers, and those are bounded: of states and pictures each page gets the newest, of
// pictures no more than two that it has not drawn. What a page says is understood here or refused here: the session
// hears only what it can understand. One thread; 0.1 ms for a state, microseconds else.
#pragma once

#include <cstdint>
#include <deque>
#include <map>
#include <memory>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

namespace app {

class PageHub {
 public:
  enum class Role : std::uint8_t { evaluator, participant };
  static constexpr std::size_t kMostReplies = 512;
  static constexpr int kMostUndrawn = 2, kMostPerSecond = 300, kMostNonsense = 50;

  PageHub();
  ~PageHub();

  /// `page`: its id, where it says so: takes the place of its own former connection. Returns the number of the client.
  int join(Role role, const std::string& page, std::int64_t now_ns);
  void leave(int client);
  /// What stays to be closed: others have taken their place, or they say too much.
  std::vector<int> takeUnwelcome();
  /// That look on.
  int pages() const;

  /// From a client. False: it says too much, or too much nonsense.
  bool hear(int client, std::string_view text, std::int64_t now_ns);
  /// From the session. False: its end.
  bool tell(std::string_view text);
  /// `jpeg`: of a picture of the surgeon.
  void show(std::uint32_t serial, std::int64_t t_ns, std::string_view jpeg);
  /// Somebody has credit for another.
  bool wantsPicture() const;

  struct Outgoing {
    bool is_picture = false;
    std::shared_ptr<const std::string> bytes;
  };
  /// What is to be sent to a client next; none: nothing for now.
  std::optional<Outgoing> next(int client, std::int64_t now_ns);
  /// For the session, since the last call.
  std::vector<std::string> takeUp();

  struct Paired {
    std::int64_t request = 0;
    std::string token, why;  ///< token empty: refused
  };
  /// Asks the session, which answers by takePaired().
  std::int64_t pair(const std::string& digits);
  std::vector<Paired> takePaired();
  bool isValid(std::string_view token, std::int64_t now_ns) const;

 private:
  struct Client;
  struct State;
  void event(Client& client, const void* message, std::int64_t now_ns);
  void reply(Client& client, std::string text);
  void write(int client, std::int64_t now_ns);
  std::string stateFor(Client& client, std::int64_t now_ns) const;

  std::map<int, Client> clients_;
  int next_ = 1, writer_ = 0;
  std::int64_t writer_since_ns_ = 0;
  std::unique_ptr<State> state_;
  std::vector<std::string> up_;
  std::vector<int> unwelcome_;
  std::vector<Paired> paired_;
  std::map<std::string, std::int64_t, std::less<>> tokens_;  ///< until
  std::int64_t request_ = 0;
  std::shared_ptr<const std::string> picture_;
  std::uint32_t picture_serial_ = 0;
};

}  // namespace app
