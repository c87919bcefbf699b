// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <arpa/inet.h>
#include <netinet/in.h>
#include <sys/socket.h>
#include <sys/time.h>
#include <unistd.h>

#include <array>
#include <cstdint>
#include <cstring>
#include <stop_token>
#include <string>
#include <string_view>
#include <thread>
#include <utility>

#include "serve/http/server.hpp"

namespace strake::serve::test {

/// A connection to a port of this machine, over which any bytes can be sent.
class Client {
 public:
  explicit Client(std::uint16_t port, int patience_s = 20)
      : descriptor_(::socket(AF_INET, SOCK_STREAM | SOCK_CLOEXEC, 0)) {
    const timeval patience{.tv_sec = patience_s, .tv_usec = 0};
    ::setsockopt(descriptor_, SOL_SOCKET, SO_RCVTIMEO, &patience, sizeof patience);
    sockaddr_in at{};
    at.sin_family = AF_INET;
    at.sin_port = htons(port);
    at.sin_addr.s_addr = htonl(INADDR_LOOPBACK);
    sockaddr address{};
    std::memcpy(&address, &at, sizeof at);
    connected_ = ::connect(descriptor_, &address, sizeof at) == 0;
  }
  ~Client() { ::close(descriptor_); }
  Client(const Client&) = delete;
  Client& operator=(const Client&) = delete;
  Client(Client&&) = delete;
  Client& operator=(Client&&) = delete;

  [[nodiscard]] bool connected() const { return connected_; }
  /// False where the other end does not take it.
  bool send(std::string_view text) const {
    while (!text.empty()) {
      const ssize_t sent = ::send(descriptor_, text.data(), text.size(), MSG_NOSIGNAL);
      if (sent <= 0) return false;
      text.remove_prefix(static_cast<std::size_t>(sent));
    }
    return true;
  }
  /// Returns the next answer, head and body; what came of it where the connection ends.
  std::string receive() {
    std::string got;
    for (;;) {
      if (const std::size_t head = got.find("\r\n\r\n"); head != std::string::npos) {
        const std::size_t at = got.find("Content-Length: ");
        const std::size_t length =
            at < head ? std::stoul(got.substr(at + std::strlen("Content-Length: "))) : 0;
        if (got.size() >= head + 4 + length) return got;
      }
      std::array<char, 65536> piece{};
      const ssize_t read = ::recv(descriptor_, piece.data(), piece.size(), 0);
      if (read <= 0) return got;
      got.append(piece.data(), static_cast<std::size_t>(read));
    }
  }
  std::string exchange(std::string_view text) {
    send(text);
    return receive();
  }

 private:
  int descriptor_;
  bool connected_ = false;
};

/// The code of an answer; 0 where there is none.
inline int code_of(const std::string& answer) {
  constexpr std::string_view kVersion = "HTTP/1.1 ";
  return answer.starts_with(kVersion) ? std::stoi(answer.substr(kVersion.size(), 3)) : 0;
}

inline std::string body_of(const std::string& answer) {
  const std::size_t head = answer.find("\r\n\r\n");
  return head == std::string::npos ? std::string() : answer.substr(head + 4);
}

/// A server that runs while this lives.
class Served {
 public:
  Served(Server server, RequestHandler& service)
      : server_(std::move(server)), thread_([this, &service](const std::stop_token& stop) {
          ended_well_ = server_.serve(service, stop).has_value();
        }) {}
  [[nodiscard]] std::uint16_t port() const { return server_.port(); }
  /// Ends it; whether it ended well.
  bool stop() {
    thread_.request_stop();
    thread_.join();
    return ended_well_;
  }

 private:
  Server server_;
  bool ended_well_ = false;
  std::jthread thread_;
};

}  // namespace strake::serve::test
