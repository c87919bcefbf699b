// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <algorithm>
#include <cstddef>
#include <cstdint>
#include <string>
#include <string_view>

#include "strake/core/result.hpp"
#include "strake/drawing/write.hpp"
#include "strake/parallel/progress.hpp"
#include "strake/parallel/transform.hpp"

namespace strake::drawing {

/// Progress of all batches as one, where nobody tells it already.
class Phase {
 public:
  Phase(parallel::Progress* progress, std::string_view name, std::uint64_t total)
      : progress_(progress != nullptr && progress->begin(name, total) ? progress : nullptr) {}
  ~Phase() {
    if (progress_ != nullptr) progress_->end();
  }
  Phase(const Phase&) = delete;
  Phase& operator=(const Phase&) = delete;
  void add(std::uint64_t items) const {
    if (progress_ != nullptr) progress_->add(items);
  }

 private:
  parallel::Progress* progress_;
};

/// Writes n items in order whose bytes are made in parallel: encode(begin, end, out) appends those
/// of a run. The bytes of 65,536 items are held at a time. Errors: cancelled, out of memory.
template <class Encode>
[[nodiscard]] Status write_in_batches(std::string_view name, std::size_t n, Encode&& encode,
                                      Sink sink, const parallel::Context& context) {
  constexpr std::size_t kRun = 1024, kRuns = 64;
  const Phase phase(context.progress, name, n);
  for (std::size_t first = 0; first < n; first += kRun * kRuns) {
    const std::size_t left = std::min(n - first, kRun * kRuns);
    const auto texts = parallel::transform(
        context, {.name = name, .n = (left + kRun - 1) / kRun}, [&](std::size_t run) {
          const std::size_t begin = first + run * kRun;
          std::string out;
          encode(begin, std::min(begin + kRun, first + left), out);
          return out;
        });
    if (!texts) return texts.error();
    for (const std::string& text : *texts) sink(text);
    phase.add(left);
  }
  return {};
}

}  // namespace strake::drawing
