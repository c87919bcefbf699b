// SPDX-License-Identifier: Apache-2.0
#include "cli/evaluate/machine.hpp"

#include <fmt/format.h>
#include <sys/utsname.h>
#include <unistd.h>

#ifdef __GLIBC__
#include <malloc.h>
#endif

#include <algorithm>
#include <cstdlib>
#include <fstream>
#include <span>
#include <string>
#include <string_view>
#include <vector>

#include "core/stopwatch.hpp"
#include "io/source/input_file.hpp"
#include "strake/core/hash.hpp"
#include "strake/core/version.hpp"
#include "strake/parallel/for_each.hpp"
#include "strake/parallel/team.hpp"

namespace strake::cli {

namespace {

/// Returns what stands behind "key :" in a file of such lines.
std::string value_of(const char* file, std::string_view key) {
  std::ifstream in(file);
  for (std::string line; std::getline(in, line);) {
    if (!line.starts_with(key)) continue;
    const std::size_t colon = line.find(':');
    if (colon == std::string::npos) continue;
    const std::size_t first = line.find_first_not_of(" \t", colon + 1);
    return first == std::string::npos ? std::string() : line.substr(first);
  }
  return {};
}

std::string hash_of_program() {
  const Result<io::FileContent> content = io::FileContent::read("/proc/self/exe");
  return content ? hash_bytes(content->bytes()).text() : std::string();
}

/// Sorts pseudo-random numbers.
void sort_random(std::span<std::uint64_t> numbers, std::uint64_t seed) {
  std::uint64_t state = seed;
  for (std::uint64_t& number : numbers) {
    state ^= state << 13U;  // xorshift64 (Marsaglia 2003)
    state ^= state >> 7U;
    state ^= state << 17U;
    number = state;
  }
  std::ranges::sort(numbers);
}

}  // namespace

Machine this_machine() {
  Machine machine;
  machine.processor = value_of("/proc/cpuinfo", "model name");
  machine.hardware_threads = parallel::default_workers();
  const long pages = ::sysconf(_SC_PHYS_PAGES), page = ::sysconf(_SC_PAGESIZE);
  if (pages > 0 && page > 0)
    machine.memory_bytes = static_cast<std::uint64_t>(pages) * static_cast<std::uint64_t>(page);
  if (utsname system{}; ::uname(&system) == 0)
    machine.system = fmt::format("{} {} {}", system.sysname, system.release, system.machine);
#if defined(__clang__)
  machine.compiler = "Clang " __clang_version__;
#elif defined(__GNUC__)
  machine.compiler = "GCC " __VERSION__;
#endif
  machine.version = version();
  machine.program = hash_of_program();
  return machine;
}

bool reset_peak_memory() {
#ifdef __GLIBC__
  // The program keeps what it freed (keep_freed_memory()): that is not the next one's.
  malloc_trim(0);
#endif
  std::ofstream out("/proc/self/clear_refs");
  out << "5";
  return static_cast<bool>(out.flush());
}

std::uint64_t peak_memory_since_reset() {
  constexpr std::uint64_t kKibibyte = 1024;
  const std::string text = value_of("/proc/self/status", "VmHWM");
  return text.empty() ? 0 : std::strtoull(text.c_str(), nullptr, 10) * kKibibyte;
}

double reference_seconds() {
  constexpr std::size_t kNumbers = 1U << 20U;
  const Stopwatch watch;
  std::vector<std::uint64_t> numbers(kNumbers);
  sort_random(numbers, 1);
  return watch.seconds();
}

double kernel_seconds(const parallel::Context& context) {
  constexpr std::size_t kPieces = 512, kNumbers = 2048;
  // They must be awake, as they are within a run.
  const parallel::Region wake{.name = "kernel", .n = 64};
  if (!parallel::for_each(context, wake, [](std::size_t) {})) return 0;
  const Stopwatch watch;
  const Status done = parallel::for_each_with(
      context, {.name = "kernel", .n = kPieces},
      [] { return std::vector<std::uint64_t>(kNumbers); },
      [](std::vector<std::uint64_t>& numbers, std::size_t i) { sort_random(numbers, i + 1); });
  return done ? watch.seconds() : 0;
}

}  // namespace strake::cli
