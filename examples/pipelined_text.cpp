// SPDX-License-Identifier: Apache-2.0
// Batches of lines made by all workers and written in order, a few batches in memory at a time.
#include <cstddef>
#include <cstdio>
#include <optional>
#include <string>
#include <utility>

#include "strake/parallel/pipeline.hpp"
#include "strake/parallel/team.hpp"

namespace {

using namespace strake::parallel;

constexpr std::size_t kLines = 100'000, kBatch = 1000;

std::string batch_of_lines(std::size_t first) {
  std::string text;
  for (std::size_t i = first; i < first + kBatch; ++i)
    text += std::to_string(i) + ' ' + std::to_string(i * i % 97) + '\n';
  return text;
}

std::string written(const Context& context) {
  std::string file;
  std::size_t next = 0;
  const strake::Status status = pipeline(
      context, {.name = "write", .in_flight = 8},
      [&]() -> std::optional<std::size_t> {
        if (next == kLines) return std::nullopt;
        return std::exchange(next, next + kBatch);
      },
      batch_of_lines, [&](const std::string& text) { file += text; });
  return status ? file : "";
}

}  // namespace

int main() {
  Team team(4);
  const std::string together = written({.team = &team}), alone = written({});
  std::printf("%zu bytes by a team, %zu by one thread\n", together.size(), alone.size());
  return !alone.empty() && together == alone ? 0 : 1;
}
