// SPDX-License-Identifier: Apache-2.0
#include "publish/sheet_formats.hpp"

#include <span>

#include "page/page.hpp"

namespace strake::publish {
namespace {

Result<Diagnostics> as_sheet_page(const sheets::SheetContents& contents, drawing::Sink sink,
                                  const parallel::Context& context) {
  const Status written = page::write_sheet_page(contents, sink, context);
  if (!written) return written.error();
  return Diagnostics();
}

}  // namespace

std::vector<sheets::SheetWriter> sheet_writers() {
  const std::span<const sheets::SheetWriter> lines = sheets::sheet_writers();
  std::vector<sheets::SheetWriter> all{lines.begin(), lines.end()};
  all.push_back({{".html"}, "HTML", true, as_sheet_page});
  return all;
}

}  // namespace strake::publish
