// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <chrono>
#include <cstddef>
#include <cstdint>
#include <memory>
#include <stop_token>

#include "serve/http/message.hpp"
#include "serve/http/socket.hpp"
#include "strake/core/result.hpp"

namespace strake::serve {

/// What a client may take.
struct ServerLimits {
  unsigned connections = 128;                       ///< at once; more wait until one ends
  std::size_t head_bytes = std::size_t{64} << 10U;  ///< of a request line and its headers
  std::size_t body_bytes = std::size_t{8} << 20U;
  /// How long a client may be silent, and how long it may take to send a request, slowly or not.
  std::chrono::seconds silence{20}, sending{30};
  /// How long it may take to receive an answer.
  std::chrono::seconds receiving{300};
};

/// Serves HTTP/1.1 on the loopback address, to many clients at once and on the thread that calls:
/// connections take turns as their bytes come and go, so that a slow one keeps nobody waiting.
/// Decision 0101 says why.
class Server {
 public:
  /// Errors: output where the port is not to be had; memory.
  [[nodiscard]] static Result<Server> listen(std::uint16_t port, const ServerLimits& limits = {});
  ~Server();
  Server(Server&&) noexcept;
  Server& operator=(Server&&) noexcept;

  [[nodiscard]] std::uint16_t port() const;
  /// Answers requests until a stop is requested, which is no error. Errors: internal.
  [[nodiscard]] Status serve(RequestHandler& service, const std::stop_token& stop);

 private:
  struct State;
  explicit Server(std::unique_ptr<State> state);
  std::unique_ptr<State> state_;
};

}  // namespace strake::serve
