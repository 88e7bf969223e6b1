#include "app/evaluation/console/page_server.h"

#include <unistd.h>

#include <algorithm>
#include <array>
#include <chrono>
#include <map>
#include <memory>
#include <string>
#include <utility>
#include <vector>

#include <boost/asio/io_context.hpp>
#include <boost/asio/ip/tcp.hpp>
#include <boost/asio/local/stream_protocol.hpp>
#include <boost/asio/posix/stream_descriptor.hpp>
#include <boost/asio/ssl/context.hpp>
#include <boost/asio/steady_timer.hpp>
#include <boost/asio/write.hpp>
#include <boost/beast/core.hpp>
#include <boost/beast/http.hpp>
#include <boost/beast/ssl.hpp>
#include <boost/beast/websocket.hpp>
#include <boost/beast/websocket/ssl.hpp>
#include <nlohmann/json.hpp>

#include "app/evaluation/child_process.h"
#include "app/evaluation/console/page_files.h"
#include "app/evaluation/console/page_gate.h"
#include "app/evaluation/console/page_hub.h"
#include "app/evaluation/console/page_jpeg.h"
#include "app/evaluation/console/page_pictures.h"
#include "app/evaluation/console/page_words.h"
#include "app/session/session_error.h"

namespace app {
namespace {

namespace beast = boost::beast;
namespace http = beast::http;
namespace net = boost::asio;
using Tcp = net::ip::tcp;
using Failure = beast::error_code;

constexpr std::chrono::seconds kRequestTime{15}, kStuckTime{60};
constexpr std::chrono::milliseconds kBeat{250};
constexpr std::uint32_t kMostHeader = 8192;
constexpr std::uint64_t kMostBody = 1024;
constexpr std::size_t kMostMessage = 32U << 10U, kMostConnections = 64, kMostPages = 16, kMostToSession = 1U << 20U;

std::int64_t clock_ns() { return std::chrono::steady_clock::now().time_since_epoch().count(); }

class Server;

/// A page's connection, whatever it goes over.
class PageClient {
 public:
  virtual ~PageClient() = default;
  /// Something may be there to be sent.
  virtual void send() = 0;
  virtual void drop() = 0;
  virtual bool isStuck() const = 0;
};

class Server {
 public:
  explicit Server(const PageOptions& options);
  /// Leaves as it is: nothing of it is to be kept.
  [[noreturn]] void run() {
    context_.run();
    ::_exit(0);
  }

  PageHub& hub() { return hub_; }
  const PageGate& gate() const { return gate_; }
  bool isShared() const { return is_shared_; }
  net::ssl::context& tls() { return tls_; }
  void welcome(int number, std::weak_ptr<PageClient> client) {
    clients_[number] = std::move(client);
    sayAlive();
    pump();
  }
  void goodbye(int number) {
    clients_.erase(number);
    hub_.leave(number);
    sayAlive();
    pump();
  }
  /// Whatever has come is handed on.
  void pump();
  void awaitPairing(std::int64_t request, std::function<void(const PageHub::Paired&)> then) {
    pairings_[request] = std::move(then);
    pump();
  }
  void opened() { ++connections_; }
  void closed() { --connections_; }

 private:
  void accept();
  void hearSession();
  void tellSession(const std::string& text);
  void sendToSession();
  void hearBell();
  void beat();
  void end();
  void sayAlive() { tellSession(R"({"kind":"alive","pages":)" + std::to_string(hub_.pages()) + "}"); }

  net::io_context context_{1};
  net::ssl::context tls_{net::ssl::context::tls_server};
  Tcp::acceptor acceptor_;
  net::local::stream_protocol::socket session_;
  net::posix::stream_descriptor bell_;
  net::steady_timer beat_, ending_;
  bool is_shared_;
  PicturesIn pictures_;
  PageJpeg jpeg_;
  PageGate gate_;
  PageHub hub_;
  std::map<int, std::weak_ptr<PageClient>> clients_;
  std::map<std::int64_t, std::function<void(const PageHub::Paired&)>> pairings_;
  std::array<char, 16384> heard_{};
  FrameReader reader_{kMostDown};
  std::string out_, sending_;
  std::uint64_t rings_ = 0;
  std::uint32_t pictured_ = 0;
  std::size_t connections_ = 0;
};

/// From the handshake on, as long as the page stays.
template <class Stream>
class SocketClient : public PageClient, public std::enable_shared_from_this<SocketClient<Stream>> {
 public:
  SocketClient(Server& server, Stream stream) : server_(server), socket_(std::move(stream)) { server_.opened(); }
  ~SocketClient() override {
    server_.closed();
    if (number_ > 0) server_.goodbye(number_);
  }

