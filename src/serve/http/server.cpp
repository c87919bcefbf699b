// SPDX-License-Identifier: Apache-2.0
#include "serve/http/server.hpp"

#include <microhttpd.h>
#include <poll.h>
#include <sys/socket.h>

#include <algorithm>
#include <array>
#include <cerrno>
#include <charconv>
#include <exception>
#include <map>
#include <optional>
#include <set>
#include <string>
#include <utility>

#include "serve/http/wake.hpp"

namespace strake::serve {

namespace {

using Clock = std::chrono::steady_clock;

constexpr std::chrono::milliseconds kLongestWait{1000};
/// How long it is until what waits is asked again.
constexpr std::chrono::milliseconds kPollInterval{50};

/// A request that comes in.
struct HttpExchange {
  Request request;
  bool is_answered = false;
  std::optional<Clock::time_point> waits_since = std::nullopt;  ///< whole, and not answered yet
};

/// A connection, and how long it may go on as it does.
struct Connection {
  int descriptor = -1;
  Clock::time_point until;
};

MHD_Result add_field(void* fields, MHD_ValueKind /*kind*/, const char* name, const char* value) {
  try {
    static_cast<Fields*>(fields)->emplace_back(name == nullptr ? "" : name,
                                               value == nullptr ? "" : value);
    return MHD_YES;
  } catch (const std::exception&) {
    return MHD_NO;
  }
}

/// Leaves text as it was sent, where the library would decode it.
std::size_t as_sent(void* /*closure*/, MHD_Connection* /*connection*/, char* text) {
  return std::string_view(text).size();
}

using SharedText = std::shared_ptr<const std::string>;

void forget_text(void* text) { delete static_cast<SharedText*>(text); }

/// Puts an answer on its way. The body is shared and not copied.
MHD_Result send(MHD_Connection* connection, const Answer& answer) {
  auto text = std::make_unique<SharedText>(answer.body);
  MHD_Response* const response = MHD_create_response_from_buffer_with_free_callback_cls(
      (*text)->size(), const_cast<char*>((*text)->data()), forget_text, text.get());
  if (response == nullptr) return MHD_NO;
  static_cast<void>(text.release());
  MHD_Result sent =
      MHD_add_response_header(response, MHD_HTTP_HEADER_CONTENT_TYPE, answer.type.c_str());
  for (const auto& [name, value] : answer.headers)
    if (sent == MHD_YES) sent = MHD_add_response_header(response, name.c_str(), value.c_str());
  if (sent == MHD_YES)
    sent = MHD_queue_response(connection, static_cast<unsigned>(answer.status), response);
  MHD_destroy_response(response);
  return sent;
}

}  // namespace

struct Server::State {
  explicit State(const ServerLimits& given) : limits(given) {}
  State(const State&) = delete;
  State& operator=(const State&) = delete;
  State(State&&) = delete;
  State& operator=(State&&) = delete;
  ~State() {
    if (daemon == nullptr) return;
    resume_waiting();
    MHD_stop_daemon(daemon);
  }

  static MHD_Result on_request(void* self, MHD_Connection* connection, const char* url,
                               const char* method, const char* /*version*/, const char* data,
                               std::size_t* size, void** exchange) {
    try {
      State& state = *static_cast<State*>(self);
      if (*exchange == nullptr) return state.begin(connection, url, method, exchange);
      return state.go_on(connection, {data, *size}, *size, *static_cast<HttpExchange*>(*exchange));
    } catch (const std::exception&) {  // no memory: the connection is closed
      return MHD_NO;
    }
  }

  static void on_end(void* self, MHD_Connection* connection, void** exchange,
                     MHD_RequestTerminationCode why) {
    delete static_cast<HttpExchange*>(*exchange);
    *exchange = nullptr;
    // Another request may follow on the same connection.
    State& state = *static_cast<State*>(self);
    state.waiting.erase(connection);
    if (why == MHD_REQUEST_TERMINATED_COMPLETED_OK)
      state.allow(connection, state.limits.silence, state.limits.sending);
  }

