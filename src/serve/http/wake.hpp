// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <memory>
#include <stop_token>

namespace strake::serve {

/// A descriptor that becomes readable when a stop is requested, for what waits for descriptors.
class Wake {
 public:
  explicit Wake(const std::stop_token& stop);
  ~Wake();
  Wake(const Wake&) = delete;
  Wake& operator=(const Wake&) = delete;
  Wake(Wake&&) = delete;
  Wake& operator=(Wake&&) = delete;

  /// Returns -1 where the system gives none: then a wait has to end by itself.
  [[nodiscard]] int descriptor() const;

 private:
  struct State;
  std::unique_ptr<State> state_;
};

}  // namespace strake::serve
