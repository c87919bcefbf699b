// SPDX-License-Identifier: Apache-2.0
#include "strake/report/clash_diff.hpp"

#include <algorithm>
#include <cmath>
#include <map>
#include <string_view>
#include <tuple>
#include <utility>

#include "clash/results/clash_key.hpp"
#include "report/clash/clash_files.hpp"
#include "report/clash/position_match.hpp"

namespace strake::report {
namespace {

int severity(clash::Class cls) {
  if (cls == clash::Class::hit) return 2;
  return cls == clash::Class::contact ? 1 : 0;
}

/// Returns the order in which results should be examined.
int attention(const DocumentResult& r) {
  using enum clash::Class;
  const int rank = r.cls == hit ? 0 : r.cls == clearance_violation ? 1 : 2;
  return r.rule == 0 ? rank : rank + 3;
}

/// Returns whether one entry of a list comes before another.
bool comes_first(const DiffEntry& x, const DiffEntry& y) {
  const DocumentResult &p = x.either(), &q = y.either();
  const bool x_is = x.after != nullptr, y_is = y.after != nullptr;
  return std::tuple(attention(p), p.d_mm, p.key, x_is) <
         std::tuple(attention(q), q.d_mm, q.key, y_is);
}

std::string named(const DocumentObject& o) {
  return "'" + std::string(o.name.empty() ? o.id : o.name) + "' of " + std::string(o.file);
}

std::string of_test(const DocumentTest& test) {
  return test.name.empty() ? std::string() : " of test '" + test.name + "'";
}

/// Tells whether a run checked a pair, and if not, why.
class RunCoverage {
 public:
  /// `side` says which run of the map `run` is.
  RunCoverage(const ClashDocument& run, const FileMap& files, RunSide side)
      : run_(run), files_(files), other_side_(opposite_run(side)) {
    for (const DocumentTest& test : run.tests) tests_.emplace(test.name, &test);
  }

  [[nodiscard]] const DocumentTest* test(const std::string& name) const {
    const auto it = tests_.find(name);
    return it == tests_.end() ? nullptr : it->second;
  }

  /// Returns why a result that the other run has may be missing here; empty if there is no reason.
  [[nodiscard]] std::string reason(const DocumentResult& r, const ClashDocument& other_run) const {
    const DocumentTest& other = other_run.tests[r.test];
    const DocumentTest* const here = test(other.name);
    if (here == nullptr) return "there is no test '" + other.name + "'";
    const ObjectPresence a = side(other_run.a(r), *here), b = side(other_run.b(r), *here);
    for (const ObjectPresence* s : {&a, &b})
      if (!s->there) return named(s->object) + " is not in the model";
    if (std::string why = not_tested(a, b, *here); !why.empty()) return why;
    for (const ObjectPresence* s : {&a, &b})
      if (const std::string* why = why_incomplete(*s, *here))
        return named(s->object) + " could not be compared whole (" + *why + ")";
    for (const ObjectPresence* s : {&a, &b})
      if (sheets(run_, s->element) >
          sheets(other_run, clash::element_hash(s->object.file, s->object.id)))
        return named(s->object) +
               " has surfaces that enclose nothing beyond those of the other run";
    const Hash128 key = clash::pair_hash(here->name, {a.file, a.object.id}, {b.file, b.object.id});
    if (const std::string* why = listed(run_.not_compared, key))
      return "the pair could not be compared (" + *why + ")";
    if (const std::string* rule = listed(run_.exempted, key)) return "exempted by " + *rule;
    if (!run_.lists_exempted && here->exempted_pairs > 0)
      return "may be among the " + std::to_string(here->exempted_pairs) +
             " exempted pairs, which are not listed";
    if (const std::uint64_t contacts = unlisted(*here); contacts > 0)
      return "may be among the " + std::to_string(contacts) + " contacts, which are not listed";
    if (here->not_reported > 0)
      return "may be among the " + std::to_string(here->not_reported) +
             " results that the test does not report";
    return by_settings(r, *here, other);
  }

 private:
  /// An object of the other run as this one knows it.
  struct ObjectPresence {
    const DocumentObject& object;
    std::string file;  ///< the label of its file in this run
    std::uint64_t element = 0;
    bool there = false, in_a = false, in_b = false;
  };

  /// Returns how many contacts the run counted but did not list.
  [[nodiscard]] static std::uint64_t unlisted(const DocumentTest& here) {
    return here.unlisted ? here.unlisted->contact + here.unlisted->allowed : 0;
  }

  /// Returns why an object could not be compared whole; null if it was.
  [[nodiscard]] const std::string* why_incomplete(const ObjectPresence& side,
                                                  const DocumentTest& here) const {
    const auto test = static_cast<std::uint32_t>(&here - run_.tests.data());
    const auto wanted = std::pair(side.element, test);
    const auto key = [](const DocumentLacking& l) { return std::pair(l.element, l.test); };
    const auto at = std::ranges::lower_bound(run_.lacking, wanted, {}, key);
    return at != run_.lacking.end() && key(*at) == wanted ? &run_.rules[at->code] : nullptr;
  }

