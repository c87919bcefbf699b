// SPDX-License-Identifier: Apache-2.0
#include "cli/evaluate/record_json.hpp"

#include <nlohmann/json.hpp>

#include "cli/evaluate/peers/peer_row_members.hpp"
#include "io/source/input_file.hpp"

// The members of the document are those of the records.
namespace strake::parallel {

NLOHMANN_DEFINE_TYPE_NON_INTRUSIVE(RegionReport, name, runs, items, wall_s, busy_s, nested_cpu_s,
                                   share_s, least_s, longest_s)

}  // namespace strake::parallel

namespace strake::cli {

NLOHMANN_DEFINE_TYPE_NON_INTRUSIVE(Machine, processor, hardware_threads, memory_bytes, system,
                                   compiler, version, program)
NLOHMANN_DEFINE_TYPE_NON_INTRUSIVE(EvaluationSettings, scale, threads, repeat, limit_s)
NLOHMANN_DEFINE_TYPE_NON_INTRUSIVE(ContenderRecord, name, threads, seconds, cpu_s, peak_bytes,
                                   counters, hash, published_hash, unfinished, shared_wall_s,
                                   alone_s, kernel_alone_s, kernel_s, regions)
NLOHMANN_DEFINE_TYPE_NON_INTRUSIVE(StageRecord, name, reference_s, differences, contenders)
NLOHMANN_DEFINE_TYPE_NON_INTRUSIVE(CaseRecord, name, title, objects, bodies, triangles, stages)
NLOHMANN_DEFINE_TYPE_NON_INTRUSIVE(BarChart::Series, name, values)
NLOHMANN_DEFINE_TYPE_NON_INTRUSIVE(BarChart::Level, label, value)
NLOHMANN_DEFINE_TYPE_NON_INTRUSIVE(BarChart, title, unit, names, series, levels)
NLOHMANN_DEFINE_TYPE_NON_INTRUSIVE(StudyRecord, name, title, question, columns, rows, charts,
                                   differences)
NLOHMANN_DEFINE_TYPE_NON_INTRUSIVE(PeerRecord, name, rows)
NLOHMANN_DEFINE_TYPE_NON_INTRUSIVE(EvaluationRecord, machine, settings, cases, studies, peers)

namespace {

constexpr int kSchemaVersion = 1;

Error damaged(const std::string& name, const std::string& what) {
  return Error{ErrorCode::input, "this is no evaluation: " + what, name,
               "name a file evaluation.json that 'strake evaluate' wrote"};
}

/// Adds what counters that were kept by earlier versions lack.
void complete(nlohmann::json& document) {
  if (!document.contains("peers")) document["peers"] = nlohmann::json::array();
  for (nlohmann::json& one : document.at("cases"))
    for (nlohmann::json& stage : one.at("stages"))
      for (nlohmann::json& run : stage.at("contenders")) {
        if (!run.contains("alone_s")) run["alone_s"] = 0;
        for (const char* const times : {"kernel_alone_s", "kernel_s"})
          if (!run.contains(times)) run[times] = nlohmann::json::array();
      }
}

}  // namespace

std::string evaluation_json(const EvaluationRecord& record) {
  nlohmann::json document = record;
  document["schema_version"] = kSchemaVersion;
  return document.dump(1, ' ', false, nlohmann::json::error_handler_t::replace) + "\n";
}

Result<EvaluationRecord> parse_evaluation(std::string_view text, const std::string& name) {
  nlohmann::json document = nlohmann::json::parse(text, nullptr, false);
  if (document.is_discarded()) return damaged(name, "its text is no JSON, or ends early");
  try {
    if (document.at("schema_version") != kSchemaVersion)
      return damaged(name, "its schema_version is another");
    complete(document);
    return document.get<EvaluationRecord>();
  } catch (const nlohmann::json::exception& error) {
    return damaged(name, error.what());
  }
}

Result<EvaluationRecord> read_evaluation(const std::string& file) {
  const Result<io::FileContent> content = io::FileContent::read(file);
  if (!content) return content.error();
  return parse_evaluation(io::as_text(content->bytes()), file);
}

}  // namespace strake::cli
