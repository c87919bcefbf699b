// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstdint>

#include "strake/core/result.hpp"

namespace strake::serve {

/// A socket that listens on the loopback address of IPv4, 127.0.0.1, and nowhere else.
class LoopbackSocket {
 public:
  /// Port 0: one that is free. Errors: output where the port is in use or may not be had.
  [[nodiscard]] static Result<LoopbackSocket> listen(std::uint16_t port);
  ~LoopbackSocket();
  LoopbackSocket(LoopbackSocket&& other) noexcept;
  LoopbackSocket& operator=(LoopbackSocket&&) = delete;
  LoopbackSocket(const LoopbackSocket&) = delete;
  LoopbackSocket& operator=(const LoopbackSocket&) = delete;

  [[nodiscard]] std::uint16_t port() const { return port_; }
  [[nodiscard]] int descriptor() const { return descriptor_; }
  /// Gives the descriptor away, for somebody else to close.
  [[nodiscard]] int release();

 private:
  explicit LoopbackSocket(int descriptor) : descriptor_(descriptor) {}
  int descriptor_ = -1;
  std::uint16_t port_ = 0;
};

}  // namespace strake::serve