  static void on_connection(void* self, MHD_Connection* connection, void** /*context*/,
                            MHD_ConnectionNotificationCode what) {
    State& state = *static_cast<State*>(self);
    if (what == MHD_CONNECTION_NOTIFY_CLOSED) {
      state.connections.erase(connection);
      return;
    }
    const MHD_ConnectionInfo* const info =
        MHD_get_connection_info(connection, MHD_CONNECTION_INFO_CONNECTION_FD);
    if (info == nullptr) return;
    try {
      state.connections[connection] = {info->connect_fd, Clock::now() + state.limits.sending};
    } catch (const std::exception&) {  // no memory: its silence alone is limited
    }
  }

  /// From now on a connection may be silent and take for what it does so long.
  void allow(MHD_Connection* connection, std::chrono::seconds silence, std::chrono::seconds time) {
    MHD_set_connection_option(connection, MHD_CONNECTION_OPTION_TIMEOUT,
                              static_cast<unsigned>(silence.count()));
    if (const auto at = connections.find(connection); at != connections.end())
      at->second.until = Clock::now() + time;
  }

  MHD_Result answer(MHD_Connection* connection, const Answer& text, HttpExchange& exchange) {
    exchange.is_answered = true;
    // An answer that took long to make is not the client's silence.
    allow(connection, limits.receiving, limits.receiving);
    return send(connection, text);
  }

  /// Answers a request that is whole, or lets its connection rest until it is asked again.
  MHD_Result answer_or_wait(MHD_Connection* connection, HttpExchange& exchange) {
    const Clock::time_point now = Clock::now();
    if (!exchange.waits_since) exchange.waits_since = now;
    const auto waited =
        std::chrono::duration_cast<std::chrono::milliseconds>(now - *exchange.waits_since);
    if (const auto made = service->answer_or_wait(exchange.request, waited))
      return answer(connection, *made, exchange);
    waiting.insert(connection);
    // It is not the client that takes its time.
    allow(connection, limits.silence, limits.sending);
    MHD_suspend_connection(connection);
    return MHD_YES;
  }

  /// Has the next run ask again what waits.
  void resume_waiting() {
    for (MHD_Connection* const connection : waiting) MHD_resume_connection(connection);
    waiting.clear();
  }

  /// The headers are there.
  MHD_Result begin(MHD_Connection* connection, const char* url, const char* method,
                   void** exchange) {
    auto made = std::make_unique<HttpExchange>();
    made->request.method = method;
    made->request.path = url;
    MHD_get_connection_values(connection, MHD_HEADER_KIND, add_field, &made->request.headers);
    MHD_get_connection_values(connection, MHD_GET_ARGUMENT_KIND, add_field,
                              &made->request.arguments);
    HttpExchange& begun = *made;
    *exchange = made.release();
    if (const auto refusal = service->refuse(begun.request))
      return answer(connection, *refusal, begun);
    if (const auto refusal = refuse_body(begun.request)) return answer(connection, *refusal, begun);
    return MHD_YES;
  }

  /// Looks at how long the body says that it is.
  [[nodiscard]] std::optional<Answer> refuse_body(const Request& request) const {
    const auto length = request.header(MHD_HTTP_HEADER_CONTENT_LENGTH);
    if (request.count(MHD_HTTP_HEADER_TRANSFER_ENCODING) > 0 ||
        (!length && request.method != MHD_HTTP_METHOD_GET))
      return text_answer(HttpStatus::length_required, "the request does not say how long it is");
    if (!length) return std::nullopt;
    std::size_t bytes = 0;
    const auto [end, fault] =
        std::from_chars(length->data(), length->data() + length->size(), bytes);
    if (fault != std::errc() || end != length->data() + length->size() || bytes > limits.body_bytes)
      return text_answer(HttpStatus::too_large, "the request is too large");
    return std::nullopt;
  }

  /// A piece of the body is there, or all of it was.
  MHD_Result go_on(MHD_Connection* connection, std::string_view piece, std::size_t& size,
                   HttpExchange& exchange) {
    if (size == 0 && !exchange.is_answered) return answer_or_wait(connection, exchange);
    // What a client sends to its end although it was refused is not kept.
    if (!exchange.is_answered) {
      if (exchange.request.body.size() + piece.size() > limits.body_bytes) return MHD_NO;
      exchange.request.body += piece;
    }
    size = 0;
    return MHD_YES;
  }