  /// Returns the rule, or the reason, by which a list has a pair; null if it does not have it.
  [[nodiscard]] const std::string* listed(const std::vector<DocumentExempted>& list,
                                          const Hash128& key) const {
    const auto at = std::ranges::lower_bound(list, key, {}, &DocumentExempted::key);
    return at != list.end() && at->key == key ? &run_.rules[at->rule] : nullptr;
  }

  /// Returns how many parts of an element enclose nothing, so that what lies within them is not
  /// found; 0 where the run does not say.
  [[nodiscard]] static int sheets(const ClashDocument& run, std::uint64_t element) {
    const auto at = std::ranges::lower_bound(run.elements, element);
    const bool there = at != run.elements.end() && *at == element && !run.sheets.empty();
    return there ? run.sheets[static_cast<std::size_t>(at - run.elements.begin())] : 0;
  }

  [[nodiscard]] ObjectPresence side(const DocumentObject& object, const DocumentTest& here) const {
    std::string file = files_.label_in_other(other_side_, object.file, object.id);
    const std::uint64_t hash = clash::element_hash(file, object.id);
    const auto at = std::ranges::lower_bound(run_.elements, hash);
    if (at == run_.elements.end() || *at != hash) return {object, std::move(file), hash};
    const auto i = static_cast<std::size_t>(at - run_.elements.begin());
    const auto in = [i](const std::vector<std::uint8_t>& set) {
      return ((set[i / 8] >> (i % 8)) & 1U) != 0;
    };
    return {object, std::move(file), hash, true, in(here.in_a), in(here.in_b)};
  }

  [[nodiscard]] static std::string not_tested(const ObjectPresence& a, const ObjectPresence& b,
                                              const DocumentTest& here) {
    if (!here.within_files && a.file == b.file)
      return "pairs within a file are not looked at" + of_test(here);
    for (const ObjectPresence* s : {&a, &b})
      if (!s->in_a && !s->in_b) return named(s->object) + " is in neither set" + of_test(here);
    const bool opposite = (a.in_a && b.in_b) || (b.in_a && a.in_b);
    return opposite ? std::string() : "both are in the same set" + of_test(here);
  }

  /// Returns the settings by which a pair as far apart as the other run found it would be no result
  /// here.
  [[nodiscard]] static std::string by_settings(const DocumentResult& r, const DocumentTest& here,
                                               const DocumentTest& other) {
    if (here.has_matrix || other.has_matrix) {
      for (const auto& [name, value] : other.settings) {
        const auto it = here.settings.find(name);
        if (it == here.settings.end() || it->second != value) return "settings differ: " + name;
      }
      return {};
    }
    const auto curves = [](const DocumentTest& test) { return setting(test, "curves") == "true"; };
    if (!curves(here) && curves(other)) return "settings differ: curves";
    if (r.d_mm <= here.touch_gap_mm || r.d_mm < here.clearance_mm) return {};
    const std::string added = setting(here, "clearance_attribute");
    if (added != setting(other, "clearance_attribute"))
      return "settings differ: clearance_attribute";
    if (here.clearance_mm < other.clearance_mm) return "settings differ: clearance_mm";
    if (here.touch_gap_mm < other.touch_gap_mm) return "settings differ: touch_gap_mm";
    // What welding moved out of reach is a result, too.
    if (setting(here, "weld_mm") != setting(other, "weld_mm")) return "settings differ: weld_mm";
    // What the objects add is of the model: it is gone where they add less, as where they moved.
    if (!added.empty()) return {};
    return "it was farther apart than the tolerances of either run";
  }

  [[nodiscard]] static std::string setting(const DocumentTest& test, const std::string& name) {
    const auto it = test.settings.find(name);
    return it == test.settings.end() ? std::string() : it->second;
  }

