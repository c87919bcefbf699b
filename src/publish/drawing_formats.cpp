// SPDX-License-Identifier: Apache-2.0
#include "publish/drawing_formats.hpp"

#include <span>

#include "page/page.hpp"

namespace strake::publish {
namespace {

Result<Diagnostics> as_page(const drawing::DrawingContents& contents, drawing::Sink sink,
                            const parallel::Context& context) {
  const Status written = page::write_drawing_page(contents, sink, context);
  if (!written) return written.error();
  return Diagnostics();
}

}  // namespace

std::vector<drawing::DrawingWriter> drawing_writers() {
  const std::span<const drawing::DrawingWriter> lines = drawing::drawing_writers();
  std::vector<drawing::DrawingWriter> all{lines.begin(), lines.end()};
  all.push_back(
      {{".html", ", or with its model as {}, a page that opens in a browser"}, true, as_page});
  return all;
}

std::vector<OutputFormat> drawing_formats() {
  const std::vector<drawing::DrawingWriter> writers = drawing_writers();
  return formats_of(std::span(writers));
}

Result<drawing::DrawingWriter> find_drawing_writer(const std::string& file) {
  const std::vector<drawing::DrawingWriter> writers = drawing_writers();
  return find_writer(std::span(writers), file);
}

}  // namespace strake::publish
