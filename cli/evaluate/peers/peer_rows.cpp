// SPDX-License-Identifier: Apache-2.0
#include "cli/evaluate/peers/peer_rows.hpp"

#include <algorithm>
#include <cmath>
#include <cstdint>
#include <limits>
#include <nlohmann/json.hpp>
#include <utility>

#include "cli/evaluate/peers/peer_row_members.hpp"
#include "strake/core/atomic_file.hpp"

namespace strake::cli {

namespace {

constexpr int kRowsSchemaVersion = 1;

Error no_peer_rows(const std::string& name, const std::string& what) {
  return Error{ErrorCode::input, "these are no rows of a peer program: " + what, name,
               "build the peer programs and strake from the same sources"};
}

/// Says which count of a row, as it is written, is none; empty: each is one. Without this a
/// negative number would be read as a huge one.
std::string fault_of_counts(const nlohmann::json& row) {
  struct Count {
    const char* name;
    std::uint64_t largest;
  };
  for (const auto& [name, largest] : {Count{"objects", std::numeric_limits<std::uint64_t>::max()},
                                      Count{"triangles", std::numeric_limits<std::uint64_t>::max()},
                                      Count{"threads", std::numeric_limits<unsigned>::max()}}) {
    const nlohmann::json& value = row.at(name);
    if (!value.is_number_unsigned() || value.get<std::uint64_t>() > largest)
      return "\"" + std::string(name) + "\" is " + value.dump() + ", which is no count";
  }
  return {};
}

/// Says what cannot be in a row; empty: nothing.
std::string fault_of(const PeerRow& row) {
  if (std::ranges::find(kPeerOutcomes, row.outcome) == kPeerOutcomes.end())
    return "there is no outcome '" + row.outcome + "'";
  for (const double seconds : {row.cpu_s, row.wall_s, row.ours_cpu_s, row.ours_wall_s})
    if (!(seconds >= 0) || !std::isfinite(seconds)) return "'" + row.who + "' has a time below 0";
  const bool has_times = row.wall_s > 0 && row.ours_cpu_s > 0;
  if (row.outcome == kMeasured && !has_times)
    return "'" + row.who + "' is measured and has no time";
  if (row.outcome == kMeasured && !std::isfinite(row.cpu_s / row.ours_cpu_s))
    return "'" + row.who + "' has times that cannot be compared";
  if (row.outcome != kMeasured && (row.cpu_s > 0 || row.wall_s > 0))
    return "'" + row.who + "' has a time without a result that agrees";
  return {};
}

}  // namespace

std::string peer_rows_json(const std::vector<PeerRow>& rows) {
  nlohmann::json document;
  document["schema_version"] = kRowsSchemaVersion;
  document["rows"] = rows;
  return document.dump(1, ' ', false, nlohmann::json::error_handler_t::replace) + "\n";
}

Result<std::vector<PeerRow>> parse_peer_rows(std::string_view text, const std::string& name) {
  const nlohmann::json document = nlohmann::json::parse(text, nullptr, false);
  if (document.is_discarded()) return no_peer_rows(name, "its text is no JSON, or ends early");
  try {
    if (document.at("schema_version") != kRowsSchemaVersion)
      return no_peer_rows(name, "its schema_version is another");
    for (const nlohmann::json& row : document.at("rows"))
      if (const std::string fault = fault_of_counts(row); !fault.empty())
        return no_peer_rows(name, fault);
    auto rows = document.at("rows").get<std::vector<PeerRow>>();
    for (const PeerRow& row : rows)
      if (const std::string fault = fault_of(row); !fault.empty()) return no_peer_rows(name, fault);
    return rows;
  } catch (const nlohmann::json::exception& error) {
    return no_peer_rows(name, error.what());
  }
}

Status PeerRowFile::add(PeerRow row) {
  if (file_.empty()) return {};
  rows_.push_back(std::move(row));
  return write_file(file_, peer_rows_json(rows_));
}

}  // namespace strake::cli
