// SPDX-License-Identifier: Apache-2.0
#include "strake/parallel/executor.hpp"

namespace strake::parallel {

bool Executor::run(FunctionRef<void(Seat)> body) noexcept {
  if (size_ == 1 || busy_.exchange(true, std::memory_order_acquire)) {
    body(Seat{0, 1});
    return size_ == 1;
  }
  call_all(body);
  busy_.store(false, std::memory_order_release);
  return true;
}

}  // namespace strake::parallel