  void start(const http::request<http::string_body>& request, PageHub::Role role, std::string page) {
    // The WebSocket's own time-outs from here on: a page that does not answer for long is gone.
    beast::get_lowest_layer(socket_).expires_never();
    constexpr std::chrono::seconds kHandshake{10}, kIdle{100};
    socket_.set_option(beast::websocket::stream_base::timeout{kHandshake, kIdle, true});
    socket_.set_option(beast::websocket::stream_base::decorator([](beast::websocket::response_type& response) {
      for (const auto& [name, value] : PageGate::headers())
        response.set(beast::string_view(name.data(), name.size()), beast::string_view(value.data(), value.size()));
    }));
    socket_.read_message_max(kMostMessage);
    socket_.auto_fragment(false);
    socket_.async_accept(request, [self = this->shared_from_this(), role, page = std::move(page)](Failure failed) {
      if (failed || self->server_.hub().pages() >= static_cast<int>(kMostPages)) return;
      self->number_ = self->server_.hub().join(role, page, clock_ns());
      self->server_.welcome(self->number_, self->weak_from_this());
      self->read();
    });
  }

  void send() override {
    if (is_sending_ || number_ == 0) return;
    auto next = server_.hub().next(number_, clock_ns());
    if (!next) return;
    is_sending_ = true;
    sending_since_ = std::chrono::steady_clock::now();
    socket_.binary(next->is_picture);
    const net::const_buffer bytes(next->bytes->data(), next->bytes->size());
    socket_.async_write(bytes, [self = this->shared_from_this(), kept = next->bytes](Failure failed, std::size_t) {
      self->is_sending_ = false;
      if (!failed) self->server_.pump();
    });
  }
  void drop() override { beast::get_lowest_layer(socket_).cancel(), beast::get_lowest_layer(socket_).close(); }
  bool isStuck() const override {
    return is_sending_ && std::chrono::steady_clock::now() - sending_since_ > kStuckTime;
  }

 private:
  void read() {
    socket_.async_read(in_, [self = this->shared_from_this()](Failure failed, std::size_t) {
      if (failed) return;
      const std::string text = beast::buffers_to_string(self->in_.data());
      self->in_.consume(self->in_.size());
      if (!self->server_.hub().hear(self->number_, text, clock_ns())) return self->drop();
      self->server_.pump();
      self->read();
    });
  }

  Server& server_;
  beast::websocket::stream<Stream> socket_;
  beast::flat_buffer in_;
  int number_ = 0;
  bool is_sending_ = false;
  std::chrono::steady_clock::time_point sending_since_{};
};

/// Requests, one after the other, until one asks for a WebSocket. Kept alive by what it waits for.
template <class Stream>
class WebSession : public std::enable_shared_from_this<WebSession<Stream>> {
 public:
  WebSession(Server& server, Stream stream) : server_(server), stream_(std::move(stream)) { server_.opened(); }
  ~WebSession() { server_.closed(); }

  void read() {
    parser_.emplace();
    parser_->header_limit(kMostHeader);
    parser_->body_limit(kMostBody);
    beast::get_lowest_layer(stream_).expires_after(kRequestTime);
    http::async_read(stream_, in_, *parser_, [self = this->shared_from_this()](Failure failed, std::size_t) {
      if (failed == http::error::end_of_stream) return self->end();
      if (failed == http::error::header_limit) return self->refuse(http::status::request_header_fields_too_large);
      if (failed == http::error::body_limit) return self->refuse(http::status::payload_too_large);
      if (failed && failed.category() == make_error_code(http::error::bad_method).category())
        return self->refuse(http::status::bad_request);
      if (!failed) self->answer(self->parser_->release());
    });
  }
  template <class Handshaken>
  void handshake(Handshaken then) {
    beast::get_lowest_layer(stream_).expires_after(kRequestTime);
    stream_.async_handshake(net::ssl::stream_base::server, [self = this->shared_from_this(), then](Failure failed) {
      if (!failed) then(*self);
    });
  }

 private:
  using Request = http::request<http::string_body>;
  using Response = http::response<http::string_body>;

  static std::string_view plain(beast::string_view text) { return {text.data(), text.size()}; }

