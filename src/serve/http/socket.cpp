// SPDX-License-Identifier: Apache-2.0
#include "serve/http/socket.hpp"

#include <arpa/inet.h>
#include <netinet/in.h>
#include <sys/socket.h>
#include <unistd.h>

#include <cerrno>
#include <cstring>
#include <string>
#include <system_error>
#include <utility>

namespace strake::serve {
namespace {

constexpr int kWaiting = 64;  ///< connections that wait until they are taken

Error cannot_listen(std::uint16_t port) {
  const std::string where = "127.0.0.1:" + std::to_string(port);
  if (errno == EADDRINUSE)
    return {ErrorCode::output, "the port is in use by another program", where,
            "choose another one, or leave --port out for one that is free"};
  return {ErrorCode::output,
          "cannot be listened on: " + std::error_code(errno, std::generic_category()).message(),
          where, "choose a port from 1024 to 65535, or leave --port out"};
}

}  // namespace

Result<LoopbackSocket> LoopbackSocket::listen(std::uint16_t port) {
  LoopbackSocket made(::socket(AF_INET, SOCK_STREAM | SOCK_CLOEXEC | SOCK_NONBLOCK, 0));
  if (made.descriptor_ < 0) return cannot_listen(port);
  // A port whose last connections are still ending is free; one that is listened on is not.
  const int on = 1;
  if (::setsockopt(made.descriptor_, SOL_SOCKET, SO_REUSEADDR, &on, sizeof on) != 0)
    return cannot_listen(port);
  sockaddr_in at{};
  at.sin_family = AF_INET;
  at.sin_port = htons(port);
  at.sin_addr.s_addr = htonl(INADDR_LOOPBACK);
  sockaddr address{};
  std::memcpy(&address, &at, sizeof at);
  if (::bind(made.descriptor_, &address, sizeof at) != 0 ||
      ::listen(made.descriptor_, kWaiting) != 0)
    return cannot_listen(port);
  socklen_t size = sizeof address;
  if (::getsockname(made.descriptor_, &address, &size) != 0) return cannot_listen(port);
  std::memcpy(&at, &address, sizeof at);
  made.port_ = ntohs(at.sin_port);
  return made;
}

LoopbackSocket::~LoopbackSocket() {
  if (descriptor_ >= 0) ::close(descriptor_);
}

LoopbackSocket::LoopbackSocket(LoopbackSocket&& other) noexcept
    : descriptor_(std::exchange(other.descriptor_, -1)), port_(other.port_) {}

int LoopbackSocket::release() { return std::exchange(descriptor_, -1); }

}  // namespace strake::serve
