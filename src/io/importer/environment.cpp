// SPDX-License-Identifier: Apache-2.0
#include <algorithm>
#include <array>
#include <cstdlib>
#include <optional>
#include <string>
#include <string_view>
#include <system_error>
#include <utility>

#include "core/number.hpp"
#include "core/text_encoding.hpp"
#include "core/units.hpp"
#include "strake/io/importer.hpp"

namespace strake::io {
namespace {

namespace fs = std::filesystem;

/// Returns a variable; empty where there is none.
std::string variable(const char* name) {
  const char* const value = std::getenv(name);
  return value == nullptr ? std::string() : std::string(value);
}

/// Returns the folder of the running program, then those of PATH. One that depends on where the
/// program was started is left out: it may hold anybody's programs.
std::vector<fs::path> program_folders() {
  std::vector<fs::path> folders;
  std::error_code failed;
  const fs::path program = fs::read_symlink("/proc/self/exe", failed);
  if (!failed && program.is_absolute()) folders.push_back(program.parent_path());
  const std::string path = variable("PATH");
  std::string_view rest = path;
  while (!rest.empty()) {
    const std::size_t end = std::min(rest.find(':'), rest.size());
    const fs::path folder(rest.substr(0, end));
    if (folder.is_absolute()) folders.push_back(folder);
    rest.remove_prefix(std::min(end + 1, rest.size()));
  }
  return folders;
}

/// Returns the folder of scenes, if they are to be kept and there is a place for them.
std::optional<fs::path> scene_folder() {
  const std::string own = variable("STRAKE_CACHE");
  if (own == "off") return std::nullopt;
  std::error_code failed;
  if (!own.empty()) return fs::absolute(own, failed) / "scenes";
  const fs::path of_user = variable("XDG_CACHE_HOME");
  if (of_user.is_absolute()) return of_user / "strake" / "scenes";
  const fs::path home = variable("HOME");
  if (home.is_absolute()) return home / ".cache" / "strake" / "scenes";
  return std::nullopt;
}

/// Parses "20GB"; a number without a unit counts bytes.
std::optional<std::uint64_t> parse_bytes(std::string_view text) {
  struct Unit {
    std::string_view name;
    double bytes;
  };
  constexpr std::array<Unit, 5> kUnits{
      {{"", 1}, {"kb", 1e3}, {"mb", 1e6}, {"gb", 1e9}, {"tb", 1e12}}};
  constexpr double kMax = 1e18;
  const std::optional<Quantity> quantity = parse_quantity(text);
  if (!quantity) return std::nullopt;
  const auto* const unit = std::ranges::find(kUnits, lowered(quantity->unit), &Unit::name);
  if (unit == kUnits.end()) return std::nullopt;
  const double bytes = quantity->number * unit->bytes;
  if (!(bytes >= 0 && bytes <= kMax)) return std::nullopt;
  return static_cast<std::uint64_t>(bytes);
}

}  // namespace

Result<ImportSettings> import_settings_of_environment() {
  ImportSettings settings;
  settings.folders = program_folders();
  settings.cache = scene_folder();
  if (const std::string text = variable("STRAKE_IMPORT_LIMIT"); !text.empty()) {
    const std::optional<double> seconds = parse_number(text);
    if (!seconds || !(*seconds > 0))
      return Error{ErrorCode::usage, in_quotes(text) + " is no number of seconds",
                   "STRAKE_IMPORT_LIMIT", "write seconds, as 600"};
    settings.silence_s = *seconds;
  }
  if (const std::string text = variable("STRAKE_IMPORT_SAG"); !text.empty()) {
    constexpr double kFinestMm = 0.001;
    const Result<double> length = parse_length_mm(text);
    if (!length || !(*length >= kFinestMm))
      return Error{ErrorCode::usage, in_quotes(text) + " is no length of 1um or more",
                   "STRAKE_IMPORT_SAG", "write it with its unit, as 0.1mm"};
    settings.sag_mm = *length;
  }
  if (const std::string text = variable("STRAKE_CACHE_LIMIT"); !text.empty()) {
    const auto bytes = parse_bytes(text);
    if (!bytes)
      return Error{ErrorCode::usage, in_quotes(text) + " is no amount of bytes",
                   "STRAKE_CACHE_LIMIT", "write it as 20GB or 500MB"};
    settings.cache_bytes = *bytes;
  }
  return settings;
}

}  // namespace strake::io
