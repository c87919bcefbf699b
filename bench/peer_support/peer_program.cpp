// SPDX-License-Identifier: Apache-2.0
#include "peer_support/peer_program.hpp"

#include <fmt/format.h>

#include <nlohmann/json.hpp>
#include <optional>
#include <utility>

#include "io/importer/child_process.hpp"

namespace strake::bench {
namespace {

using io::ChildEnd;

/// What a script exits with where its program is not installed.
constexpr int kNotInstalled = 77;
constexpr std::string_view kMark = "RESULT ";
/// How much of what a program wrote says why it failed.
constexpr std::size_t kTail = 300;

/// What the line with the result says.
std::optional<ProgramReply> reply_in(std::string_view output) {
  const std::size_t begin = output.find(kMark);
  if (begin == std::string_view::npos) return std::nullopt;
  const std::string_view line = output.substr(begin + kMark.size());
  try {
    const auto json = nlohmann::json::parse(line.substr(0, line.find('\n')));
    ProgramReply reply;
    reply.version = json.at("version");
    reply.cpu_s = json.at("cpu_s");
    reply.wall_s = json.at("wall_s");
    reply.load_s = json.at("load_s");
    return reply;
  } catch (const nlohmann::json::exception&) {
    return std::nullopt;
  }
}

ProgramReply without_answer(std::string_view outcome, std::string why) {
  ProgramReply reply;
  reply.outcome = outcome;
  reply.why = std::move(why);
  return reply;
}

}  // namespace

ProgramReply run_program(std::vector<std::string> words, double limit_s,
                         const std::filesystem::path& log) {
  // In our group, so that what ends us ends it.
  const ChildEnd end = io::run_child({.words = std::move(words),
                                      .limit_s = limit_s,
                                      .log = log,
                                      .folder = {},
                                      .killed_with = io::KilledWith::nothing,
                                      .may_go_on = {}},
                                     {});
  if (end.how == ChildEnd::How::not_started ||
      (end.how == ChildEnd::How::exited && end.code == kNotInstalled))
    return without_answer(cli::kNotThere, "not installed");
  if (end.how == ChildEnd::How::over_limit)
    return without_answer(cli::kOverLimit, fmt::format("gave up after {} s", limit_s));
  std::optional<ProgramReply> reply = reply_in(end.output);
  if (end.how == ChildEnd::How::exited && end.code == 0 && reply) return std::move(*reply);
  return without_answer(cli::kFailed, "failed: " + io::tail_of(end.output, kTail));
}

}  // namespace strake::bench
