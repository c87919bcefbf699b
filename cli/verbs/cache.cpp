// SPDX-License-Identifier: Apache-2.0
#include <fmt/format.h>

#include <CLI/CLI.hpp>
#include <array>
#include <chrono>
#include <cstdint>
#include <memory>
#include <nlohmann/json.hpp>
#include <optional>
#include <string>
#include <string_view>

#include "cli/verbs/verb.hpp"
#include "core/text_encoding.hpp"
#include "core/units.hpp"
#include "io/importer/scene_cache.hpp"
#include "strake/io/importer.hpp"

namespace strake::cli {

namespace {

using Json = nlohmann::ordered_json;
using std::chrono::seconds;

constexpr int kCacheSchemaVersion = 1;

/// Parses "30d", "12h" or "90min".
Result<seconds> parse_age(const std::string& text) {
  struct Unit {
    std::string_view name;
    double seconds;
  };
  constexpr std::array<Unit, 4> kUnits{{{"d", 86400}, {"h", 3600}, {"min", 60}, {"s", 1}}};
  constexpr double kMax = 1e10;  // some centuries
  if (const std::optional<Quantity> age = parse_quantity(text))
    for (const Unit& unit : kUnits)
      if (const double all = age->number * unit.seconds;
          age->unit == unit.name && all >= 0 && all <= kMax)
        return seconds(static_cast<std::int64_t>(all));
  return Error{ErrorCode::usage, in_quotes(text) + " is no time", "--older-than",
               "write it as 30d, 12h or 90min"};
}

std::string age_text(seconds age) {
  constexpr std::int64_t kMinute = 60, kHour = 3600, kDay = 86400;
  const std::int64_t s = age.count();
  if (s >= 2 * kDay) return fmt::format("{} days", s / kDay);
  if (s >= 2 * kHour) return fmt::format("{} hours", s / kHour);
  return fmt::format("{} min", s / kMinute);
}

std::string megabytes(std::uint64_t bytes) {
  constexpr double kMegabyte = 1e6;
  return fmt::format("{:.1f} MB", static_cast<double>(bytes) / kMegabyte);
}

Json folder_json(const io::ImportSettings& settings) {
  return settings.cache ? Json(settings.cache->string()) : Json();
}

std::string dumped(const Json& json) {
  return json.dump(2, ' ', false, Json::error_handler_t::replace) + "\n";
}

std::string list_json(const io::ImportSettings& settings, const std::vector<io::KeptScene>& kept) {
  Json scenes = Json::array();
  std::uint64_t bytes = 0;
  for (const io::KeptScene& scene : kept) {
    bytes += scene.bytes;
    scenes.push_back({{"scene", scene.path.filename().string()},
                      {"file", scene.facts.file},
                      {"format", scene.facts.scene.format},
                      {"made_by", scene.facts.scene.made_by},
                      {"bytes", scene.bytes},
                      {"unused_s", scene.unused.count()}});
  }
  return dumped({{"schema_version", kCacheSchemaVersion},
                 {"folder", folder_json(settings)},
                 {"limit_bytes", settings.cache_bytes},
                 {"bytes", bytes},
                 {"scenes", std::move(scenes)}});
}

std::string list_text(const io::ImportSettings& settings, const std::vector<io::KeptScene>& kept) {
  if (!settings.cache) return "no scenes are kept: STRAKE_CACHE is off, or there is no HOME\n";
  std::string text;
  std::uint64_t bytes = 0;
  for (const io::KeptScene& scene : kept) {
    bytes += scene.bytes;
    const std::string& maker = scene.facts.scene.made_by;
    const std::string by = scene.facts.importer.empty() ? std::string("is damaged")
                           : maker.empty()              ? std::string()
                                                        : "made by " + maker;
    text += fmt::format("{:>12}  unused for {:<9}  {}  {} {}\n", megabytes(scene.bytes),
                        age_text(scene.unused), printable(scene.facts.file),
                        printable(scene.facts.scene.format), printable(by));
  }
  return text + fmt::format("{} {} in {}, {} of {}\n", kept.size(),
                            kept.size() == 1 ? "scene" : "scenes", settings.cache->string(),
                            megabytes(bytes), megabytes(settings.cache_bytes));
}

struct CacheOptions {
  std::string older_than;
};

Result<ExitCode> run_list(Session& session) {
  const Result<io::ImportSettings> settings = io::import_settings_of_environment();
  if (!settings) return settings.error();
  const std::vector<io::KeptScene> kept =
      settings->cache ? io::list_scenes(*settings->cache) : std::vector<io::KeptScene>();
  const Status written = session.write_stdout(session.json() ? list_json(*settings, kept)
                                                             : list_text(*settings, kept));
  if (!written) return written.error();
  return ExitCode::done;
}

Result<ExitCode> run_clear(Session& session, const CacheOptions& options) {
  seconds unused{0};
  if (!options.older_than.empty()) {
    const Result<seconds> age = parse_age(options.older_than);
    if (!age) return age.error();
    unused = *age;
  }
  const Result<io::ImportSettings> settings = io::import_settings_of_environment();
  if (!settings) return settings.error();
  io::Cleared cleared;
  if (settings->cache) {
    const Result<io::Cleared> done = io::clear_scenes(*settings->cache, unused);
    if (!done) return done.error();
    cleared = *done;
  }
  const std::string text = session.json() ? dumped({{"schema_version", kCacheSchemaVersion},
                                                    {"folder", folder_json(*settings)},
                                                    {"removed", cleared.scenes},
                                                    {"bytes", cleared.bytes}})
                                          : fmt::format("removed {} {}, {}\n", cleared.scenes,
                                                        cleared.scenes == 1 ? "scene" : "scenes",
                                                        megabytes(cleared.bytes));
  if (const Status written = session.write_stdout(text); !written) return written.error();
  return ExitCode::done;
}

}  // namespace

std::vector<Verb> add_cache_verbs(CLI::App& program, CommonOptions& common) {
  CLI::App* const command = program.add_subcommand(
      "cache", "The scenes that importers made of IFC and other files, kept for the next run");
  command->require_subcommand(1);
  command->footer(R"(
The folder is $XDG_CACHE_HOME/strake/scenes; STRAKE_CACHE=DIR names another, STRAKE_CACHE=off none,
and STRAKE_CACHE_LIMIT=20GB says how large all of them may be: the least recently used go first.

'strake cache clear --help' tells its options.)");
  CLI::App* const list = command->add_subcommand("list", "The scenes, the latest used first");
  add_common_options(*list, common);
  list->footer("\nExample:\n  strake cache list");
  const auto options = std::make_shared<CacheOptions>();
  CLI::App* const clear = command->add_subcommand("clear", "Remove the scenes");
  clear
      ->add_option("--older-than", options->older_than,
                   "Only those that no run has used for so long: 30d, 12h, 90min")
      ->type_name("TIME");
  add_common_options(*clear, common);
  clear->footer("\nExample:\n  strake cache clear --older-than 30d");
  return {{list, [](Session& session) { return run_list(session); }},
          {clear, [options](Session& session) { return run_clear(session, *options); }}};
}

}  // namespace strake::cli
