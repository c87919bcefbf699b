// SPDX-License-Identifier: Apache-2.0
#include <algorithm>
#include <cstddef>
#include <cstdint>
#include <numeric>
#include <string>
#include <string_view>
#include <tuple>
#include <vector>

#include "report/text.hpp"
#include "strake/core/number.hpp"
#include "strake/report/clash.hpp"

namespace strake::report {
namespace {

using clash::Pair;
using clash::Report;

constexpr std::size_t kClassColumns = 9, kNumberColumns = 10, kRelationColumns = 12;
constexpr std::size_t kFixedColumns = kClassColumns + kNumberColumns + kRelationColumns + 8;
constexpr std::size_t kLeastName = 8;

/// The class as a column of the table has room for it.
std::string_view short_name(clash::Class cls) {
  return cls == clash::Class::clearance_violation ? "CLEARANCE" : name(cls);
}

std::vector<std::size_t> worst(const Report& report, std::size_t rows) {
  std::vector<std::size_t> order(report.pairs.size());
  std::iota(order.begin(), order.end(), std::size_t{0});
  const std::size_t shown = std::min(rows, order.size());
  std::partial_sort(order.begin(), order.begin() + static_cast<std::ptrdiff_t>(shown), order.end(),
                    [&](std::size_t i, std::size_t j) {
                      const Pair &x = report.pairs[i], &y = report.pairs[j];
                      if (x.cls != y.cls) return x.cls > y.cls;
                      return std::tuple(x.d_mm, i) < std::tuple(y.d_mm, j);
                    });
  order.resize(shown);
  return order;
}

std::string right_aligned(std::string text, std::size_t columns) {
  if (text.size() < columns) text.insert(0, columns - text.size(), ' ');
  return text;
}

void strip(std::string& line) {
  while (!line.empty() && line.back() == ' ') line.pop_back();
}

std::string row(std::string_view cls, std::string d, std::string_view relation, std::string_view a,
                std::string_view b, std::size_t name_columns) {
  std::string line = fitted(cls, kClassColumns) + "  " +
                     right_aligned(std::move(d), kNumberColumns) + "  " +
                     fitted(relation, kRelationColumns) + "  " + fitted(a, name_columns) + "  " +
                     fitted(b, name_columns);
  strip(line);
  return line + "\n";
}

std::string_view label(const model::Model& model, model::ObjectId id) {
  const model::Object& o = model.object(id);
  return o.name.empty() ? o.id : o.name;
}

std::string summary(const Report& report) {
  return std::to_string(report.count_hit) + " hits, " + std::to_string(report.count_contact) +
         " contacts, " + std::to_string(report.count_clearance) + " clearance violations\n";
}

}  // namespace

std::string clash_table(const Report& report, const model::Model& model,
                        const TableOptions& options) {
  std::string out;
  const std::size_t shown = std::min(options.rows, report.pairs.size());
  if (shown > 0) {
    const std::size_t room = options.width > kFixedColumns ? options.width - kFixedColumns : 0;
    const std::size_t names = std::max(kLeastName, room / 2);
    out += row("class", "d mm", "relation", "a", "b", names);
    for (const std::size_t i : worst(report, shown)) {
      const Pair& p = report.pairs[i];
      out += row(short_name(p.cls), fixed(p.d_mm, 3), name(p.relation), label(model, p.a),
                 label(model, p.b), names);
    }
    if (report.pairs.size() > shown)
      out += "… and " + std::to_string(report.pairs.size() - shown) + " more\n";
    out += "\n";
  }
  return out + summary(report);
}

}  // namespace strake::report
