// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstdint>
#include <optional>
#include <string>
#include <string_view>

#include "project/database/database.hpp"
#include "project/results/life_cycle.hpp"
#include "strake/clash/relation.hpp"
#include "strake/core/result.hpp"
#include "strake/geometry/vec.hpp"
#include "strake/report/decisions.hpp"

/// The rows of the table `clash`, and those of `event`.
namespace strake::project {

struct ClashSide {
  std::string file, id, name;
  friend bool operator==(const ClashSide&, const ClashSide&) = default;
};

/// A row; texts that are NULL are empty.
struct ClashRow {
  std::int64_t id = 0, test = 0;
  std::string key;
  ClashSide a, b;
  Measure now;
  clash::Relation relation = clash::Relation::separate;
  geometry::Vec3d point_mm;
  std::int64_t first_run = 0, new_run = 0;
  std::optional<std::int64_t> gone_run;
  std::string unknown;
  /// `undecided`: New in the run `new_run`, Active in later ones.
  report::DecisionStatus decision = report::DecisionStatus::undecided;
  std::string decided_by, decided_at, comment, assignee;
  std::optional<Measure> decided;
  friend bool operator==(const ClashRow&, const ClashRow&) = default;

  /// Whether somebody wrote into it.
  [[nodiscard]] bool is_touched() const {
    return decision != report::DecisionStatus::undecided || !comment.empty() || !assignee.empty();
  }
  /// Returns the status that people see where `last_run` is the last run of the test.
  [[nodiscard]] report::DecisionStatus status(std::int64_t last_run) const {
    if (decision != report::DecisionStatus::undecided || new_run == last_run) return decision;
    return report::DecisionStatus::active;
  }
};

/// A clash that a run finds for the first time, with texts as rows show them.
struct NewClash {
  struct Side {
    std::string_view file, id, name;
  };
  std::int64_t test = 0, run = 0;
  std::string_view key;
  Side a, b;
  Measure now;
  clash::Relation relation = clash::Relation::separate;
  geometry::Vec3d point_mm;
};

/// What somebody said, where that is not all that an event tells, or another program has a name for
/// it.
struct OriginalComment {
  std::string text = {};                     ///< empty: nothing
  std::string guid = {}, topic = {};         ///< as report::DecisionComment has them
  std::string first_at = {}, first_by = {};  ///< likewise
};

/// A change of status.
struct ClashEvent {
  std::int64_t clash = 0;
  std::optional<std::int64_t> run;  ///< the run that did it; absent: a person, between runs
  std::string at, who;
  report::DecisionStatus before{}, after{};
  std::string comment;                           ///< what it tells
  std::optional<OriginalComment> original = {};  ///< absent: what it tells is what was said

  /// Returns what somebody said; of what a program did, nothing.
  [[nodiscard]] report::DecisionComment person_comment() const;
};

/// The columns of an event and of what was said in it, which event_of() reads, and where they are.
inline constexpr std::string_view kEventColumns =
    "run,at,who,before,after,comment,text,guid,topic,first_at,first_by";
inline constexpr std::string_view kEventTables = "event LEFT JOIN said ON said.event = event.id";

/// The columns of `clash` in the order in which row_of() reads them.
inline constexpr std::string_view kClashColumns =
    "id,test,key,a_file,a_id,a_name,b_file,b_id,b_name,class,d_mm,regions,relation,x_mm,y_mm,z_mm,"
    "first_run,new_run,gone_run,unknown,decision,decided_by,decided_at,comment,assignee,"
    "decided_class,decided_d_mm,decided_regions";

/// Returns the row that a statement stands at, of kClashColumns from column 0 on. Errors: input for
/// words that are none.
[[nodiscard]] Result<ClashRow> row_of(const Database& database, const Statement& at);

/// Returns the event that a statement stands at, of a column `clash` and of kEventColumns from
/// column 1 on. Errors: input for words that are none.
[[nodiscard]] Result<ClashEvent> event_of(const Database& database, const Statement& at);

/// Reads and writes rows with statements that are prepared once.
class ClashRows {
 public:
  [[nodiscard]] static Result<ClashRows> of(Database& database);

  [[nodiscard]] Result<std::optional<ClashRow>> find(std::int64_t id);
  [[nodiscard]] Result<std::optional<ClashRow>> find(std::string_view key);
  /// Adds a row that nobody has decided about and returns its id; nothing where the key is that of
  /// another row.
  [[nodiscard]] Result<std::optional<std::int64_t>> insert(const NewClash& row);
  /// Writes a row that is there.
  [[nodiscard]] Status update(const ClashRow& row);
  [[nodiscard]] Status add(const ClashEvent& event);

 private:
  ClashRows(Database& database, Statement by_id, Statement by_key, Statement insert,
            Statement update, Statement event, Statement original);
  Result<std::optional<ClashRow>> take(Statement& statement);
  Database* database_;
  Statement by_id_, by_key_, insert_, update_, event_, original_;
};

}  // namespace strake::project