  void answer(Request request) {
    const std::string_view host = plain(request[http::field::host]), target = plain(request.target());
    const std::string_view path = PageGate::pathOf(target);
    const bool changes = request.method() == http::verb::post || beast::websocket::is_upgrade(request);
    if (!server_.gate().isOwnHost(host)) return refuse(http::status::misdirected_request);
    if (changes && !server_.gate().isOwnOrigin(plain(request[http::field::origin]), host))
      return refuse(http::status::forbidden);
    const bool may = !server_.isShared() ||
                     server_.hub().isValid(PageGate::tokenIn(plain(request[http::field::cookie])), clock_ns());
    if (beast::websocket::is_upgrade(request)) {
      if (path != "/ws") return refuse(http::status::not_found);
      if (!may) return refuse(http::status::forbidden);
      const bool is_participant = PageGate::valueIn(target, "role") == "participant";
      std::string page = PageGate::valueIn(target, "page");
      if (!isPageId(page)) page.clear();
      std::make_shared<SocketClient<Stream>>(server_, std::move(stream_))
          ->start(request, is_participant ? PageHub::Role::participant : PageHub::Role::evaluator, std::move(page));
      return;
    }
    if (request.method() == http::verb::post && path == "/pair" && server_.isShared()) return pair(request);
    if (request.method() != http::verb::get && request.method() != http::verb::head)
      return refuse(http::status::method_not_allowed);
    const bool is_page = path == "/" || path == "/participant";
    const bool is_for_all = path == "/pair.html" || path == "/pair.js" || path == "/page.css" || path == "/icon.svg";
    if (!may && !is_for_all && !is_page) return refuse(http::status::forbidden);
    const PageFile* const file = pageFileAt(!may && is_page ? "/pair.html" : path);
    if (file == nullptr) return refuse(http::status::not_found);
    Response response(http::status::ok, request.version());
    response.set(http::field::content_type, beast::string_view(file->kind().data(), file->kind().size()));
    response.keep_alive(request.keep_alive());
    if (request.method() == http::verb::get) response.body() = file->text;
    const auto size = file->text.size();
    const bool is_head = request.method() == http::verb::head;
    write(std::move(response), is_head ? std::optional(size) : std::nullopt);
  }

  void pair(const Request& request) {
    if (plain(request["X-Molar"]) != "1") return refuse(http::status::forbidden);
    const std::int64_t asked = server_.hub().pair(request.body().substr(0, 16));
    beast::get_lowest_layer(stream_).expires_after(kRequestTime);
    server_.awaitPairing(asked, [self = this->shared_from_this()](const PageHub::Paired& told) {
      Response response(told.token.empty() ? http::status::forbidden : http::status::ok, 11);
      response.set(http::field::content_type, "text/plain; charset=utf-8");
      if (!told.token.empty()) response.set(http::field::set_cookie, PageGate::cookieOf(told.token));
      response.body() = told.token.empty() ? told.why : "paired";
      response.keep_alive(true);
      self->write(std::move(response), {});
    });
  }

  void refuse(http::status status) {
    Response response(status, 11);
    response.set(http::field::content_type, "text/plain; charset=utf-8");
    response.body() = "refused\n";
    response.keep_alive(false);
    write(std::move(response), {});
  }

  void write(Response made, std::optional<std::size_t> size_of_head) {
    response_ = std::move(made);
    for (const auto& [name, value] : PageGate::headers())
      response_.set(beast::string_view(name.data(), name.size()), beast::string_view(value.data(), value.size()));
    response_.prepare_payload();
    if (size_of_head) response_.content_length(*size_of_head);
    serializer_.emplace(response_);
    const auto then = [self = this->shared_from_this()](Failure failed, std::size_t) {
      if (failed) return;
      if (self->response_.need_eof()) return self->end();
      self->read();
    };
    if (size_of_head)
      http::async_write_header(stream_, *serializer_, then);
    else
      http::async_write(stream_, *serializer_, then);
  }

  void end() {
    Failure ignored;
    beast::get_lowest_layer(stream_).socket().shutdown(Tcp::socket::shutdown_send, ignored);
  }

