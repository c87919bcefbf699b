// SPDX-License-Identifier: Apache-2.0
#include "project/history/observations.hpp"

#include <algorithm>
#include <array>
#include <optional>
#include <string_view>
#include <unordered_map>
#include <vector>

namespace strake::project {
namespace {

/// What runs before one said of a clash.
struct FormerObservation {
  std::int64_t run = 0;
  ObservationAt observation;
};

using FormerObservations = std::unordered_map<std::int64_t, std::vector<FormerObservation>>;

std::optional<ObservationAt::Kind> kind_of(std::string_view word) {
  if (word == "found") return ObservationAt::Kind::found;
  if (word == "gone") return ObservationAt::Kind::gone;
  if (word == "cannot tell") return ObservationAt::Kind::cannot_tell;
  return std::nullopt;
}

std::optional<clash::Class> class_of(std::string_view word) {
  for (const clash::Class cls :
       {clash::Class::hit, clash::Class::contact, clash::Class::clearance_violation})
    if (name(cls) == word) return cls;
  return std::nullopt;
}

/// Returns what the table `former` has of the clashes of a test, of each by run.
Result<FormerObservations> read_former(Database& database, std::int64_t test) {
  Result<Statement> select = database.prepare(
      "SELECT former.clash, former.run, former.sight, former.class, former.d_mm, former.regions, "
      "former.why FROM former JOIN clash ON clash.id = former.clash WHERE clash.test = ?1 "
      "ORDER BY former.clash, former.run");
  if (!select) return select.error();
  select->bind(1, test);
  FormerObservations all;
  for (;;) {
    const Result<bool> there = select->step();
    if (!there) return there.error();
    if (!*there) return all;
    const auto kind = kind_of(select->text(2));
    const auto cls = class_of(select->text(3));
    if (!kind || !cls) return database.damaged("a run said of a clash what none says");
    const auto regions =
        static_cast<std::uint32_t>(std::clamp<std::int64_t>(select->integer(5), 0, INT32_MAX));
    all[select->integer(0)].push_back(
        {select->integer(1),
         {*kind, {*cls, select->real(4), regions}, std::string(select->text(6))}});
  }
}

ObservationAt current_observation(const ClashRow& row) {
  if (row.gone_run) return {ObservationAt::Kind::gone, row.now, {}};
  if (!row.unknown.empty()) return {ObservationAt::Kind::cannot_tell, row.now, row.unknown};
  return {ObservationAt::Kind::found, row.now, {}};
}

/// Returns what a run said: what the first one after it that said something else found written, or
/// what is written today.
ObservationAt observation_at(const ClashRow& row, const std::vector<FormerObservation>* former,
                             std::int64_t run) {
  if (run < row.first_run) return {};
  if (former != nullptr) {
    const auto later = std::ranges::upper_bound(*former, run, {}, &FormerObservation::run);
    if (later != former->end()) return later->observation;
  }
  return current_observation(row);
}

}  // namespace

Observations::Observations(Database& database, Statement allowed)
    : database_(&database), allowed_(std::move(allowed)) {}

Result<Observations> Observations::of(Database& database) {
  Result<Statement> allowed = database.prepare(
      "SELECT comment FROM event WHERE clash = ?1 AND run <= ?2 AND after = 'resolved' "
      "ORDER BY id DESC LIMIT 1");
  if (!allowed) return allowed.error();
  return Observations(database, std::move(*allowed));
}

Status Observations::each(std::int64_t test, const std::pair<std::int64_t, std::int64_t>& runs,
                          const Take& take) {
  const Result<FormerObservations> former = read_former(*database_, test);
  if (!former) return former.error();
  Result<Statement> select = database_->prepare("SELECT " + std::string(kClashColumns) +
                                                " FROM clash WHERE test = ?1 ORDER BY id");
  if (!select) return select.error();
  select->bind(1, test);
  for (;;) {
    const Result<bool> there = select->step();
    if (!there) return there.error();
    if (!*there) return {};
    const Result<ClashRow> row = row_of(*database_, *select);
    if (!row) return row.error();
    const auto at = former->find(row->id);
    const auto* const observation = at == former->end() ? nullptr : &at->second;
    const Status status = take(*row, {observation_at(*row, observation, runs.first),
                                      observation_at(*row, observation, runs.second)});
    if (!status) return status;
  }
}

Result<std::string> Observations::allowed_by(std::int64_t clash, std::int64_t run) {
  const Result<bool> there = allowed_.bind(1, clash).bind(2, run).step();
  if (!there) return there.error();
  const std::string cause(*there ? allowed_.text(0) : std::string_view());
  allowed_.reset();
  return cause.starts_with("allowed by rule") ? cause : std::string();
}

}  // namespace strake::project
