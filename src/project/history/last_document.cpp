// SPDX-License-Identifier: Apache-2.0
#include "project/history/last_document.hpp"

#include <sstream>
#include <string_view>
#include <utility>
#include <vector>

#include "core/text_encoding.hpp"
#include "project/results/run_records.hpp"
#include "project/results/stored_tests.hpp"
#include "strake/report/clash.hpp"

namespace strake::project {
namespace {

/// The results of tests of one run, and the model that it ran over.
struct LastRun {
  clash::Findings findings;
  model::Model model;
  std::optional<RunRecord> record;
};

Error no_result(const Database& database) {
  return {ErrorCode::usage, "has no result of a clash test", database.file().string(),
          "'strake clash -p' makes one"};
}

Error no_names(const Database& database) {
  return {ErrorCode::usage,
          "its last result is of an earlier version of Strake, and not known with the names of all "
          "objects",
          database.file().string(), "run 'strake clash -p' once more"};
}

Result<std::vector<std::string>> tests_to_tell(Database& database,
                                               const std::optional<std::string>& test) {
  if (!test) return last_tests(database);
  const Result<std::vector<std::string>> names = test_names(database);
  if (!names) return names.error();
  std::string there;
  for (const std::string& name : *names) {
    if (name == *test) return std::vector<std::string>{name};
    there += (there.empty() ? "there are " : ", ") + in_quotes(name);
  }
  return Error{ErrorCode::usage, "no test is called " + in_quotes(*test), database.file().string(),
               there.empty() ? "'strake clash -p' runs tests" : there};
}

Result<LastRun> read_last_run(Database& database, const std::vector<std::string>& tests,
                              const parallel::Context& context) {
  LastRun run;
  for (const std::string& name : tests) {
    Result<std::optional<StoredTest>> stored = read_test(database, name, context);
    if (!stored) return stored.error();
    if (!*stored) return no_result(database);
    StoredTest& test = **stored;
    Result<std::optional<model::Model>> model = read_test_objects(database, test);
    if (!model) return model.error();
    if (!*model) return no_names(database);
    if (!run.findings.tests.empty() && (**model).objects.size() != run.model.objects.size())
      return database.damaged("the tests of one run are of different models");
    run.model = std::move(**model);
    test.results.report.name = name;
    run.findings.tests.push_back(std::move(test.results.report));
    Result<std::optional<RunRecord>> record = read_run_record(database, test.run);
    if (!record) return record.error();
    run.record = std::move(*record);
  }
  return run;
}

}  // namespace

Result<report::ClashDocument> last_document(Database& database,
                                            const std::optional<std::string>& test,
                                            const parallel::Context& context) {
  const Result<std::vector<std::string>> tests = tests_to_tell(database, test);
  if (!tests) return tests.error();
  if (tests->empty()) return no_result(database);
  const Result<LastRun> run = read_last_run(database, *tests, context);
  if (!run) return run.error();
  report::ClashContents contents{run->findings, run->model};
  if (run->record && run->record->rules) contents.rules = &*run->record->rules;
  std::stringstream text;
  const Status written =
      report::write_clash_json(contents, [&](std::string_view piece) { text << piece; }, context);
  if (!written) return written.error();
  return report::parse_clash_document(text, database.file().string());
}

}  // namespace strake::project
