// SPDX-License-Identifier: Apache-2.0
#include "arguments.hpp"

#include <algorithm>
#include <string>
#include <string_view>

#include "core/number.hpp"
#include "core/text_encoding.hpp"

namespace strake::import_step {
namespace {

constexpr std::string_view kUsage =
    "call it with --input FILE --output SCENE.glb --report REPORT.jsonl, and --threads N and --sag "
    "MM where wanted";

Error wrong(const std::string& message) {
  return {ErrorCode::usage, message, "", std::string(kUsage)};
}

}  // namespace

Result<Arguments> parse_arguments(std::span<char*> words) {
  constexpr long long kMaxThreads = 1024;
  constexpr double kFinest = 1e-3, kCoarsest = 1e6;
  Arguments arguments;
  for (std::size_t i = 1; i < words.size(); i += 2) {
    const std::string_view name = words[i];
    if (i + 1 == words.size()) return wrong(in_quotes(name) + " needs a value");
    const std::string_view value = words[i + 1];
    if (name == "--input") {
      arguments.input = value;
    } else if (name == "--output") {
      arguments.output = value;
    } else if (name == "--report") {
      arguments.report = value;
    } else if (name == "--threads") {
      const auto threads = parse_integer(value);
      if (!threads || *threads < 1) return wrong(in_quotes(value) + " is no number of threads");
      arguments.threads = static_cast<unsigned>(std::min(*threads, kMaxThreads));
    } else if (name == "--sag") {
      const auto sag = parse_number(value);
      if (!sag || !(*sag >= kFinest && *sag <= kCoarsest))
        return wrong(in_quotes(value) + " is no sag: it is in mm, 0.001 at least");
      arguments.sag_mm = *sag;
    } else {
      return wrong(in_quotes(name) + " is no option");
    }
  }
  if (arguments.input.empty() || arguments.output.empty() || arguments.report.empty())
    return wrong("it lacks --input, --output or --report");
  return arguments;
}

}  // namespace strake::import_step
