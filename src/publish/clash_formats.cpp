// SPDX-License-Identifier: Apache-2.0
#include "publish/clash_formats.hpp"

#include <span>

#include "page/page.hpp"

namespace strake::publish {
namespace {

std::vector<report::ClashWriter> clash_writers() {
  const std::span<const report::ClashWriter> texts = report::clash_writers();
  std::vector<report::ClashWriter> all{texts.begin(), texts.end()};
  all.push_back({{".html", ", or {}, a page with the model that opens in a browser"},
                 page::write_clash_page});
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
