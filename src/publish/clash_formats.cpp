// SPDX-License-Identifier: Apache-2.0
#include "publish/clash_formats.hpp"

#include <array>
#include <span>

#include "bcf/bcf_writers.hpp"
#include "page/page.hpp"
#include "pictures/whole_run.hpp"
#include "publish/pictured_workbook.hpp"

namespace strake::publish {
namespace {

constexpr std::array kPages{
    report::ClashWriter{{".html", ", or {}, a page with the model that opens in a browser"},
                        page::write_clash_page,
                        true},
};

std::vector<report::ClashWriter> clash_writers() {
  std::vector<report::ClashWriter> all;
  for (const std::span<const report::ClashWriter> table :
       {report::clash_writers(), workbook_writers(), bcf::clash_writers(),
        pictures::picture_writers(), std::span<const report::ClashWriter>(kPages)})
    all.insert(all.end(), table.begin(), table.end());
  return all;
}

}  // namespace

std::vector<OutputFormat> clash_formats() {
  const std::vector<report::ClashWriter> writers = clash_writers();
  return formats_of(std::span(writers));
}

Result<report::ClashWriter> find_clash_writer(const std::string& file) {
  const std::vector<report::ClashWriter> writers = clash_writers();
  return find_writer(std::span(writers), file);
}

}  // namespace strake::publish
