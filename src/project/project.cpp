// SPDX-License-Identifier: Apache-2.0
#include "strake/project/project.hpp"

#include <algorithm>
#include <new>
#include <utility>

#include "project/database/database.hpp"
#include "project/database/file_facts.hpp"
#include "project/database/opening.hpp"
#include "project/model/file_rows.hpp"
#include "project/model/load_model.hpp"

namespace strake::project {

struct Project::State {
  std::unique_ptr<Database> database;
};

Project::Project(std::unique_ptr<State> state) : state_(std::move(state)) {}
Project::~Project() = default;
Project::Project(Project&&) noexcept = default;
Project& Project::operator=(Project&&) noexcept = default;

bool is_project(const std::filesystem::path& file) {
  const auto head = read_head(file);
  return head && head->is_project;
}

Result<Project> Project::create(const std::filesystem::path& file) {
  try {
    if (const Status made = make_project_file(file); !made) return made.error();
  } catch (const std::bad_alloc&) {
    return out_of_memory();
  }
  return open(file, {.access = Access::write});
}

Result<Project> Project::open(const std::filesystem::path& file, const OpenOptions& options) {
  try {
    Result<std::unique_ptr<Database>> database = Database::open(file, options);
    if (!database) return database.error();
    auto state = std::make_unique<State>();
    state->database = std::move(*database);
    return Project(std::move(state));
  } catch (const std::bad_alloc&) {
    return out_of_memory();
  }
}

const std::filesystem::path& Project::path() const { return state_->database->file(); }
Database& Project::database() { return *state_->database; }

Result<std::vector<StoredFile>> Project::files() {
  try {
    Result<std::vector<FileRow>> rows = read_sealed_rows(database());
    if (!rows) return rows.error();
    std::vector<StoredFile> files;
    files.reserve(rows->size());
    for (FileRow& row : *rows) files.push_back(std::move(row.file));
    std::ranges::sort(files, {}, [](const StoredFile& f) { return f.source.label; });
    return files;
  } catch (const std::bad_alloc&) {
    return out_of_memory();
  }
}

Result<model::Model> Project::model(const parallel::Context& context) {
  Result<SignedModel> model = signed_model(context);
  if (!model) return model.error();
  return std::move(model->model);
}

Result<SignedModel> Project::signed_model(const parallel::Context& context) {
  try {
    const Result<ReadScope> scope = ReadScope::begin(database());
    if (!scope) return scope.error();
    Result<SignedModel> model = load_model(database(), context);
    if (!model) return model;
    if (const Status whole = database().check_unchanged(); !whole) return whole.error();
    return model;
  } catch (const std::bad_alloc&) {
    return out_of_memory();
  }
}

}  // namespace strake::project
