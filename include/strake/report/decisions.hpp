// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <array>
#include <cstddef>
#include <cstdint>
#include <filesystem>
#include <optional>
#include <span>
#include <string>
#include <string_view>
#include <utility>
#include <vector>

#include "strake/clash/clash.hpp"
#include "strake/core/hash.hpp"
#include "strake/core/result.hpp"
#include "strake/geometry/vec.hpp"
#include "strake/model/model.hpp"
#include "strake/report/file_match.hpp"

/// What people decided about clashes, in a CSV file that they edit, taken up by the next run.
///
///     const auto file = report::read_decisions("decided.csv");
///     const auto decided = report::decide(findings, model, *file, {});
///     write_clash_json({.findings = findings, .model = model, .decided = &*decided}, ...);
namespace strake::report {

struct ClashContents;

enum class DecisionStatus : std::uint8_t { undecided, active, reviewed, approved, resolved };

inline constexpr std::array kDecisionStatuses{DecisionStatus::undecided, DecisionStatus::active,
                                              DecisionStatus::reviewed, DecisionStatus::approved,
                                              DecisionStatus::resolved};

/// Returns "new", "active", "reviewed", "approved" or "resolved".
[[nodiscard]] std::string_view name(DecisionStatus status);

/// One of the two objects that a row names; both are empty where the file has no such columns.
struct DecisionObject {
  std::string file, id, name;
};

/// What somebody said about a clash.
struct DecisionComment {
  std::string at, by, text;  ///< when, as 2026-01-31T23:59:59Z, or the day alone; or empty
  /// Of the comment in BCF and of its topic; empty: no other program names it.
  std::string guid = {}, topic = {};
  /// When it was said, and by whom, before it was edited; empty: it was not.
  std::string first_at = {}, first_by = {};
};

/// A row of the file.
struct Decision {
  Hash128 key;  ///< the clash::parse_key() of its text
  DecisionStatus status = DecisionStatus::undecided;
  std::string by, date, comment;  ///< the date as 2026-01-31; each may be empty
  // The clash when it was decided about, as far as the file says.
  std::optional<clash::Class> cls;
  std::optional<double> d_mm;
  double d_rounding_mm = 0;  ///< by so much d_mm may have been rounded
  std::optional<geometry::Vec3d> point_mm;
  std::uint32_t regions = 0;  ///< 0: not said
  std::string test;
  DecisionObject a, b;
  std::size_t line = 0;
  std::string assignee;  ///< who sees to it; of projects alone
  std::string at;        ///< when it was made, to the second, as 2026-01-31T23:59:59Z; likewise
  /// All that people said, where they were requested of a project; `comment` is what holds now.
  std::vector<DecisionComment> comments;
};

struct DecisionFile {
  std::string name;                 ///< as given
  std::string text;                 ///< all of it; empty where there is no file yet
  std::vector<Decision> decisions;  ///< in the order of the file
};

/// Reads decisions: CSV of UTF-8 with a line of headings, separated by commas, semicolons or tabs,
/// with or without a byte order mark. It needs the columns `key` and `status`; `by`, `date`,
/// `comment`, and `class`, `d_mm`, `x_mm`, `y_mm`, `z_mm`, `regions`, `test`, `a_file`, `a_id`,
/// `a_name`, `b_file`, `b_id` and `b_name` as results have them, are read where they are there, all
/// others are not. Where a cell of `d_mm` is blank, `class` and `regions` of the row say nothing.
/// Errors (input), each with file and line: a column that is missing or there twice, a key that is
/// none or there twice, an unknown status, a date, a number or a
/// class that is none.
[[nodiscard]] Result<DecisionFile> parse_decisions(std::string text, std::string name);
[[nodiscard]] Result<DecisionFile> read_decisions(const std::filesystem::path& file);

/// Why a decision does not settle its clash any more.
enum class Reopened : std::uint8_t {
  no,
  severer,       ///< approved, and of a severer class than it was
  deeper,        ///< approved, and deeper or nearer than it was
  more_regions,  ///< approved, and the two meet at more places than they did
  found_again,   ///< resolved, and still there
};

/// Returns "severer", "deeper", "more places" or "found again"; an empty text for `no`.
[[nodiscard]] std::string_view name(Reopened reopened);

/// A result with the decision about it.
struct DecidedResult {
  model::ObjectId a{}, b{};  ///< as in the pair
  clash::Class cls = clash::Class::no_hit;
  bool allowed = false;  ///< a rule allows it
  Reopened reopened = Reopened::no;
  bool regions_unknown = false;  ///< the row states regions, which the run did not count
  const Decision* decision = nullptr;

