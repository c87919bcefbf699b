// SPDX-License-Identifier: Apache-2.0
#include "strake/project/check.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cstddef>
#include <optional>
#include <string>
#include <string_view>
#include <utility>
#include <vector>

#include "project/check/check_results.hpp"
#include "project/database/database.hpp"
#include "project/model/shape_packs.hpp"
#include "project/results/clash_rows.hpp"
#include "project/results/stored_tests.hpp"
#include "project/views/stored_views.hpp"
#include "strake/model/model.hpp"

namespace strake::project {
namespace {

/// Whether an error says nothing about the project.
bool is_of_the_run(const Error& error) {
  return error.code == ErrorCode::cancelled || error.code == ErrorCode::memory;
}

class ProjectCheck {
 public:
  ProjectCheck(Project& project, const parallel::Context& context)
      : project_(project), context_(context) {}

  Result<std::vector<Fault>> run() {
    database();
    references();
    model();
    if (const Status status = check_packs(project_.database(), context_); !status)
      add("shapes", status.error());
    tests();
    clashes();
    views();
    drawings();
    if (of_the_run_) return *std::move(of_the_run_);
    return std::move(faults_);
  }

 private:
  void add(std::string_view where, const Error& error) {
    if (is_of_the_run(error))
      of_the_run_ = error;
    else
      faults_.push_back({std::string(where), error.text()});
  }

  /// Calls take(row) for each row of a query.
  template <class Take>
  void each_row(std::string_view where, std::string_view sql, const Take& take) {
    Result<Statement> rows = project_.database().prepare(sql);
    if (!rows) return add(where, rows.error());
    for (;;) {
      const Result<bool> more = rows->step();
      if (!more) return add(where, more.error());
      if (!*more) return;
      take(*rows);
    }
  }

  void database() {
    if (const Status whole = project_.database().check_end(); !whole)
      add("database", whole.error());
    each_row("database", "PRAGMA integrity_check", [&](const Statement& row) {
      if (row.text(0) != "ok") faults_.push_back({"database", std::string(row.text(0))});
    });
  }

  void references() {
    each_row("database", "PRAGMA foreign_key_check", [&](const Statement& row) {
      faults_.push_back({fmt::format("table {}", row.text(0)),
                         fmt::format("row {} refers to none of {}", row.integer(1), row.text(2))});
    });
  }

  void model() {
    const Result<std::vector<StoredFile>> files = project_.files();
    if (!files) return add("files", files.error());
    if (files->empty()) return;
    const Result<model::Model> model = project_.model(context_);
    if (!model) return add("model", model.error());
    count_objects(*files, *model);
  }

  void count_objects(const std::vector<StoredFile>& files, const model::Model& model) {
    std::vector<std::uint64_t> objects(model.files.size()), bodies(model.files.size());
    for (const model::Object& object : model.objects) {
      ++objects[object.file];
      bodies[object.file] += object.body_count;
    }
    for (const StoredFile& file : files) {
      const auto found =
          std::ranges::find(model.files, file.source.label, &model::SourceFile::label);
      const auto f = static_cast<std::size_t>(found - model.files.begin());
      if (found == model.files.end())
        faults_.push_back({file.source.label, "is not in the model"});
      else if (objects[f] != file.objects || bodies[f] != file.bodies)
        faults_.push_back({file.source.label,
                           fmt::format("has {} objects and {} bodies, and should have {} and {}",
                                       objects[f], bodies[f], file.objects, file.bodies)});
    }
  }

  void tests() {
    const Result<std::vector<std::string>> names = test_names(project_.database());
    if (!names) return add("tests", names.error());
    for (const std::string& name : *names) {
      const Result<std::optional<StoredTest>> test = read_test(project_.database(), name, context_);
      const std::string where = name.empty() ? "test" : "test " + name;
      if (!test) add(where, test.error());
      if (test && *test) rows_of(**test, where);
    }
  }

  /// A word that is none is found by whoever lists the clashes, and by no test.
  void clashes() {
    each_row("clashes", fmt::format("SELECT {} FROM clash", kClashColumns),
             [&](const Statement& row) {
               if (const Result<ClashRow> clash = row_of(project_.database(), row); !clash)
                 add(fmt::format("clash {}", row.text(2)), clash.error());
             });
  }

  void views() {
    each_row("views",
             "SELECT name FROM view WHERE CASE WHEN json_valid(settings) THEN json_type(settings) "
             "ELSE '' END <> 'object' ORDER BY name",
             [&](const Statement& row) {
               faults_.push_back(
                   {fmt::format("view {}", row.text(0)), "its options are no JSON object"});
             });
  }

  void drawings() {
    const Result<std::vector<DamagedView>> damaged = check_views(project_.database(), context_);
    if (!damaged) return add("views", damaged.error());
    for (const DamagedView& view : *damaged) add(fmt::format("view {}", view.view), view.error);
  }

  void rows_of(const StoredTest& test, const std::string& where) {
    if (const Result<std::optional<model::Model>> named =
            read_test_objects(project_.database(), test);
        !named)
      add(where, named.error());
    Result<std::vector<std::string>> faults = check_rows(project_.database(), test);
    if (!faults) return add(where, faults.error());
    for (std::string& fault : *faults) faults_.push_back({where, std::move(fault)});
  }

  Project& project_;
  const parallel::Context& context_;
  std::vector<Fault> faults_;
  std::optional<Error> of_the_run_;
};

}  // namespace

Result<std::vector<Fault>> check(Project& project, const parallel::Context& context) {
  return ProjectCheck(project, context).run();
}

}  // namespace strake::project
