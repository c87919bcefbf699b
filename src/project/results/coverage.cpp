// SPDX-License-Identifier: Apache-2.0
#include "project/results/coverage.hpp"

#include <algorithm>
#include <cstddef>
#include <cstdint>
#include <string_view>
#include <variant>

#include "clash/rules/rule_matcher.hpp"

namespace strake::project {
namespace {

std::string named(const SoughtObject& object) { return "'" + std::string(object.name) + "'"; }

bool exempts(const clash::Exemption& exemption, std::uint32_t a, std::uint32_t b) {
  return std::visit([&](const auto& test) { return clash::exempts(test, a, b); }, exemption.test);
}

/// The cell of two objects in a matrix; the default where there is none.
std::uint32_t cell_of(const clash::Policy& policy, std::uint32_t a, std::uint32_t b) {
  return policy.matrix ? clash::cell_of(*policy.matrix, a, b) : clash::Matrix::kDefault;
}

/// Returns how far apart two objects may be and still be a result of a report.
double reach_of(const clash::Tolerances& tolerances, std::uint32_t a, std::uint32_t b) {
  return clash::reach_of(tolerances, tolerances.added_clearance_mm(a, b));
}

bool has_same_lengths(const clash::Tolerances& x, const clash::Tolerances& y) {
  return x.clearance_mm == y.clearance_mm && x.touch_gap_mm == y.touch_gap_mm;
}

/// Whether two runs of a test reach as far, whatever objects add to it: what is beyond that moved.
bool has_same_lengths(const clash::Report& x, const clash::Report& y) {
  return has_same_lengths(x.options.tolerances, y.options.tolerances) &&
         std::ranges::equal(x.cells, y.cells,
                            [](const clash::CellReport& p, const clash::CellReport& q) {
                              return p.a == q.a && p.b == q.b && p.checked == q.checked &&
                                     has_same_lengths(p.tolerances, q.tolerances);
                            });
}

/// Whether an object has lines, which a test checks only where it is requested to.
bool has_lines(const model::Model& model, model::ObjectId id) {
  const model::Object& object = model.object(id);
  for (std::uint32_t b = object.first_body; b < object.first_body + object.body_count; ++b)
    if (std::holds_alternative<geometry::Polylines>(model.shapes[index(model.bodies[b].shape)]))
      return true;
  return false;
}

/// Returns the pair of two objects in a list by (a, b); null where it is not there.
template <class Listed>
const Listed* find_pair(const std::vector<Listed>& list, model::ObjectId a, model::ObjectId b) {
  const auto objects = [](const Listed& l) { return std::pair(l.a, l.b); };
  const std::pair sought(std::min(a, b), std::max(a, b));
  const auto at = std::ranges::lower_bound(list, sought, {}, objects);
  return at != list.end() && objects(*at) == sought ? &*at : nullptr;
}

}  // namespace

Coverage::Coverage(const model::Model& model, const clash::Sets& sets, const clash::Policy& policy,
                   const clash::Report& report)
    : model_(model), sets_(sets), policy_(policy), report_(report) {
  for (const clash::NotCompared& n : report.not_compared)
    lacks_.emplace(std::pair(n.a, n.b), n.code);
}

std::string Coverage::reason(const SoughtObject& a, const SoughtObject& b,
                             const LastFound& last) const {
  for (const SoughtObject* const object : {&a, &b})
    if (!object->id) return named(*object) + " is not in the model";
  if (std::string why = of_sets(a, b); !why.empty()) return why;
  for (const SoughtObject* const object : {&a, &b})
    if (std::string why = of_object(*object); !why.empty()) return why;
  if (const auto at = lacks_.find({std::min(*a.id, *b.id), std::max(*a.id, *b.id)});
      at != lacks_.end())
    return "the pair could not be compared (" + std::string(at->second) + ")";
  if (std::string why = of_exemptions(*a.id, *b.id); !why.empty()) return why;
  if (std::string why = of_report(*a.id, *b.id); !why.empty()) return why;
  return of_settings(*a.id, *b.id, last);
}

std::string Coverage::of_sets(const SoughtObject& a, const SoughtObject& b) const {
  const std::uint32_t x = index(*a.id), y = index(*b.id);
  for (const SoughtObject* const object : {&a, &b})
    if (!sets_.in_a[index(*object->id)] && !sets_.in_b[index(*object->id)])
      return named(*object) + " is in neither set";
  if (!(sets_.in_a[x] && sets_.in_b[y]) && !(sets_.in_a[y] && sets_.in_b[x]))
    return "both are in the same set";
  if (!sets_.group.empty() && sets_.group[x] == sets_.group[y])
    return "pairs within a file are not looked at";
  return {};
}

const clash::UnlistedContact* Coverage::counted(model::ObjectId a, model::ObjectId b) const {
  return report_.kept ? find_pair(report_.kept->unlisted, a, b) : nullptr;
}

std::int64_t Coverage::open_parts(model::ObjectId id) const {
  return report_.sheets.empty() ? 0 : report_.sheets[index(id)];
}

std::string Coverage::of_object(const SoughtObject& object) const {
  const model::Object& now = model_.object(*object.id);
  if (const auto at = lacks_.find({*object.id, std::nullopt}); at != lacks_.end())
    return named(object) + " could not be compared whole (" + std::string(at->second) + ")";
  if (now.incomplete) return named(object) + " could not be read whole";
  const model::SourceFile& file = model_.files[now.file];
  if (file.ends_early) return file.label + " ends early";
  // What is in an open part is not found. Whether it was open when the clash was seen last is what
  // counts, whatever runs found of the object since.
  const std::int64_t open = open_parts(*object.id);
  if (open == 0 || (object.open && open <= *object.open)) return {};
  return named(object) + " has surfaces that enclose nothing beyond those of the earlier run";
}

std::string Coverage::of_exemptions(model::ObjectId a, model::ObjectId b) const {
  const std::uint32_t x = index(a), y = index(b);
  if (cell_of(policy_, x, y) == clash::Matrix::kNotChecked)
    return "exempted by '" + policy_.matrix->rule + "'";
  for (const clash::Exemption& exemption : policy_.exemptions)
    if (exempts(exemption, x, y)) return "exempted by '" + exemption.rule + "'";
  if (!policy_.levels) return {};
  const clash::Level p = policy_.levels->object[x], q = policy_.levels->object[y];
  if (p == clash::Level::none || q == clash::Level::none) return "exempted by its level";
  const std::string& rule =
      policy_.levels->left_out[static_cast<std::size_t>(p)][static_cast<std::size_t>(q)];
  return rule.empty() ? std::string() : "exempted by '" + rule + "'";
}

/// Whatever the clash was, it may be a contact by now.
std::string Coverage::of_report(model::ObjectId a, model::ObjectId b) const {
  if (report_.kept) {
    if (counted(a, b) != nullptr) return "it is among the contacts, which are only counted";
    if (find_pair(report_.kept->unreported, a, b) != nullptr)
      return "it is among the results that the test does not report";
    return {};
  }
  if (report_.unlisted.contacts + report_.unlisted.allowed > 0)
    return "it may be among the contacts, which are only counted";
  if (report_.not_reported.by_relation.all() + report_.not_reported.by_volume.all() > 0)
    return "it may be among the results that the test does not report";
  return {};
}

/// Where runs could not tell since the clash was found, how that run tested is not known any more:
/// the report of the run before it may already lack what this one lacks.
std::string Coverage::of_settings(model::ObjectId a, model::ObjectId b,
                                  const LastFound& last) const {
  const bool is_long_ago = !last.unknown.empty();
  if (last.report == nullptr && !is_long_ago) return {};
  const bool had_curves = is_long_ago || last.report->options.engine.curves == clash::Curves::on;
  if (had_curves && report_.options.engine.curves != clash::Curves::on &&
      (has_lines(model_, a) || has_lines(model_, b)))
    return "lines are not checked any more";
  if (!is_long_ago && has_same_lengths(report_, *last.report)) return {};
  const std::uint32_t cell = cell_of(policy_, index(a), index(b));
  const clash::Tolerances& now =
      cell < policy_.tolerances.size() ? policy_.tolerances[cell] : report_.options.tolerances;
  const double reach = reach_of(now, index(a), index(b));
  return last.was.d_mm > reach ? "the test does not reach as far as it did" : std::string();
}

}  // namespace strake::project