  /// Whether nobody needs to look at it: approved, and no worse than it was then.
  [[nodiscard]] bool is_settled() const {
    return decision->status == DecisionStatus::approved && reopened == Reopened::no && !allowed;
  }
};

/// Returns the status of a result as it is now, for outputs that have no word for why a decision no
/// longer holds: New without a decision, and where it is found although it was resolved; Active
/// where it was approved and is worse. What a project says is the status of now already.
[[nodiscard]] DecisionStatus current_status(const DecidedResult* decided);

struct DecisionRules {
  /// An approved clash comes back where its d is less than it was by more than this, and than the
  /// file may have rounded it.
  double deeper_mm = 1;
  /// Files that have another name now, as OLD=NEW.
  std::span<const std::string> match_files = {};
};

/// What holds of the results of a test that DecidedResults::tests does not have and that no rule
/// allows: of a million results nearly all are as they were, and nobody has decided about them.
struct OtherResults {
  DecidedResult result;  ///< but for its objects and its class; without a decision: none is decided
  std::vector<std::pair<model::ObjectId, model::ObjectId>> undecided;  ///< all but these; ascending
};

/// The decisions about the results of findings; it refers to the DecisionFile.
class DecidedResults {
 public:
  const DecisionFile* file = nullptr;
  double deeper_mm = 0;
  FileMatches files;  ///< which file had which name when decided
  /// DecisionRules::match_files that change nothing: the file has the new name and not the old one.
  std::vector<std::string> renamed_before;
  std::vector<std::vector<DecidedResult>> tests;  ///< of each test by (a, b)
  std::vector<OtherResults> others;               ///< of each test; empty: of none
  std::vector<const Decision*> not_found;         ///< decisions about no result, as in the file
  /// Results of each status that no rule allows; those without a decision are new.
  std::array<std::uint64_t, kDecisionStatuses.size()> counts{};

  /// Returns the decision about a result; null if there is none. One of `others` stands for many:
  /// it names no objects.
  [[nodiscard]] const DecidedResult* of(std::size_t test, const clash::Pair& pair) const;
  [[nodiscard]] bool is_settled(std::size_t test, const clash::Pair& pair) const {
    const DecidedResult* const decided = of(test, pair);
    return decided != nullptr && decided->is_settled();
  }
  /// Returns how many results that no rule allows came back for this reason.
  [[nodiscard]] std::uint64_t count(Reopened reopened) const;
  /// Returns how many of them may meet at more places than they did, as these were not counted.
  [[nodiscard]] std::uint64_t count_regions_unknown() const;
};

/// Looks up the decision about each result, by its key. A file that has another name than when its
/// clashes were decided about is found by what is in it, as in a comparison of two runs, or by
/// DecisionRules::match_files: its results have the decisions about their former keys.
///
/// Where the id of an object is only a position in its file, a key may be another clash's: the
/// decision is found by place, where the file names the two objects and their files, or by key
/// where the place that the file states is that of the result. Rows that nobody has written into
/// are found by key.
///
/// Errors: usage, as of match_files() and parse_file_pairs().
[[nodiscard]] Result<DecidedResults> decide(const clash::Findings& findings,
                                            const model::Model& model, const DecisionFile& file,
                                            const DecisionRules& rules);

/// What a decision file becomes by a run.
struct UpdatedDecisions {
  std::string text;
  std::uint64_t added = 0;        ///< rows of results that had none
  std::uint64_t taken_out = 0;    ///< rows that nobody has written into, replaced by decisions
  std::uint64_t without_row = 0;  ///< results whose key stands there for another place
};

/// Adds a row of the status `new` for each result that has none and that no rule allows. All rows
/// and columns stay as they are, but that
///
/// 1. rows without a decision (`new`) have what the result measures now, and decided ones get what
///    they lack of it: it is what a decision is about; all of it where the cell of `d_mm` is blank;
/// 2. rows of a file that was renamed, or of an object whose id is only a position, have the key
///    and the names of today; a row of that key that nobody has written into is taken out.
///
/// `contents.decided` must be there; contents.csv is the form of a file that is not there yet.
[[nodiscard]] UpdatedDecisions update_decisions(const ClashContents& contents);

}  // namespace strake::report
