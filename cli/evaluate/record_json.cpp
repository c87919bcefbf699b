// SPDX-License-Identifier: Apache-2.0
#include "cli/evaluate/record_json.hpp"

#include <fmt/format.h>

#include <filesystem>
#include <fstream>
#include <nlohmann/json.hpp>
#include <sstream>
#include <system_error>

namespace strake::cli {

namespace {

using Json = nlohmann::ordered_json;

constexpr int kSchemaVersion = 1;

Json to_json(const parallel::RegionReport& region) {
  return {{"name", region.name},          {"runs", region.runs},
          {"items", region.items},        {"wall_s", region.wall_s},
          {"busy_s", region.busy_s},      {"nested_cpu_s", region.nested_cpu_s},
          {"share_s", region.share_s},    {"least_s", region.least_s},
          {"longest_s", region.longest_s}};
}

parallel::RegionReport region_of(const Json& json) {
  parallel::RegionReport region;
  json.at("name").get_to(region.name);
  json.at("runs").get_to(region.runs);
  json.at("items").get_to(region.items);
  json.at("wall_s").get_to(region.wall_s);
  json.at("busy_s").get_to(region.busy_s);
  json.at("nested_cpu_s").get_to(region.nested_cpu_s);
  json.at("share_s").get_to(region.share_s);
  json.at("least_s").get_to(region.least_s);
  json.at("longest_s").get_to(region.longest_s);
  return region;
}

Json to_json(const ContenderRecord& one) {
  Json regions = Json::array();
  for (const parallel::RegionReport& region : one.regions) regions.push_back(to_json(region));
  return {{"name", one.name},
          {"threads", one.threads},
          {"seconds", one.seconds},
          {"cpu_s", one.cpu_s},
          {"peak_bytes", one.peak_bytes},
          {"counters", one.counters},
          {"hash", one.hash},
          {"published_hash", one.published_hash},
          {"unfinished", one.unfinished},
          {"shared_wall_s", one.shared_wall_s},
          {"regions", std::move(regions)}};
}

ContenderRecord contender_of(const Json& json) {
  ContenderRecord one;
  json.at("name").get_to(one.name);
  json.at("threads").get_to(one.threads);
  json.at("seconds").get_to(one.seconds);
  json.at("cpu_s").get_to(one.cpu_s);
  json.at("peak_bytes").get_to(one.peak_bytes);
  json.at("counters").get_to(one.counters);
  json.at("hash").get_to(one.hash);
  json.at("published_hash").get_to(one.published_hash);
  json.at("unfinished").get_to(one.unfinished);
  json.at("shared_wall_s").get_to(one.shared_wall_s);
  for (const Json& region : json.at("regions")) one.regions.push_back(region_of(region));
  return one;
}

Json to_json(const CaseRecord& one) {
  Json stages = Json::array();
  for (const StageRecord& stage : one.stages) {
    Json contenders = Json::array();
    for (const ContenderRecord& contender : stage.contenders)
      contenders.push_back(to_json(contender));
    stages.push_back({{"name", stage.name},
                      {"reference_s", stage.reference_s},
                      {"differences", stage.differences},
                      {"contenders", std::move(contenders)}});
  }
  return {{"name", one.name},     {"title", one.title},         {"objects", one.objects},
          {"bodies", one.bodies}, {"triangles", one.triangles}, {"stages", std::move(stages)}};
}

CaseRecord case_of(const Json& json) {
  CaseRecord one;
  json.at("name").get_to(one.name);
  json.at("title").get_to(one.title);
  json.at("objects").get_to(one.objects);
  json.at("bodies").get_to(one.bodies);
  json.at("triangles").get_to(one.triangles);
  for (const Json& from : json.at("stages")) {
    StageRecord stage;
    from.at("name").get_to(stage.name);
    from.at("reference_s").get_to(stage.reference_s);
    from.at("differences").get_to(stage.differences);
    for (const Json& contender : from.at("contenders"))
      stage.contenders.push_back(contender_of(contender));
    one.stages.push_back(std::move(stage));
  }
  return one;
}

StudyRecord study_of(const Json& json) {
  StudyRecord study;
  json.at("name").get_to(study.name);
  json.at("title").get_to(study.title);
  json.at("question").get_to(study.question);
  json.at("columns").get_to(study.columns);
  json.at("rows").get_to(study.rows);
  json.at("differences").get_to(study.differences);
  return study;
}

Error damaged(const std::string& name, const std::string& what) {
  return Error{ErrorCode::input, "this is no evaluation: " + what, name,
               "name a file evaluation.json that 'strake evaluate' wrote"};
}

}  // namespace

std::string evaluation_json(const EvaluationRecord& record) {
  Json cases = Json::array();
  for (const CaseRecord& one : record.cases) cases.push_back(to_json(one));
  Json studies = Json::array();
  for (const StudyRecord& study : record.studies)
    studies.push_back({{"name", study.name},
                       {"title", study.title},
                       {"question", study.question},
                       {"columns", study.columns},
                       {"rows", study.rows},
                       {"differences", study.differences}});
  const Json document{{"schema_version", kSchemaVersion},
                      {"machine",
                       {{"processor", record.machine.processor},
                        {"hardware_threads", record.machine.hardware_threads},
                        {"memory_bytes", record.machine.memory_bytes},
                        {"system", record.machine.system},
                        {"compiler", record.machine.compiler},
                        {"version", record.machine.version},
                        {"program", record.machine.program}}},
                      {"settings",
                       {{"scale", record.settings.scale},
                        {"threads", record.settings.threads},
                        {"repeat", record.settings.repeat},
                        {"limit_s", record.settings.limit_s}}},
                      {"cases", std::move(cases)},
                      {"studies", std::move(studies)}};
  return document.dump(1, ' ', false, Json::error_handler_t::replace) + "\n";
}

Result<EvaluationRecord> parse_evaluation(std::string_view text, const std::string& name) {
  const Json json = Json::parse(text, nullptr, false);
  if (json.is_discarded()) return damaged(name, "its text is no JSON, or ends early");
  try {
    if (json.at("schema_version") != kSchemaVersion)
      return damaged(name, "its schema_version is another");
    EvaluationRecord record;
    const Json& machine = json.at("machine");
    machine.at("processor").get_to(record.machine.processor);
    machine.at("hardware_threads").get_to(record.machine.hardware_threads);
    machine.at("memory_bytes").get_to(record.machine.memory_bytes);
    machine.at("system").get_to(record.machine.system);
    machine.at("compiler").get_to(record.machine.compiler);
    machine.at("version").get_to(record.machine.version);
    machine.at("program").get_to(record.machine.program);
    const Json& settings = json.at("settings");
    settings.at("scale").get_to(record.settings.scale);
    settings.at("threads").get_to(record.settings.threads);
    settings.at("repeat").get_to(record.settings.repeat);
    settings.at("limit_s").get_to(record.settings.limit_s);
    for (const Json& one : json.at("cases")) record.cases.push_back(case_of(one));
    for (const Json& one : json.at("studies")) record.studies.push_back(study_of(one));
    return record;
  } catch (const Json::exception& error) {
    return damaged(name, error.what());
  }
}

Result<EvaluationRecord> read_evaluation(const std::string& file) {
  std::error_code failure;
  const std::ifstream in(file, std::ios::binary);
  std::ostringstream text;
  if (!in || std::filesystem::is_directory(file, failure) || !(text << in.rdbuf()))
    return Error{ErrorCode::input, "cannot be read, or is empty", file,
                 "name a file evaluation.json that 'strake evaluate' wrote"};
  return parse_evaluation(text.view(), file);
}

}  // namespace strake::cli