  Server& server_;
  Stream stream_;
  beast::flat_buffer in_{kMostHeader + kMostBody};
  std::optional<http::request_parser<http::string_body>> parser_;
  Response response_;
  std::optional<http::response_serializer<http::string_body>> serializer_;
};

int portOf(int listener) {
  sockaddr_storage bound{};
  socklen_t size = sizeof bound;
  if (::getsockname(listener, reinterpret_cast<sockaddr*>(&bound), &size) != 0)
    throw SessionError("page: it was given no socket, it is started by molar evaluate");
  // At the same place for both families.
  return ntohs(reinterpret_cast<const sockaddr_in*>(&bound)->sin_port);
}

bool isOfSix(int listener) {
  sockaddr_storage bound{};
  socklen_t size = sizeof bound;
  return ::getsockname(listener, reinterpret_cast<sockaddr*>(&bound), &size) == 0 && bound.ss_family == AF_INET6;
}

Server::Server(const PageOptions& options)
    : acceptor_(context_, isOfSix(options.listener) ? Tcp::v6() : Tcp::v4(), options.listener),
      session_(context_, net::local::stream_protocol(), options.words),
      bell_(context_, options.bell),
      beat_(context_),
      ending_(context_),
      is_shared_(options.identity >= 0),
      pictures_(options.pictures),
      gate_(portOf(options.listener), is_shared_) {
  if (is_shared_) {
    std::string identity;
    std::array<char, 4096> bytes{};
    // By place: another process may have read it before.
    for (ssize_t got = 0;
         (got = ::pread(options.identity, bytes.data(), bytes.size(), static_cast<off_t>(identity.size()))) > 0;)
      identity.append(bytes.data(), static_cast<std::size_t>(got));
    tls_.use_private_key(net::buffer(identity), net::ssl::context::pem);
    tls_.use_certificate(net::buffer(identity), net::ssl::context::pem);
    ::SSL_CTX_set_min_proto_version(tls_.native_handle(), TLS1_3_VERSION);
  }
  hearSession();
  hearBell();
  tellSession(R"({"kind":"ready"})");
  beat();
  accept();
}

void Server::accept() {
  acceptor_.async_accept([this](Failure failed, Tcp::socket socket) {
    if (!failed && connections_ < kMostConnections) {
      Failure ignored;
      socket.set_option(Tcp::no_delay(true), ignored);
      beast::tcp_stream stream(std::move(socket));
      if (is_shared_)
        std::make_shared<WebSession<beast::ssl_stream<beast::tcp_stream>>>(
            *this, beast::ssl_stream<beast::tcp_stream>(std::move(stream), tls_))
            ->handshake([](auto& web) { web.read(); });
      else
        std::make_shared<WebSession<beast::tcp_stream>>(*this, std::move(stream))->read();
    }
    accept();
  });
}

void Server::hearSession() {
  session_.async_read_some(net::buffer(heard_), [this](Failure failed, std::size_t got) {
    if (failed || !reader_.add(std::span(heard_.data(), got))) return context_.stop();
    while (const auto text = reader_.next())
      if (!hub_.tell(*text)) end();
    pump();
    hearSession();
  });
}

/// The last state is on its way to the pages.
void Server::end() {
  constexpr std::chrono::milliseconds kLastWords{200};
  pump();
  ending_.expires_after(kLastWords);
  ending_.async_wait([this](Failure) { context_.stop(); });
}

void Server::tellSession(const std::string& text) {
  // Where the session does not hear, pages say it again.
  if (out_.size() + sending_.size() > kMostToSession) return;
  out_ += framed(text);
  sendToSession();
}

void Server::sendToSession() {
  if (!sending_.empty() || out_.empty()) return;
  sending_ = std::exchange(out_, {});
  net::async_write(session_, net::buffer(sending_), [this](Failure failed, std::size_t) {
    if (failed) return context_.stop();
    sending_.clear();
    sendToSession();
  });
}

void Server::hearBell() {
  bell_.async_read_some(net::buffer(&rings_, sizeof rings_), [this](Failure failed, std::size_t) {
    if (failed) return;
    pump();
    hearBell();
  });
}

void Server::beat() {
  beat_.expires_after(kBeat);
  beat_.async_wait([this](Failure failed) {
    if (failed) return;
    sayAlive();
    for (const auto& [number, client] : std::map(clients_))
      if (const auto one = client.lock(); one && one->isStuck()) one->drop();
    pump();
    beat();
  });
}

void Server::pump() {
  for (const std::string& text : hub_.takeUp()) tellSession(text);
  for (const PageHub::Paired& told : hub_.takePaired())
    if (auto found = pairings_.extract(told.request); !found.empty()) found.mapped()(told);
  if (hub_.wantsPicture()) {
    if (const auto picture = pictures_.newer(pictured_)) {
      pictured_ = picture->serial;
      hub_.show(picture->serial, picture->t_ns, jpeg_.of(*picture));
    }
    pictures_.ask();
  }
  for (const int number : hub_.takeUnwelcome())
    if (const auto found = clients_.find(number); found != clients_.end())
      if (const auto one = found->second.lock()) one->drop();
  for (const auto& [number, client] : std::map(clients_))
    if (const auto one = client.lock()) one->send();
}

}  // namespace

int runPage(const PageOptions& options) {
  stepAside({options.listener, options.pictures, options.bell, options.words, options.identity});
  try {
    Server(options).run();
  } catch (const boost::system::system_error& error) {
    throw SessionError(std::string("page: ") + error.what() + "; it is started by molar evaluate");
  }
}

}  // namespace app
