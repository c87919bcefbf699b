// SPDX-License-Identifier: Apache-2.0
#include "page/results/result_blocks.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <cstdint>
#include <limits>
#include <memory>
#include <optional>
#include <string>
#include <utility>

#include "clash/results/clash_key.hpp"
#include "clash/results/required_clearance.hpp"
#include "page/blocks/columns.hpp"
#include "report/clash/group_numbers.hpp"
#include "report/text/formatting.hpp"

namespace strake::page {
namespace {

using clash::Pair;
using clash::Report;

constexpr std::uint32_t kNone = 0xffffffffU;
constexpr std::uint8_t kNoDecision = 255, kNoClass = 255;

/// How a result states where it is measured.
enum class Witness : std::uint8_t { points, exit_direction, none };

Witness witness_of(const Pair& pair) {
  if (pair.d_mm >= 0) return Witness::points;
  return pair.away == geometry::Vec3d{} ? Witness::none : Witness::exit_direction;
}

/// The first point of a witness, and the second one or the direction.
std::array<geometry::Vec3d, 2> witness_vectors(const Pair& pair) {
  switch (witness_of(pair)) {
    case Witness::points:
      return {pair.on_a_mm, pair.on_b_mm};
    case Witness::exit_direction:
      return {pair.surface_mm(), pair.away};
    case Witness::none:
      break;
  }
  return {};
}

/// Adds the columns of one kind of row, of which `at(row)` has what a column requests.
template <class At>
class ColumnsOf {
 public:
  ColumnsOf(Columns& columns, std::size_t rows, At at)
      : columns_(columns), rows_(rows), at_(std::move(at)) {}

  template <class T, class Value>
  void numbers(std::string_view name, const Value& value) {
    columns_.numbers<T>(name, rows_,
                        [at = at_, value](std::size_t row) -> T { return value(at(row)); });
  }
  template <class Value>
  void millionths(std::string_view name, const Value& value) {
    columns_.millionths(
        name, rows_, [at = at_, value](std::size_t row) -> std::int64_t { return value(at(row)); });
  }
  /// Adds d with its bracket, and the point; `found(row)` is a result or a region.
  template <class TestedResult>
  void measured(TestedResult found) {
    millionths("d", [found](const auto& row) { return report::millionths(found(row).d_mm); });
    millionths("d_low", [found](const auto& row) {
      return report::millionths_floor(found(row).d_lower_mm);
    });
    millionths("d_high",
               [found](const auto& row) { return report::millionths_ceil(found(row).d_upper_mm); });
    constexpr std::array<std::string_view, 3> kAxes{"x", "y", "z"};
    for (int k = 0; k < 3; ++k)
      millionths(kAxes[static_cast<std::size_t>(k)], [found, k](const auto& row) {
        return report::millionths(found(row).point_mm[k]);
      });
    numbers<std::uint32_t>("part_a", [found](const auto& row) { return found(row).part_a; });
    numbers<std::uint32_t>("part_b", [found](const auto& row) { return found(row).part_b; });
  }

 private:
  Columns& columns_;
  std::size_t rows_;
  At at_;
};

/// A result with the test that found it.
struct TestedResult {
  PageRow row;
  std::size_t number;
  const Report& test;
  const Pair& pair;
};

/// Makes the block of results.
class ResultColumns {
 public:
  explicit ResultColumns(const ResultSource& source)
      : source_(source),
        findings_(source.contents.findings),
        rows_(source.rows.size()),
        columns_("strake-results") {}

  Block make() {
    add_sides();
    add_measures();
    add_optional();
    if (source_.contents.decided != nullptr) add_decisions();
    return std::move(columns_).finish();
  }

 private:
  /// Returns the values of columns for a row; it refers to the source, not to this.
  [[nodiscard]] auto found() const {
    return [rows = &source_.rows, findings = &findings_](std::size_t number) {
      const PageRow row = rows->at(number);
      const Report& test = findings->tests[row.test];
      return TestedResult{row, number, test, test.pairs[row.pair]};
    };
  }
  [[nodiscard]] auto of_results() { return ColumnsOf(columns_, rows_, found()); }
  template <class Predicate>
  [[nodiscard]] bool any_test(Predicate predicate) const {
    return std::ranges::any_of(findings_.tests, predicate);
  }
  template <class Predicate>
  [[nodiscard]] bool any_pair(Predicate predicate) const {
    return any_test([&](const Report& test) { return std::ranges::any_of(test.pairs, predicate); });
  }