  const ClashDocument& run_;
  const FileMap& files_;
  RunSide other_side_;
  std::map<std::string, const DocumentTest*> tests_;
};

void compare_settings(const RunCoverage& before, const RunCoverage& after, ClashDiff& diff) {
  for (const DocumentTest& test : diff.before->tests) {
    const DocumentTest* const other = after.test(test.name);
    if (other == nullptr) {
      diff.tests_gone.push_back(test.name);
      continue;
    }
    std::map<std::string, std::pair<std::string, std::string>> values;
    for (const auto& [name, value] : test.settings) values[name].first = value;
    for (const auto& [name, value] : other->settings) values[name].second = value;
    for (const auto& [name, value] : values)
      if (value.first != value.second)
        diff.settings.push_back({test.name, name, value.first, value.second});
  }
  for (const DocumentTest& test : diff.after->tests)
    if (before.test(test.name) == nullptr) diff.tests_added.push_back(test.name);
}

}  // namespace

int compare_region_counts(const DocumentResult& before, const DocumentResult& after) {
  const bool counted = before.regions > 0 && after.regions > 0;
  if (!counted || before.regions == after.regions) return 0;
  return before.regions < after.regions ? 1 : -1;
}

namespace {

bool counts_as_new(const DiffEntry& e, bool hits_only) {
  return e.before == nullptr && e.after->rule == 0 &&
         (!hits_only || e.after->cls == clash::Class::hit);
}

}  // namespace

bool ClashDiff::has_new(bool hits_only) const {
  return std::ranges::any_of(added,
                             [=](const DiffEntry& e) { return counts_as_new(e, hits_only); });
}

std::size_t ClashDiff::maybe_new(bool hits_only) const {
  return static_cast<std::size_t>(std::ranges::count_if(
      cannot_tell, [=](const DiffEntry& e) { return counts_as_new(e, hits_only); }));
}

bool ClashDiff::has_worse() const {
  return has_new(false) || std::ranges::any_of(changed, [](const DiffEntry& e) {
           const DocumentResult &was = *e.before, &is = *e.after;
           if (is.rule != 0) return false;
           if (was.rule != 0 || severity(is.cls) > severity(was.cls)) return true;
           return is.cls == was.cls &&
                  (is.d_mm < was.d_mm - kSameMm || compare_region_counts(was, is) > 0);
         });
}

namespace {

/// A result of the old run with the key that it has in the new one.
struct KeyedResult {
  Hash128 key;
  const DocumentResult* result = nullptr;
};

std::vector<KeyedResult> keyed_for_new_run(const ClashDocument& before, const FileMap& files) {
  std::vector<KeyedResult> keyed;
  keyed.reserve(before.results.size());
  for (const DocumentResult& r : before.results) {
    keyed.push_back({r.key, &r});
    if (files.is_identity()) continue;
    const DocumentObject &a = before.a(r), &b = before.b(r);
    const std::string file_a = files.label_in_other(RunSide::before, a.file, a.id);
    const std::string file_b = files.label_in_other(RunSide::before, b.file, b.id);
    keyed.back().key = clash::pair_hash(before.tests[r.test].name, {file_a, a.id}, {file_b, b.id});
  }
  if (!files.is_identity()) std::ranges::sort(keyed, {}, &KeyedResult::key);
  return keyed;
}

}  // namespace

void ClashDiff::add_still_there(DiffEntry entry) {
  const DocumentResult &x = *entry.before, &y = *entry.after;
  const bool is_same = x.cls == y.cls && std::fabs(x.d_mm - y.d_mm) <= kSameMm &&
                       compare_region_counts(x, y) == 0 && x.allowed_regions == y.allowed_regions &&
                       before->allowed(x) == after->allowed(y);
  (is_same ? same : changed).push_back(std::move(entry));
}

void ClashDiff::sort() {
  for (std::vector<DiffEntry>* const list : {&added, &changed, &same, &gone, &cannot_tell})
    std::ranges::sort(*list, comes_first);
}

ClashDiff compare(const ClashDocument& before, const ClashDocument& after, FileMatches matches) {
  ClashDiff diff;
  diff.before = &before;
  diff.after = &after;
  diff.files = std::move(matches);
  const FileMap files = map_of(diff.files, before, after);
  const RunCoverage coverage_before(before, files, RunSide::before);
  const RunCoverage coverage_after(after, files, RunSide::after);
  compare_settings(coverage_before, coverage_after, diff);
  const auto still_there = [&](DiffEntry&& e) { diff.add_still_there(std::move(e)); };
  const PositionalResults placed_before(before, after, files, RunSide::before);
  const PositionalResults placed_after(after, before, files, RunSide::after);
  diff.same.reserve(std::min(before.results.size(), after.results.size()));
  const std::vector<KeyedResult> old_results = keyed_for_new_run(before, files);
  auto x = old_results.begin();
  auto y = after.results.begin();
  while (x != old_results.end() || y != after.results.end()) {
    const bool is = y != after.results.end() && (x == old_results.end() || y->key <= x->key);
    const bool was = x != old_results.end() && (y == after.results.end() || x->key <= y->key);
    // Both or neither are of one key.
    const bool positional = is ? placed_after.has(*y) : placed_before.has(*x->result);
    if (positional) {
      // A key does not identify them.
    } else if (is && was) {
      still_there({x->result, &*y, {}});
    } else if (is) {
      diff.added.push_back({nullptr, &*y, coverage_before.reason(*y, after)});
    } else {
      std::string why = coverage_after.reason(*x->result, before);
      (why.empty() ? diff.gone : diff.cannot_tell).push_back({x->result, nullptr, std::move(why)});
    }
    if (was) ++x;
    if (is) ++y;
  }
  for (DiffEntry& e : match_by_position(placed_before, placed_after)) {
    if (e.before != nullptr && e.after != nullptr)
      still_there(std::move(e));
    else
      diff.cannot_tell.push_back(std::move(e));
  }
  diff.sort();
  return diff;
}

}  // namespace strake::report
