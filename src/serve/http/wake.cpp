// SPDX-License-Identifier: Apache-2.0
#include "serve/http/wake.hpp"

#include <sys/eventfd.h>
#include <unistd.h>

#include <cstdint>

namespace strake::serve {

namespace {

/// Makes a descriptor readable. Where that fails, the wait ends by itself.
struct Signal {
  int descriptor = -1;
  void operator()() const noexcept {
    const std::uint64_t one = 1;
    static_cast<void>(::write(descriptor, &one, sizeof one) == sizeof one);
  }
};

}  // namespace

struct Wake::State {
  explicit State(const std::stop_token& stop)
      : descriptor(::eventfd(0, EFD_CLOEXEC | EFD_NONBLOCK)), on_stop(stop, Signal{descriptor}) {}
  int descriptor;
  std::stop_callback<Signal> on_stop;
};

Wake::Wake(const std::stop_token& stop) : state_(std::make_unique<State>(stop)) {}

Wake::~Wake() {
  const int descriptor = state_->descriptor;
  // First nobody writes to it any more.
  state_.reset();
  if (descriptor >= 0) ::close(descriptor);
}

int Wake::descriptor() const { return state_->descriptor; }

}  // namespace strake::serve