  void add_sides() {
    columns_.keys(
        "key", rows_,
        [model = &source_.contents.model, at = found()](std::size_t row, std::string& out) {
          const TestedResult one = at(row);
          out += clash::pair_key(one.test.name, *model, one.pair.a, one.pair.b);
        });
    auto columns = of_results();
    const auto numbers = source_.objects.number_of;
    columns.template numbers<std::uint16_t>(
        "test", [](const TestedResult& f) { return static_cast<std::uint16_t>(f.row.test); });
    columns.template numbers<std::uint32_t>(
        "a", [numbers](const TestedResult& f) { return (*numbers)[model::index(f.pair.a)]; });
    columns.template numbers<std::uint32_t>(
        "b", [numbers](const TestedResult& f) { return (*numbers)[model::index(f.pair.b)]; });
  }

  void add_measures() {
    auto columns = of_results();
    columns.template numbers<std::uint8_t>(
        "class", [](const TestedResult& f) { return class_number(f.pair.cls); });
    columns.template numbers<std::uint8_t>("relation", [](const TestedResult& f) {
      return static_cast<std::uint8_t>(f.pair.relation);
    });
    columns.template numbers<std::uint8_t>("flags", [](const TestedResult& f) {
      return flag_bits(f.pair.flags, f.pair.depth_complete);
    });
    columns.measured([](const TestedResult& f) -> const Pair& { return f.pair; });
    columns.template numbers<std::uint8_t>("witness", [](const TestedResult& f) {
      return static_cast<std::uint8_t>(witness_of(f.pair));
    });
    constexpr std::array<std::string_view, 6> kNames{"p_x", "p_y", "p_z", "q_x", "q_y", "q_z"};
    for (std::size_t k = 0; k < kNames.size(); ++k)
      columns.millionths(kNames[k], [k](const TestedResult& f) {
        return report::millionths(witness_vectors(f.pair)[k / 3][static_cast<int>(k % 3)]);
      });
  }

  void add_optional() {
    auto columns = of_results();
    if (source_.contents.grouping != nullptr)
      columns.template numbers<std::uint32_t>(
          "group", [numbers = std::make_shared<const report::GroupNumbers>(source_.contents)](
                       const TestedResult& f) {
            return numbers->of(f.row.test, f.row.pair).value_or(kNone);
          });
    if (!source_.names.rules.empty())
      columns.template numbers<std::uint16_t>(
          "allowed", [names = &source_.names](const TestedResult& f) {
            if (f.pair.allowed < 0) return kNoName;
            return names->rule_of[f.row.test][static_cast<std::size_t>(f.pair.allowed)];
          });
    if (any_pair([](const Pair& p) { return may_be(p) != kNoClass; }))
      columns.template numbers<std::uint8_t>("may_be",
                                             [](const TestedResult& f) { return may_be(f.pair); });
    if (any_test([](const Report& test) { return test.levels; })) add_levels();
    if (!source_.names.disciplines.empty()) add_disciplines();
    if (any_test([](const Report& test) {
          return std::ranges::any_of(test.pairs, [&](const Pair& p) {
            return clash::required_clearance_mm(test, p).has_value();
          });
        }))
      columns.millionths("clearance", [](const TestedResult& f) {
        const std::optional<double> mm = clash::required_clearance_mm(f.test, f.pair);
        return mm ? report::millionths(*mm) : std::int64_t{-1};
      });
    if (any_test([](const Report& test) { return test.options.engine.max_regions > 0; }))
      columns.template numbers<std::uint32_t>("region_count", [](const TestedResult& f) {
        if (f.test.options.engine.max_regions == 0) return std::uint32_t{0};
        return f.pair.regions == 0 ? kNone : f.pair.regions;
      });
    if (any_pair([](const Pair& p) { return p.allowed_regions > 0; }))
      columns.template numbers<std::uint32_t>(
          "allowed_region_count", [](const TestedResult& f) { return f.pair.allowed_regions; });
    if (any_test(
            [](const Report& test) { return test.options.engine.volumes == clash::Volumes::on; }))
      add_volumes();
  }

  static std::uint8_t may_be(const Pair& p) {
    if (p.severest > (p.allowed < 0 ? p.cls : clash::Class::no_hit))
      return class_number(p.severest);
    return kNoClass;
  }

