// SPDX-License-Identifier: Apache-2.0
// Whether two clash reports say the same, bit for bit, in all that is written of them.
#pragma once

#include <cstddef>
#include <string>
#include <tuple>
#include <vector>

#include "strake/clash/clash.hpp"

namespace strake::test {

/// Says what differs first; empty where nothing does. Work counters and the log are not compared.
class ReportDifference {
 public:
  static std::string of(const clash::Report& x, const clash::Report& y) {
    return ReportDifference(x, y).text_;
  }

 private:
  ReportDifference(const clash::Report& x, const clash::Report& y) : x_(x), y_(y) {
    compare_counts();
    compare_pairs();
    compare_rules();
    compare_objects();
    compare_messages();
    same("hash", x.hash, y.hash);
    same("kept", x.kept.has_value(), y.kept.has_value());
    if (x.kept && y.kept) compare_kept(*x.kept, *y.kept);
  }

  template <class T>
  void same(const std::string& what, const T& x, const T& y) {
    if (text_.empty() && !(x == y)) text_ = what;
  }
  template <class List, class Tie>
  void same_lists(const std::string& what, const List& x, const List& y, const Tie& tie) {
    same("number of " + what, x.size(), y.size());
    if (!text_.empty()) return;
    for (std::size_t i = 0; i < x.size(); ++i)
      same(what + " " + std::to_string(i), tie(x[i]), tie(y[i]));
  }

  static auto counts(const clash::NotReported::Counts& c) {
    return std::tuple(c.hit, c.contact, c.clearance_violation, c.allowed);
  }

  void compare_counts() {
    const auto of = [](const clash::Report& r) {
      return std::vector{r.objects_a,        r.objects_b,         r.count_hit,
                         r.count_contact,    r.count_clearance,   r.count_allowed,
                         r.unlisted.allowed, r.unlisted.contacts, r.count_allowed_regions};
    };
    same("counts", of(x_), of(y_));
    same("left out by relation", counts(x_.not_reported.by_relation),
         counts(y_.not_reported.by_relation));
    same("left out by volume", counts(x_.not_reported.by_volume),
         counts(y_.not_reported.by_volume));
  }

  static auto tie(const clash::Pair& p) {
    const auto id = std::tuple(p.a, p.b, p.cls, p.relation, p.flags, p.severest, p.allowed);
    const auto numbers = std::tuple(p.d_mm, p.d_lower_mm, p.d_upper_mm, p.point_mm, p.on_a_mm,
                                    p.on_b_mm, p.away, p.volume_mm3);
    return std::tuple(id, numbers, p.deep_in_a, p.depth_complete, p.part_a, p.part_b, p.level_a,
                      p.level_b, p.regions, p.allowed_regions);
  }

  void compare_pairs() {
    same_lists("pair", x_.pairs, y_.pairs, [](const clash::Pair& p) { return tie(p); });
    same_lists("region", x_.regions, y_.regions, [](const clash::Region& r) {
      return std::tuple(r.cls, r.flags, r.d_mm, r.d_lower_mm, r.d_upper_mm, r.point_mm, r.box_mm.lo,
                        r.box_mm.hi, r.part_a, r.part_b, r.allowed, r.depth_complete);
    });
    if (!text_.empty()) return;
    for (std::size_t i = 0; i < x_.pairs.size(); ++i) {
      const clash::Pair& p = x_.pairs[i];
      if (p.regions_listed(x_.options) + p.allowed_regions_listed(x_.options) > 0)
        same("first region", p.first_region, y_.pairs[i].first_region);
    }
  }

  void compare_rules() {
    same_lists("exemption", x_.exempted, y_.exempted,
               [](const clash::Exempted& e) { return std::tuple(e.rule, e.pairs, e.shadowed_by); });
    same_lists("exempted pair", x_.exempted_pairs, y_.exempted_pairs,
               [](const clash::ExemptedPair& e) { return std::tuple(e.a, e.b, e.rule); });
    same_lists("allowance", x_.allowed, y_.allowed, [](const clash::AllowedCount& a) {
      return std::tuple(a.rule, a.candidates, a.pairs, a.regions, a.shadowed_by);
    });
    same_lists("discipline", x_.disciplines, y_.disciplines,
               [](const clash::DisciplineCount& d) { return std::tuple(d.name, d.objects); });
    same_lists("cell", x_.cells, y_.cells, [](const clash::CellReport& c) {
      return std::tuple(c.a, c.b, c.checked, c.hit, c.contact, c.clearance_violation, c.allowed,
                        c.tolerances.clearance_mm);
    });
    same("levels", x_.levels, y_.levels);
    same("whether exempted pairs are listed", x_.lists_exempted, y_.lists_exempted);
  }

  void compare_objects() {
    same("disciplines of objects", x_.discipline, y_.discipline);
    same("set A", x_.in_a, y_.in_a);
    same("set B", x_.in_b, y_.in_b);
    same("sheets", x_.sheets, y_.sheets);
    same("within files", x_.within_files, y_.within_files);
    same("contact distance", x_.contact_distance_mm, y_.contact_distance_mm);
    same("weld", x_.weld_mm, y_.weld_mm);
    same("names of sets", std::tie(x_.set_a, x_.set_b), std::tie(y_.set_a, y_.set_b));
    same_lists("not compared", x_.not_compared, y_.not_compared,
               [](const clash::NotCompared& n) { return std::tuple(n.a, n.b, n.code); });
  }

  void compare_messages() {
    same_lists("message", x_.diagnostics.kept(), y_.diagnostics.kept(), [](const Diagnostic& d) {
      return std::tuple(d.severity, d.code, d.message, d.where);
    });
    same_lists("count of messages", x_.diagnostics.counts(), y_.diagnostics.counts(),
               [](const Diagnostics::Count& c) { return std::tuple(c.code, c.severity, c.count); });
  }

  void compare_kept(const clash::KeptForChanges& x, const clash::KeptForChanges& y) {
    same("sum of hashes", x.hash_sum, y.hash_sum);
    same("elements", x.elements, y.elements);
    same_lists("kept exempted pair", x.exempted, y.exempted,
               [](const clash::ExemptedPair& e) { return std::tuple(e.a, e.b, e.rule); });
    same_lists("concerned pair", x.concerned, y.concerned,
               [](const clash::ConcernedPair& c) { return std::tuple(c.a, c.b, c.rule); });
    same_lists(
        "allowed regions", x.allowed_regions, y.allowed_regions,
        [](const clash::AllowedRegionCount& c) { return std::tuple(c.a, c.b, c.rule, c.regions); });
    same_lists("unreported pair", x.unreported, y.unreported, [](const clash::UnreportedPair& u) {
      return std::tuple(u.a, u.b, u.cls, u.allowed, u.by_volume);
    });
    same_lists("unlisted contact", x.unlisted, y.unlisted, [](const clash::UnlistedContact& c) {
      return std::tuple(c.a, c.b, c.allowed, c.hash);
    });
    same_lists("allowed contact", x.allowed_contacts, y.allowed_contacts,
               [](const clash::Pair& p) { return tie(p); });
  }

  const clash::Report &x_, &y_;
  std::string text_;
};

}  // namespace strake::test
