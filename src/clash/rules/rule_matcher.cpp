// SPDX-License-Identifier: Apache-2.0
#include "clash/rules/rule_matcher.hpp"

#include <algorithm>
#include <cmath>
#include <tuple>
#include <utility>
#include <variant>

#include "clash/rules/options.hpp"
#include "clash/rules/shadowed_rules.hpp"
#include "strake/geometry/grid.hpp"
#include "strake/parallel/collect.hpp"
#include "strake/parallel/reduce.hpp"
#include "strake/parallel/transform.hpp"

namespace strake::clash {
namespace {

/// Whether two ascending lists share a number.
bool share(const Linked::Lists& x, std::uint32_t a, const Linked::Lists& y, std::uint32_t b) {
  std::uint32_t i = x.first[a], j = y.first[b];
  while (i < x.first[a + 1] && j < y.first[b + 1]) {
    if (x.numbers[i] == y.numbers[j]) return true;
    ++(x.numbers[i] < y.numbers[j] ? i : j);
  }
  return false;
}

bool within(const HalfSpace& side, const geometry::Vec3d& p) {
  return dot(p - side.point_mm, side.normal) >= 0;
}

/// Whether the limits of a rule can be compared with: nothing is greater than what is not a number,
/// so that such a depth would allow all. An infinite region or depth is none.
bool has_meaning(const Allowed& rule) {
  const auto is_number = [](const geometry::Vec3d& v) {
    return !std::isnan(v.x) && !std::isnan(v.y) && !std::isnan(v.z);
  };
  if (rule.max_depth_mm && std::isnan(*rule.max_depth_mm)) return false;
  if (rule.max_volume_mm3 && std::isnan(*rule.max_volume_mm3)) return false;
  if (rule.region_mm && !(is_number(rule.region_mm->lo) && is_number(rule.region_mm->hi)))
    return false;
  return std::all_of(rule.cavity.begin(), rule.cavity.end(), [](const HalfSpace& side) {
    return geometry::is_finite(side.point_mm) && geometry::is_finite(side.normal) &&
           side.normal != geometry::Vec3d{};
  });
}

}  // namespace

Status check(const Policy& policy, std::size_t objects) {
  const auto fits = [&](const auto&... lists) { return ((lists.size() == objects) && ...); };
  const auto listed = [&](const Linked::Lists& lists) {
    return lists.first.size() == objects + 1 && lists.first.back() <= lists.numbers.size();
  };
  bool good = true;
  for (const Exemption& e : policy.exemptions) {
    if (const auto* const same = std::get_if<SameLabel>(&e.test))
      good &= fits(same->label) && are_named(same->label, same->names);
    if (const auto* const linked = std::get_if<Linked>(&e.test))
      good &= listed(linked->answers_to) && listed(linked->refers_to) &&
              are_named(linked->answers_to.numbers, linked->names) &&
              are_named(linked->refers_to.numbers, linked->names);
    if (const auto* const between = std::get_if<Between>(&e.test))
      good &= fits(between->a, between->b);
  }
  if (policy.matrix) {
    const std::size_t n = policy.matrix->disciplines.size();
    good &= fits(policy.matrix->discipline) && policy.matrix->cells.size() == n * n;
    for (const std::uint32_t d : policy.matrix->discipline) good &= d < n || d == kNoLabel;
    for (const std::uint32_t c : policy.matrix->cells)
      good &= c < policy.tolerances.size() || c >= Matrix::kDefault;
  }
  if (policy.levels) good &= fits(policy.levels->object);
  for (const Allowed& a : policy.allowed) good &= fits(a.a, a.b);
  if (!good)
    return Error{
        ErrorCode::usage,
        "the rules do not have one entry per object of the scene, or refer to what is not there",
        "rules", "build them from the same scene"};
  for (const Allowed& a : policy.allowed)
    if (!has_meaning(a))
      return Error{ErrorCode::usage,
                   "a depth, a volume or a region is not a number, or a plane is not finite or has "
                   "no normal",
                   "rule '" + a.rule + "'",
                   "state numbers, and a point and a direction for each plane"};
  return {};
}

Status check_narrow_phase(const Policy& policy, const Options& options) {
  const bool matters = options.reporting.leaves_out() ||
                       std::ranges::any_of(policy.allowed, [](const Allowed& rule) {
                         return !rule.relations.empty() || rule.max_volume_mm3;
                       });
  if (!matters || options.engine.narrow_phase == NarrowPhase::exact) return {};
  return Error{ErrorCode::usage,
               "rules by relation and by volume need the exact narrow phase: the baseline does not "
               "tell these",
               "narrow phase", "leave out --narrow-phase, or these rules"};
}

std::uint32_t cell_of(const Matrix& matrix, std::uint32_t a, std::uint32_t b) {
  const std::uint32_t row = matrix.discipline[a], column = matrix.discipline[b];
  if (row == kNoLabel || column == kNoLabel) return Matrix::kDefault;
  return matrix.cells[row * matrix.disciplines.size() + column];
}

double reach_of(const Tolerances& t, double added_mm) {
  return std::max(t.clearance_mm + added_mm, t.touch_gap_mm);
}

bool exempts(const Between& test, std::uint32_t a, std::uint32_t b) {
  return (test.a[a] && test.b[b]) || (test.a[b] && test.b[a]);
}

bool exempts(const SameLabel& test, std::uint32_t a, std::uint32_t b) {
  return test.label[a] == test.label[b] && test.label[a] != kNoLabel;
}

bool exempts(const Linked& test, std::uint32_t a, std::uint32_t b) {
  return share(test.refers_to, a, test.answers_to, b) ||
         share(test.refers_to, b, test.answers_to, a);
}

namespace {

/// Whether the rule allows how the two stand to each other: what is not certain it does not.
bool allows_relation(const Allowed& rule, const Pair& pair) {
  if (rule.relations.empty()) return true;
  const std::uint32_t a = index(pair.a), b = index(pair.b);
  return (pair.flags & kUncertain) == 0 &&
         rule.relations.contains(pair.relation, rule.a[a] && rule.b[b], rule.a[b] && rule.b[a]);
}

}  // namespace

bool allows(const Allowed& rule, const Pair& pair, double moved_mm) {
  // Half a grid step is what a bracket about a depth on the grid may be off; the next depth that
  // coordinates on the grid can state is a whole step away.
  constexpr double kTieMm = geometry::kMmPerGrid / 2;
  if (rule.max_depth_mm ? -pair.d_lower_mm > *rule.max_depth_mm + kTieMm + moved_mm
                        : pair.cls == Class::hit)
    return false;
  if (!allows_relation(rule, pair)) return false;
  const geometry::Vec3d& at = pair.point_mm;
  if (rule.region_mm && !rule.region_mm->contains({at, at})) return false;
  return std::all_of(rule.cavity.begin(), rule.cavity.end(),
                     [&](const HalfSpace& side) { return within(side, at); });
}

bool is_as_deep_as_allowed(const Allowed& rule, const Pair& pair) {
  return rule.max_depth_mm && -pair.d_lower_mm > *rule.max_depth_mm;
}

bool contains_box(const Allowed& rule, const geometry::Box3d& box) {
  if (rule.region_mm && !rule.region_mm->contains(box)) return false;
  return std::all_of(rule.cavity.begin(), rule.cavity.end(), [&](const HalfSpace& side) {
    geometry::Vec3d outermost;
    for (int k = 0; k < 3; ++k) outermost[k] = side.normal[k] > 0 ? box.lo[k] : box.hi[k];
    return within(side, outermost);
  });
}

namespace {

using geometry::IndexPair;

/// Pairs per block where results are counted. Between 16'384 and 262'144 no difference can be seen
/// (decision 0073).
constexpr std::size_t kMatchesPerBlock = 65536;
/// Pairs per block where each has a rule or more of its own. Between 1024 and 16'384 no difference
/// can be seen (decision 0073).
constexpr std::size_t kRuledPairsPerBlock = 4096;

std::size_t count_between(const Policy& policy) {
  return static_cast<std::size_t>(
      std::count_if(policy.exemptions.begin(), policy.exemptions.end(),
                    [](const Exemption& e) { return std::holds_alternative<Between>(e.test); }));
}

}  // namespace

std::vector<Tolerances> all_tolerances(const Policy& policy, const Options& options) {
  std::vector<Tolerances> all{options.tolerances};
  all.insert(all.end(), policy.tolerances.begin(), policy.tolerances.end());
  return all;
}

void set_cell_tolerances(const Policy& policy, std::span<const Tolerances> all, Report& report) {
  if (!policy.matrix) return;
  const Matrix& m = *policy.matrix;
  for (CellReport& report_cell : report.cells) {
    const std::uint32_t cell = m.cells[report_cell.a * m.disciplines.size() + report_cell.b];
    report_cell.tolerances = all[cell >= Matrix::kDefault ? 0 : cell + 1];
  }
}

SearchReach search_reach(std::span<const Tolerances> all) {
  double widest_mm = 0;
  for (const Tolerances& t : all) widest_mm = std::max(widest_mm, reach_of(t, 0));
  SearchReach reach{.of_all = search_margin(widest_mm * geometry::kGridPerMm)};
  for (const Tolerances& t : all) {
    if (!t.object_clearances) continue;
    const std::vector<double>& mm = t.object_clearances->mm;
    // Each box is rounded outward by itself: a unit more, so that no pair of own_reach() is lost.
    reach.of_object.resize(mm.size(), 1);
    for (std::size_t o = 0; o < mm.size(); ++o)
      reach.of_object[o] = std::max(reach.of_object[o], mm[o] * geometry::kGridPerMm + 1);
  }
  return reach;
}

RuleMatcher::RuleMatcher(const Policy& policy, const Options& options, const model::Model& model,
                         std::optional<std::span<const std::uint32_t>> only)
    : policy_(policy),
      model_(model),
      tolerances_(all_tolerances(policy, options)),
      between_(model.objects.size(), count_between(policy)),
      allowed_(model.objects.size(), policy.allowed.size()) {
  for (const Tolerances& t : tolerances_)
    one_reach_ =
        one_reach_ && !t.object_clearances && reach_of(t, 0) == reach_of(tolerances_.front(), 0);
  for (std::uint32_t e = 0; e < policy.exemptions.size(); ++e)
    if (const auto* const test = std::get_if<Between>(&policy.exemptions[e].test)) {
      between_.set(between_rule_.size(), test->a, test->b, only);
      between_rule_.push_back(e);
    }
  for (std::size_t r = 0; r < policy.allowed.size(); ++r)
    allowed_.set(r, policy.allowed[r].a, policy.allowed[r].b, only);
  number_level_rules();
}

void RuleMatcher::number_level_rules() {
  if (!policy_.levels) return;
  level_rules_.push_back(policy_.levels->no_obstruction_rule);
  for (const auto& row : policy_.levels->left_out)
    for (const std::string& rule : row)
      if (!rule.empty() &&
          std::find(level_rules_.begin(), level_rules_.end(), rule) == level_rules_.end())
        level_rules_.push_back(rule);
}

std::size_t RuleMatcher::tolerances(std::uint32_t a, std::uint32_t b) const {
  if (!policy_.matrix) return 0;
  const std::uint32_t found = cell_of(*policy_.matrix, a, b);
  return found >= Matrix::kDefault ? 0 : found + 1;
}

double RuleMatcher::added_clearance_mm(std::uint32_t a, std::uint32_t b) const {
  return tolerances_[tolerances(a, b)].added_clearance_mm(a, b);
}

Level RuleMatcher::level(const ScenePart& part) const {
  if (!policy_.levels) return Level::hard;
  switch (model_.bodies[part.body].category) {
    case model::Category::insulation:
      return Level::insulation;
    case model::Category::obstruction:
      return policy_.levels->obstruction_bodies;
    case model::Category::physical:
      break;
  }
  return policy_.levels->object[part.object];
}

std::uint32_t RuleMatcher::object_rule(std::uint32_t a, std::uint32_t b) const {
  const std::uint32_t matrix = policy_.matrix ? 1 : 0;
  if (policy_.matrix && cell_of(*policy_.matrix, a, b) == Matrix::kNotChecked) return 0;
  std::uint32_t between = kNoLabel;
  between_.each(a, b, [&](std::size_t rule) {
    between = between_rule_[rule];
    return true;
  });
  const auto end = std::min(between, static_cast<std::uint32_t>(policy_.exemptions.size()));
  for (std::uint32_t e = 0; e < end; ++e) {
    const auto& test = policy_.exemptions[e].test;
    const auto* const same = std::get_if<SameLabel>(&test);
    const auto* const linked = std::get_if<Linked>(&test);
    if ((same != nullptr && exempts(*same, a, b)) || (linked != nullptr && exempts(*linked, a, b)))
      return matrix + e;
  }
  return between == kNoLabel ? kNoLabel : matrix + between;
}

std::uint32_t RuleMatcher::level_rule(Level a, Level b) const {
  const auto first =
      static_cast<std::uint32_t>((policy_.matrix ? 1 : 0) + policy_.exemptions.size());
  if (a == Level::none || b == Level::none) return first;
  const std::string& rule =
      policy_.levels->left_out[static_cast<std::size_t>(a)][static_cast<std::size_t>(b)];
  if (rule.empty()) return kNoLabel;
  const auto at = std::find(level_rules_.begin(), level_rules_.end(), rule);
  return first + static_cast<std::uint32_t>(at - level_rules_.begin());
}

double RuleMatcher::own_reach(const ScenePart& a, const ScenePart& b) const {
  const Tolerances& t = tolerances_[tolerances(a.object, b.object)];
  return search_margin(reach_of(t, t.added_clearance_mm(a.object, b.object)) *
                       geometry::kGridPerMm);
}

bool RuleMatcher::within_own_reach(const ScenePart& a, const ScenePart& b) const {
  if (one_reach_) return true;
  const double reach = own_reach(a, b);
  return inflated_box(a, reach).meets(inflated_box(b, reach));
}

RuleMatcher::Verdict RuleMatcher::verdict(const ScenePart& a, const ScenePart& b) const {
  if (!within_own_reach(a, b)) return {.rule = kNoLabel, .far = true};
  const std::uint32_t whole = object_rule(a.object, b.object);
  if (whole != kNoLabel || !policy_.levels) return {whole};
  return {level_rule(level(a), level(b))};
}

Status RuleMatcher::exempt(const ScenePartList& list, std::vector<IndexPair>& pairs,
                           const parallel::Context& context, Report& report) const {
  const bool rules = policy_.matrix || !policy_.exemptions.empty() || policy_.levels;
  if (!rules && one_reach_) return {};
  const auto verdicts = parallel::transform(
      context, {.name = "rules", .n = pairs.size(), .grain = kRuledPairsPerBlock},
      [&](std::size_t i) {
        return verdict(list.parts[pairs[i].first], list.parts[pairs[i].second]);
      });
  if (!verdicts) return verdicts.error();
  std::size_t kept = 0;
  // The rules that the current pair of objects counts for already.
  std::vector<std::uint32_t> counted_rules;
  std::vector<ExemptedPair> exempted;
  const ScenePart *last_a = nullptr, *last_b = nullptr;
  for (std::size_t i = 0; i < pairs.size(); ++i) {
    const ScenePart &a = list.parts[pairs[i].first], &b = list.parts[pairs[i].second];
    const Verdict& v = (*verdicts)[i];
    if (v.far) continue;
    if (v.rule == kNoLabel) {
      pairs[kept++] = pairs[i];
      continue;
    }
    if (last_a == nullptr || last_a->object != a.object || last_b->object != b.object)
      counted_rules.clear();
    last_a = &a;
    last_b = &b;
    if (std::find(counted_rules.begin(), counted_rules.end(), v.rule) != counted_rules.end())
      continue;
    counted_rules.push_back(v.rule);
    ++report.exempted[v.rule].pairs;
    exempted.push_back({model::ObjectId{a.object}, model::ObjectId{b.object}, v.rule});
  }
  pairs.resize(kept);
  if (const Status s = record_shadowed_exemptions(policy_, exempted, context, report); !s) return s;
  if (!policy_.list_exempted && !report.kept) return {};
  std::sort(exempted.begin(), exempted.end(), [](const ExemptedPair& x, const ExemptedPair& y) {
    return std::tie(x.a, x.b, x.rule) < std::tie(y.a, y.b, y.rule);
  });
  (policy_.list_exempted ? report.exempted_pairs : report.kept->exempted) = std::move(exempted);
  return {};
}

bool RuleMatcher::may_allow(std::uint32_t a, std::uint32_t b) const {
  bool some = false;
  allowed_.each(a, b, [&](std::size_t) { return some = true; });
  return some;
}

Status RuleMatcher::count_candidates(const EvaluatedPairs& evaluated, const ObjectPairs& objects,
                                     const parallel::Context& context, Report& report) const {
  if (policy_.allowed.empty()) return {};
  struct CandidateCounts {
    std::uint64_t pairs = 0;
    std::vector<std::uint64_t> by_rule;
  };
  const auto counts = parallel::reduce(
      context, {.name = "candidates of rules", .n = objects.size(), .grain = kMatchesPerBlock},
      CandidateCounts{0, std::vector<std::uint64_t>(policy_.allowed.size(), 0)},
      [&](CandidateCounts& partial, std::size_t k) {
        bool some = false;
        const std::size_t first = objects.begin(k);
        allowed_.each(evaluated.a(first).object, evaluated.b(first).object, [&](std::size_t rule) {
          some = true;
          ++partial.by_rule[rule];
          return false;
        });
        if (some) ++partial.pairs;
      },
      [](CandidateCounts& into, const CandidateCounts& partial) {
        into.pairs += partial.pairs;
        for (std::size_t r = 0; r < into.by_rule.size(); ++r) into.by_rule[r] += partial.by_rule[r];
      });
  if (!counts) return counts.error();
  report.counters.allowed_pairs = counts->pairs;
  if (report.kept) {
    auto concerned = parallel::collect<ConcernedPair>(
        context,
        {.name = "pairs that rules concern", .n = objects.size(), .grain = kRuledPairsPerBlock},
        [&](std::size_t k, std::vector<ConcernedPair>& out) {
          const std::size_t first = objects.begin(k);
          const std::uint32_t a = evaluated.a(first).object, b = evaluated.b(first).object;
          allowed_.each(a, b, [&](std::size_t rule) {
            out.push_back(
                {model::ObjectId{a}, model::ObjectId{b}, static_cast<std::uint32_t>(rule)});
            return false;
          });
        });
    if (!concerned) return concerned.error();
    report.kept->concerned = std::move(*concerned);
  }
  for (std::size_t r = 0; r < report.allowed.size(); ++r)
    report.allowed[r].candidates = counts->by_rule[r];
  return {};
}

bool RuleMatcher::limits_volume(std::uint32_t a, std::uint32_t b) const {
  bool some = false;
  allowed_.each(a, b, [&](std::size_t rule) {
    return some = policy_.allowed[rule].max_volume_mm3.has_value();
  });
  return some;
}

bool RuleMatcher::limits_volumes() const {
  return std::ranges::any_of(policy_.allowed,
                             [](const Allowed& rule) { return rule.max_volume_mm3.has_value(); });
}

void RuleMatcher::allow(const ScenePart& a, const ScenePart& b, const PairContext& known,
                        Pair& pair) const {
  const double moved = static_cast<double>(a.snap) + static_cast<double>(b.snap);
  bool volume_open = false;
  allowed_.each(a.object, b.object, [&](std::size_t number) {
    const Allowed& rule = policy_.allowed[number];
    if (!allows(rule, pair, moved * geometry::kMmPerGrid)) return false;
    if (rule.max_volume_mm3 && !known.common->is_at_most(*rule.max_volume_mm3)) {
      volume_open = volume_open || known.common->may_be_at_most(*rule.max_volume_mm3);
      return false;
    }
    pair.allowed = static_cast<std::int32_t>(number);
    return true;
  });
  if (pair.allowed < 0) {
    if (volume_open) pair.flags |= kUncertain;
    return;
  }
  const Allowed& rule = policy_.allowed[static_cast<std::size_t>(pair.allowed)];
  if (is_as_deep_as_allowed(rule, pair)) pair.flags |= kBorderline;
  if (!contains_box(rule, known.extent_mm.value_or(common_box_mm(a, b, own_reach(a, b)))))
    pair.flags |= kUncertain;
  else if (rule.max_depth_mm || pair.severest != Class::hit)
    pair.severest = Class::no_hit;  // without a depth the rule allows the class of d, but no HIT
}

void RuleMatcher::begin_report(const Sets& sets, Report& report) const {
  if (policy_.matrix) report.exempted.push_back({policy_.matrix->rule, 0});
  for (const Exemption& e : policy_.exemptions) report.exempted.push_back({e.rule, 0});
  for (const std::string& rule : level_rules_) report.exempted.push_back({rule, 0});
  for (const Allowed& a : policy_.allowed) report.allowed.push_back({a.rule, 0, 0});
  report.lists_exempted = policy_.list_exempted;
  report.levels = policy_.levels.has_value();
  if (!policy_.matrix) return;
  const Matrix& m = *policy_.matrix;
  for (const std::string& name : m.disciplines) report.disciplines.push_back({name, 0});
  for (std::size_t o = 0; o < m.discipline.size(); ++o)
    if (m.discipline[o] != kNoLabel && (sets.in_a[o] || sets.in_b[o]))
      ++report.disciplines[m.discipline[o]].objects;
  report.discipline = m.discipline;
  const auto n = static_cast<std::uint32_t>(m.disciplines.size());
  for (std::uint32_t a = 0; a < n; ++a)
    for (std::uint32_t b = a; b < n; ++b) {
      const std::uint32_t cell = m.cells[a * n + b];
      CellReport& cell_report = report.cells.emplace_back();
      cell_report.a = a;
      cell_report.b = b;
      cell_report.checked = cell != Matrix::kNotChecked;
    }
  set_cell_tolerances(policy_, tolerances_, report);
}

Status RuleMatcher::finish_report(const parallel::Context& context, Report& report) const {
  const auto totals = parallel::reduce(
      context, {.name = "count by class", .n = report.pairs.size(), .grain = kMatchesPerBlock},
      ClassTotals(policy_.allowed.size(), report.cells.size()),
      [&](ClassTotals& partial, std::size_t i) {
        const Pair& pair = report.pairs[i];
        partial.add(pair, cell_number(report, pair.a, pair.b));
      },
      [](ClassTotals& into, const ClassTotals& partial) { into.add(partial); });
  if (!totals) return totals.error();
  report.count_hit = totals->all.hit;
  report.count_contact = totals->all.contact;
  report.count_clearance = totals->all.clearance_violation;
  report.count_allowed = totals->all.allowed;
  for (std::size_t r = 0; r < report.allowed.size(); ++r)
    report.allowed[r].pairs = totals->by_rule[r];
  for (std::size_t c = 0; c < report.cells.size(); ++c) {
    const ClassCounts& counts = totals->by_cell[c];
    CellReport& cell = report.cells[c];
    cell.hit = counts.hit;
    cell.contact = counts.contact;
    cell.clearance_violation = counts.clearance_violation;
    cell.allowed = counts.allowed;
  }
  return record_shadowed_allowances(policy_, report.pairs, context, report);
}

std::size_t cell_number(const Report& report, model::ObjectId x, model::ObjectId y) {
  if (report.discipline.empty()) return kNoCell;
  const auto [a, b] = std::minmax(report.discipline[index(x)], report.discipline[index(y)]);
  if (b == kNoLabel) return kNoCell;
  const std::size_t n = report.disciplines.size();
  return a * n - a * (a + std::size_t{1}) / 2 + b;
}

}  // namespace strake::clash