  void add_levels() {
    auto columns = of_results();
    // 0 is for tests that distinguish no levels.
    const auto number = [](const Report& test, clash::Level level) {
      return test.levels ? static_cast<std::uint8_t>(static_cast<unsigned>(level) + 1U)
                         : std::uint8_t{0};
    };
    columns.template numbers<std::uint8_t>(
        "level_a", [number](const TestedResult& f) { return number(f.test, f.pair.level_a); });
    columns.template numbers<std::uint8_t>(
        "level_b", [number](const TestedResult& f) { return number(f.test, f.pair.level_b); });
  }

  void add_disciplines() {
    auto columns = of_results();
    const auto number = [names = &source_.names](const TestedResult& f, model::ObjectId object) {
      if (f.test.disciplines.empty()) return kNoName;
      const std::uint32_t label = f.test.discipline[model::index(object)];
      return label == clash::kNoLabel ? kNoName : names->discipline_of[f.row.test][label];
    };
    columns.template numbers<std::uint16_t>(
        "discipline_a", [number](const TestedResult& f) { return number(f, f.pair.a); });
    columns.template numbers<std::uint16_t>(
        "discipline_b", [number](const TestedResult& f) { return number(f, f.pair.b); });
  }

  static bool has_volume(const TestedResult& f) {
    return f.pair.cls == clash::Class::hit && f.test.options.engine.volumes == clash::Volumes::on;
  }

  void add_volumes() {
    constexpr double kMaxMm3 = 9e12;  // beyond it a double has no millionths
    auto columns = of_results();
    if (any_pair([](const Pair& p) { return p.volume_mm3.value_or(0) > kMaxMm3; })) {
      columns.template numbers<double>("volume_mm3", [](const TestedResult& f) {
        if (!has_volume(f)) return std::numeric_limits<double>::quiet_NaN();
        return f.pair.volume_mm3 ? static_cast<double>(report::millionths(*f.pair.volume_mm3)) / 1e6
                                 : -1.0;
      });
      return;
    }
    constexpr std::int64_t kNotKnown = -1, kNotMeasured = -2;
    columns.millionths("volume", [](const TestedResult& f) {
      if (!has_volume(f)) return kNotMeasured;
      return f.pair.volume_mm3 ? report::millionths(*f.pair.volume_mm3) : kNotKnown;
    });
  }

  void add_decisions() {
    auto columns = of_results();
    const auto decided = std::make_shared<const std::vector<const report::DecidedResult*>>(
        decided_rows(source_.contents, source_.rows));
    columns.template numbers<std::uint8_t>("status", [decided](const TestedResult& f) {
      const report::DecidedResult* const of = (*decided)[f.number];
      if (of != nullptr) return static_cast<std::uint8_t>(of->decision->status);
      return f.pair.allowed >= 0 ? kNoDecision : std::uint8_t{0};
    });
    columns.template numbers<std::uint8_t>("reopened", [decided](const TestedResult& f) {
      const report::DecidedResult* const of = (*decided)[f.number];
      return of == nullptr ? std::uint8_t{0} : static_cast<std::uint8_t>(of->reopened);
    });
    add_texts(*decided);
  }

  void add_texts(const std::vector<const report::DecidedResult*>& decided) {
    NumberedTexts texts;
    (void)texts.number({});
    const auto add = [&](std::string_view name, auto text_of) {
      auto numbers = std::make_shared<std::vector<std::uint32_t>>();
      numbers->reserve(rows_);
      for (std::size_t row = 0; row < rows_; ++row) numbers->push_back(texts.number(text_of(row)));
      columns_.numbers<std::uint32_t>(name, rows_,
                                      [numbers](std::size_t row) { return (*numbers)[row]; });
    };
    const auto add_texts = [&](std::string_view name, std::string report::Decision::* member) {
      add(name, [&decided, member](std::size_t row) -> std::string_view {
        return decided[row] == nullptr ? std::string_view() : decided[row]->decision->*member;
      });
    };
    add_texts("decided_by", &report::Decision::by);
    add_texts("decided_on", &report::Decision::date);
    add_texts("comment", &report::Decision::comment);
    if (source_.assignee)
      add("assignee", [this](std::size_t row) { return source_.assignee(source_.rows.at(row)); });
    columns_.texts(
        "texts", texts.all().size(),
        [all = texts.all()](std::size_t i, std::string&) -> std::string_view { return all[i]; });
  }