  /// Ends connections that take too long; the library notices, and closes them. For `busy` the
  /// server itself was at work, which is not their fault.
  void end_overdue(Clock::duration busy) {
    const Clock::time_point now = Clock::now();
    for (auto& [connection, at] : connections) {
      at.until += busy;
      if (at.until < now) ::shutdown(at.descriptor, SHUT_RDWR);
    }
  }

  /// Returns how long to wait for bytes, in milliseconds.
  [[nodiscard]] int wait_ms() const {
    MHD_UNSIGNED_LONG_LONG wait = 0;
    const auto longest = static_cast<MHD_UNSIGNED_LONG_LONG>(
        (waiting.empty() ? kLongestWait : kPollInterval).count());
    if (MHD_get_timeout(daemon, &wait) != MHD_YES) wait = longest;
    return static_cast<int>(std::min(wait, longest));
  }

  ServerLimits limits;
  std::uint16_t port = 0;
  MHD_Daemon* daemon = nullptr;
  RequestHandler* service = nullptr;  ///< while it serves
  std::map<MHD_Connection*, Connection> connections;
  std::set<MHD_Connection*> waiting;  ///< suspended
  Clock::time_point last_poll;        ///< when what waits was resumed last
};

Server::Server(std::unique_ptr<State> state) : state_(std::move(state)) {}
Server::~Server() = default;
Server::Server(Server&&) noexcept = default;
Server& Server::operator=(Server&&) noexcept = default;

std::uint16_t Server::port() const { return state_->port; }

Result<Server> Server::listen(std::uint16_t port, const ServerLimits& limits) {
  Result<LoopbackSocket> socket = LoopbackSocket::listen(port);
  if (!socket) return socket.error();
  auto state = std::make_unique<State>(limits);
  state->port = socket->port();
  state->daemon = MHD_start_daemon(
      MHD_USE_EPOLL | MHD_ALLOW_SUSPEND_RESUME, 0, nullptr, nullptr, &State::on_request,
      state.get(), MHD_OPTION_LISTEN_SOCKET,
      socket->descriptor(),                                                          //
      MHD_OPTION_CONNECTION_LIMIT, limits.connections,                               //
      MHD_OPTION_CONNECTION_MEMORY_LIMIT, limits.head_bytes,                         //
      MHD_OPTION_CONNECTION_TIMEOUT, static_cast<unsigned>(limits.silence.count()),  //
      MHD_OPTION_STRICT_FOR_CLIENT, 1,                                               //
      MHD_OPTION_NOTIFY_COMPLETED, &State::on_end, state.get(),                      //
      MHD_OPTION_NOTIFY_CONNECTION, &State::on_connection, state.get(),              //
      MHD_OPTION_UNESCAPE_CALLBACK, &as_sent, nullptr,                               //
      MHD_OPTION_END);
  if (state->daemon == nullptr)
    return Error{ErrorCode::output, "cannot be served", "127.0.0.1:" + std::to_string(port), {}};
  // It closes what it listens on.
  static_cast<void>(socket->release());
  return Server(std::move(state));
}

Status Server::serve(RequestHandler& service, const std::stop_token& stop) {
  state_->service = &service;
  const Wake wake(stop);
  const MHD_DaemonInfo* const info = MHD_get_daemon_info(state_->daemon, MHD_DAEMON_INFO_EPOLL_FD);
  if (info == nullptr)
    return Error{ErrorCode::internal, "the server has nothing to wait for", {}, {}};
  std::array<pollfd, 2> files{{{.fd = info->epoll_fd, .events = POLLIN, .revents = 0},
                               {.fd = wake.descriptor(), .events = POLLIN, .revents = 0}}};
  while (!stop.stop_requested()) {
    if (::poll(files.data(), files.size(), state_->wait_ms()) < 0 && errno != EINTR)
      return Error{ErrorCode::internal, "the server cannot wait for its clients", {}, {}};
    const Clock::time_point begun = Clock::now();
    if (begun - state_->last_poll >= kPollInterval) {
      state_->resume_waiting();
      state_->last_poll = begun;
    }
    if (MHD_run(state_->daemon) != MHD_YES)
      return Error{ErrorCode::internal, "the server cannot go on", {}, {}};
    state_->end_overdue(Clock::now() - begun);
  }
  return {};
}

}  // namespace strake::serve
