// SPDX-License-Identifier: Apache-2.0
#include "workbook/clash/picture_sheet.hpp"

#include <algorithm>
#include <cstdint>
#include <string>
#include <tuple>
#include <utility>
#include <vector>

#include "clash/results/clash_key.hpp"
#include "report/exchange/clash_row.hpp"
#include "strake/report/decisions.hpp"

namespace strake::workbook {
namespace {

using clash::ResultRef;
using report::ClashContents;

std::vector<ResultRef> worst_results(const ClashContents& contents) {
  std::vector<ResultRef> all;
  for (std::uint32_t t = 0; t < contents.findings.tests.size(); ++t) {
    const std::vector<clash::Pair>& pairs = contents.findings.tests[t].pairs;
    for (std::uint32_t p = 0; p < pairs.size(); ++p)
      if (pairs[p].allowed < 0 && pairs[p].cls != clash::Class::contact &&
          (contents.decided == nullptr || !contents.decided->is_settled(t, pairs[p])))
        all.push_back({t, p});
  }
  const auto rank = [&](const ResultRef& r) {
    const clash::Pair& pair = pair_of(contents, r);
    return std::tuple(-static_cast<int>(pair.cls), pair.d_mm, r.test, r.pair);
  };
  const std::size_t largest = std::min(all.size(), kMaxPictures);
  std::partial_sort(all.begin(), all.begin() + static_cast<std::ptrdiff_t>(largest), all.end(),
                    [&](const ResultRef& x, const ResultRef& y) { return rank(x) < rank(y); });
  all.resize(largest);
  return all;
}

}  // namespace

Result<Worksheet> picture_sheet(const ClashContents& contents, const parallel::Context& context) {
  constexpr double kPictureWidth = 46, kPictureHeight = 190;
  Worksheet sheet{.name = "Pictures",
                  .columns = {{"picture", kPictureWidth},
                              {"class", 22},
                              {"d_mm", 13},
                              {"a_name", 34},
                              {"b_name", 34},
                              {"x_mm", 13},
                              {"y_mm", 13},
                              {"z_mm", 13},
                              {"test", 18},
                              {"key", 29}},
                  .cells = {},
                  .row_height = kPictureHeight};
  sheet.class_column = 1;
  if (!contents.picture_of) return sheet;
  std::vector<ResultRef> worst = worst_results(contents);
  for (std::size_t i = 0; i < worst.size(); ++i) {
    if (context.stop.stop_requested()) return Error{ErrorCode::cancelled, "cancelled", {}, {}};
    Result<std::string> png = contents.picture_of(worst[i], context);
    if (!png) return png.error();
    if (size_of_png(*png)) sheet.pictures.push_back({i + 1, 0, std::move(*png)});
  }
  sheet.rows = worst.size();
  sheet.cells = [worst = std::move(worst), &contents](std::size_t i, SheetRow& row) {
    const clash::Pair& pair = pair_of(contents, worst[i]);
    const model::Model& model = contents.model;
    const std::string& test = contents.findings.tests[worst[i].test].name;
    row.blank().word(name(pair.cls)).number(pair.d_mm, report::append_mm);
    row.text(model.object(pair.a).name).text(model.object(pair.b).name);
    report::append_point(row, pair.point_mm);
    row.text(test).word(clash::pair_key(test, model, pair.a, pair.b));
  };
  return sheet;
}

}  // namespace strake::workbook