  const ResultSource& source_;
  const clash::Findings& findings_;
  std::size_t rows_;
  Columns columns_;
};

/// A region with the result that it is of.
struct RegionRow {
  std::uint32_t result = 0;
  std::size_t test = 0;
  const clash::Region* region = nullptr;
};

std::vector<RegionRow> region_rows(const clash::Findings& findings) {
  std::vector<RegionRow> rows;
  std::uint32_t result = 0;
  for (std::size_t t = 0; t < findings.tests.size(); ++t) {
    const Report& test = findings.tests[t];
    for (const Pair& pair : test.pairs) {
      // Those that a rule allows stand behind the others.
      const std::size_t listed = std::size_t{pair.regions_listed(test.options)} +
                                 pair.allowed_regions_listed(test.options);
      for (std::size_t r = 0; r < listed; ++r)
        rows.push_back({result, t, &test.regions[pair.first_region + r]});
      ++result;
    }
  }
  return rows;
}

Block regions_block(std::vector<RegionRow> given, const PageNames& names) {
  const auto rows = std::make_shared<const std::vector<RegionRow>>(std::move(given));
  Columns block("strake-regions");
  ColumnsOf columns(block, rows->size(), [rows](std::size_t i) { return (*rows)[i]; });
  columns.numbers<std::uint32_t>("result", [](const RegionRow& r) { return r.result; });
  columns.numbers<std::uint16_t>("allowed", [&names](const RegionRow& r) {
    if (r.region->allowed < 0) return kNoName;
    return names.rule_of[r.test][static_cast<std::size_t>(r.region->allowed)];
  });
  columns.numbers<std::uint8_t>("class",
                                [](const RegionRow& r) { return class_number(r.region->cls); });
  columns.numbers<std::uint8_t>("flags", [](const RegionRow& r) {
    return flag_bits(r.region->flags, r.region->depth_complete);
  });
  columns.measured([](const RegionRow& r) -> const clash::Region& { return *r.region; });
  return std::move(block).finish();
}

Block groups_block(const clash::Grouping& grouping) {
  const std::vector<clash::Group>& groups = grouping.groups;
  Columns block("strake-groups");
  block.keys("id", groups.size(),
             [&groups](std::size_t i, std::string& out) { out += groups[i].id; });
  block.texts("name", groups.size(), [&groups](std::size_t i, std::string&) -> std::string_view {
    return groups[i].name;
  });
  ColumnsOf columns(block, groups.size(),
                    [&groups](std::size_t i) -> const clash::Group& { return groups[i]; });
  const auto count = [&](std::string_view name, auto of) {
    columns.numbers<std::uint32_t>(
        name, [of](const clash::Group& g) { return static_cast<std::uint32_t>(of(g)); });
  };
  count("results", [](const clash::Group& g) { return g.results.size(); });
  count("hits", [](const clash::Group& g) { return g.count_hit; });
  count("contacts", [](const clash::Group& g) { return g.count_contact; });
  count("clearance_violations", [](const clash::Group& g) { return g.count_clearance; });
  columns.numbers<std::uint8_t>("class",
                                [](const clash::Group& g) { return class_number(g.worst); });
  columns.millionths("d", [](const clash::Group& g) { return report::millionths(g.d_mm); });
  if (std::ranges::any_of(groups, [](const clash::Group& g) { return g.volume_mm3.has_value(); }))
    columns.millionths("volume", [](const clash::Group& g) {
      return g.volume_mm3 ? report::millionths(*g.volume_mm3) : std::int64_t{-2};
    });
  constexpr std::array<std::string_view, 3> kMin{"min_x", "min_y", "min_z"},
      kMax{"max_x", "max_y", "max_z"};
  for (int k = 0; k < 3; ++k)
    columns.millionths(kMin[static_cast<std::size_t>(k)], [k](const clash::Group& g) {
      return report::millionths_floor(g.box_mm.lo[k]);
    });
  for (int k = 0; k < 3; ++k)
    columns.millionths(kMax[static_cast<std::size_t>(k)], [k](const clash::Group& g) {
      return report::millionths_ceil(g.box_mm.hi[k]);
    });
  return std::move(block).finish();
}

}  // namespace

std::vector<Block> result_blocks(const ResultSource& source) {
  std::vector<Block> blocks;
  if (source.rows.size() > 0) blocks.push_back(ResultColumns(source).make());
  if (std::vector<RegionRow> rows = region_rows(source.contents.findings); !rows.empty())
    blocks.push_back(regions_block(std::move(rows), source.names));
  if (source.contents.grouping != nullptr && !source.contents.grouping->groups.empty())
    blocks.push_back(groups_block(*source.contents.grouping));
  return blocks;
}

}  // namespace strake::page
