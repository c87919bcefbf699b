// SPDX-License-Identifier: Apache-2.0
#include "project/history/last_document.hpp"

#include <sstream>
#include <string_view>
#include <utility>
#include <vector>

#include "core/text_encoding.hpp"
#include "project/history/last_run.hpp"
#include "project/results/run_records.hpp"
#include "project/results/stored_tests.hpp"
#include "strake/report/clash.hpp"

namespace strake::project {
namespace {

Result<std::vector<std::string>> selected_tests(Database& database,
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

}  // namespace

Result<report::ClashDocument> last_document(Database& database,
                                            const std::optional<std::string>& test,
                                            const parallel::Context& context) {
  const Result<std::vector<std::string>> tests = selected_tests(database, test);
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
