// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <array>
#include <cstddef>
#include <cstdint>
#include <span>
#include <string>
#include <string_view>
#include <vector>

#include "strake/core/diagnostics.hpp"
#include "strake/core/result.hpp"
#include "strake/io/reader.hpp"
#include "strake/model/model.hpp"
#include "strake/parallel/context.hpp"
#include "strake/project/project.hpp"
#include "strake/report/clash.hpp"
#include "strake/report/file_match.hpp"

/// What changed from one state of a model to the next, and projects that follow their files.
///
///     Result<project::Update> done = project::update(*project, {.when = "2026-05-04T22:00:00Z"},
///                                                    context);
///     std::cout << project::changes_text(done->changes, {});
namespace strake::project {

/// What may have become of an object.
enum class ChangeKind : std::uint8_t {
  added,
  removed,
  moved,         ///< the same shapes at another place
  reshaped,      ///< other shapes
  reattributed,  ///< another attribute of its own or of a group above, name, path, colour, category
  renamed,       ///< the same shapes at the same place under another lasting id
};
inline constexpr std::size_t kChangeKinds = 6;

/// Returns how every output spells it: "added", …
[[nodiscard]] std::string_view change_name(ChangeKind kind);

/// An object that has changed.
struct ObjectChange {
  static constexpr std::uint32_t kNone = 0xffffffffU;

  /// Where it is; of an object that was added or removed, that of one model is empty.
  struct Name {
    std::string file, id, name;
    friend bool operator==(const Name&, const Name&) = default;
  };

  std::uint8_t kinds = 0;  ///< a bit for each kind: an object may be both moved and re-attributed
  std::uint32_t then = kNone, now = kNone;  ///< its numbers in the two models
  Name before, after;

  [[nodiscard]] bool is(ChangeKind kind) const {
    return (kinds >> static_cast<unsigned>(kind) & 1U) != 0;
  }
  /// Returns its name now; of an object that was removed, the one that it had.
  [[nodiscard]] const Name& name() const { return now == kNone ? before : after; }
  friend bool operator==(const ObjectChange&, const ObjectChange&) = default;
};

/// What changed from one model to another.
struct Changes {
  report::FileMatches files;  ///< which file of one was taken for which of the other
  /// By name().file and name().id, as models order their objects; of equal ones what was removed
  /// comes first.
  std::vector<ObjectChange> objects;
  std::array<std::uint64_t, kChangeKinds> counts{};  ///< of objects; one may have several kinds
  std::uint64_t unchanged = 0;                       ///< objects that are what they were

  [[nodiscard]] std::uint64_t count(ChangeKind kind) const {
    return counts[static_cast<std::size_t>(kind)];
  }
};

/// Tells which file of one model is which of the other: by label, then by what is in them
/// (report::match_files()); what `given_pairs` says, as OLD=NEW, comes first. Errors: usage, for
/// what is asked; cancelled.
[[nodiscard]] Result<report::FileMatches> match_files(const model::Model& then,
                                                      const model::Model& now,
                                                      std::span<const std::string> given_pairs,
                                                      const parallel::Context& context);

/// Compares two finished models by content, of which hashes of 128 bits are taken: nothing is
/// rounded.
///
/// 1. Within files that are matched, objects of one id are one. An id that only counts elements of
///    its file (model::Object::positional_id) is believed last: where it leads to the same shapes
///    at the same place, or where nothing else does.
/// 2. Objects that are left over are one, renamed, where they have the same shapes at the same
///    place; several that are alike, in the order of their ids. An object without bodies is not
///    known by them. Another id that only counts is no change.
/// 3. A mesh whose corners are all displaced by the same vector, as far as the numbers of its
///    source tell, has moved: formats without placements state it so.
///
/// The result is the same for any team. O(n log n). Errors: cancelled, memory.
[[nodiscard]] Result<Changes> compare(const model::Model& then, const model::Model& now,
                                      report::FileMatches files, const parallel::Context& context);

/// Writes the document of schemas/project-changes.schema.json, one object a line.
void write_changes_json(const Changes& changes, report::Sink sink);
/// Writes one header line and one line per object and kind of change (RFC 4180).
void write_changes_csv(const Changes& changes, report::Sink sink);

struct ChangesTable {
  std::size_t width = 100;  ///< columns of the terminal
  std::size_t rows = 20;    ///< objects of each kind that are shown at most
};

/// Returns what changed for a terminal: files, counts, and the first objects of each kind.
[[nodiscard]] std::string changes_text(const Changes& changes, const ChangesTable& table);

/// Who requests a change of the model, and when.
struct RevisionNote {
  std::string when;  ///< UTC as ISO 8601, "2026-05-04T22:00:00Z"
};

/// A change of the model that the project remembers.
struct Revision {
  std::int64_t id = 0;
  std::string when;
  std::string what;  ///< "add", "update", "remove"
  std::array<std::uint64_t, kChangeKinds> counts{};
  std::uint64_t unchanged = 0;
};

struct Update {
  Changes changes;
  std::vector<std::string> read;  ///< labels of the files that were read
  Diagnostics noticed;            ///< by reading them
  Revision revision;              ///< id 0: nothing changed, and nothing was stored
};

/// Adds files; all their objects count as added, and are not listed. Errors: usage for a file that
/// the project has; those of io::read_models() and of writing. After an error the project is as it
/// was.
[[nodiscard]] Result<Update> add_model_files(Project& project,
                                             std::span<const io::FileToRead> files,
                                             const RevisionNote& note,
                                             const parallel::Context& context);

/// Removes files by their labels; their objects are counted and not listed. Errors: usage for a
/// label that no file has, with those that there are; those of writing. After an error the project
/// is as it was.
[[nodiscard]] Result<Update> remove_model_files(Project& project,
                                                std::span<const std::string> labels,
                                                const RevisionNote& note,
                                                const parallel::Context& context);

/// What update() reads.
struct UpdateRequest {
  /// Files that take the place of those that they match: by path, as `given_pairs`, by name, or by
  /// what is in them. What is not said of one is as it was said of the file before. None: every
  /// file of the project, where it lies.
  std::vector<io::FileToRead> files;
  std::vector<std::string> given_pairs;  ///< OLD=NEW
};

/// Reads again the files whose bytes changed, or that are read with other options or from another
/// place than before, stores them in one transaction, and tells what changed. Clashes and decisions
/// of renamed files follow. Errors: usage for a file that matches none, or several; input where a
/// file is gone; those of io::read_models() and of writing. After an error the project is as it
/// was.
[[nodiscard]] Result<Update> update(Project& project, const UpdateRequest& request,
                                    const RevisionNote& note, const parallel::Context& context);

/// Returns what the project remembers of changes of its model, the latest first.
[[nodiscard]] Result<std::vector<Revision>> revisions(Project& project);

}  // namespace strake::project
