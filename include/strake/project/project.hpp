// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstddef>
#include <cstdint>
#include <filesystem>
#include <memory>
#include <span>
#include <string>
#include <vector>

#include "strake/clash/incremental.hpp"
#include "strake/core/hash.hpp"
#include "strake/core/result.hpp"
#include "strake/io/reader.hpp"
#include "strake/model/model.hpp"
#include "strake/parallel/context.hpp"

/// The project file: models, views, tests, results and decisions in one SQLite database.
/// docs/project.md describes it.
namespace strake::project {

class Database;

enum class Access : std::uint8_t { read, write };

struct OpenOptions {
  Access access = Access::read;
  /// How long to wait for another process that writes, seconds.
  double wait_s = 0;
};

/// A model file as the project last read it.
struct StoredFile {
  std::int64_t id = 0;
  std::filesystem::path path;  ///< where it is read again from, absolute
  std::string given;           ///< the path by which it was given: diagnostics name it so
  io::ReadOptions options;
  Hash128 content;  ///< of its bytes, and of those of the files that are read with it
  model::SourceFile source;
  std::uint64_t objects = 0, bodies = 0;
};

/// A model with hashes of its shapes that were made when they were stored.
struct SignedModel {
  model::Model model;
  /// Of each shape, over all that there is of a mesh or of polylines; zeros for a primitive. Two
  /// models of projects have equal hashes where shapes are equal, to the last bit, and only there.
  std::vector<Hash128> shape_hashes;
  /// Of the labels of files and of all that their objects are but bodies: two models of projects
  /// with equal ones have the same objects, by label, id, name and number.
  Hash128 names = {};
  /// Of the bodies of each block that is stored, with what numbers of shapes mean there.
  std::vector<clash::HashedBodies> bodies = {};
};

/// Whether the file begins as a project does: the program takes it where it takes model files.
[[nodiscard]] bool is_project(const std::filesystem::path& file);

/// An open project. It may be moved; one thread uses it at a time.
class Project {
 public:
  /// Makes an empty project. Errors: output where the file exists or cannot be written.
  [[nodiscard]] static Result<Project> create(const std::filesystem::path& file);
  /// Errors: input for a file that is no project, of a newer version, or damaged; busy (output)
  /// where another process writes and `wait_s` is over.
  [[nodiscard]] static Result<Project> open(const std::filesystem::path& file,
                                            const OpenOptions& options);
  ~Project();
  Project(Project&&) noexcept;
  Project& operator=(Project&&) noexcept;

  [[nodiscard]] const std::filesystem::path& path() const;
  [[nodiscard]] Database& database();
  /// Returns the files in the order of their labels.
  [[nodiscard]] Result<std::vector<StoredFile>> files();
  /// Returns the model that io::read_models() returned for these files, finished.
  [[nodiscard]] Result<model::Model> model(const parallel::Context& context);
  /// Returns the same, with what the project knows of its shapes.
  [[nodiscard]] Result<SignedModel> signed_model(const parallel::Context& context);

 private:
  struct State;
  explicit Project(std::unique_ptr<State> state);
  std::unique_ptr<State> state_;
};

}  // namespace strake::project
