// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstdio>
#include <cstdlib>
#include <sstream>
#include <string>
#include <string_view>
#include <utility>

#include "strake/drawing/ink.hpp"
#include "strake/drawing/write.hpp"
#include "strake/report/view_diff.hpp"
#include "strake/report/view_drawing.hpp"
#include "support/view_documents.hpp"

namespace strake::test {

/// The same bytes as a drawing that is written again: an error, or a picture.
inline void feed_view_drawing(const std::string& bytes) {
  std::istringstream in(bytes);
  auto read = report::parse_view_drawing(in, "fuzz.json");
  if (!read) return;
  drawing::LayoutOptions options;
  options.scale = 7 * read->drawing.sheet.scale;
  if (auto again = drawing::lay_out_again(read->drawing, options, {}))
    read->drawing = std::move(*again);
  const auto ink = drawing::choose_ink(read->drawing, {.hidden = true}, {});
  if (!ink) return;
  drawing::write_svg(read->drawing, *ink, read->model, [](std::string_view) {});
}

/// Any bytes as a drawing: an error that names the file, or a document that compares with any other
/// that looks from the same side, and is no different from itself.
inline void feed_view_document(const std::string& bytes) {
  static const report::ViewDocument other =
      view_document(view_document_seeds()[0].bytes, "before.json");
  const auto stop = [](const char* what) {
    std::fprintf(stderr, "%s\n", what);
    std::abort();
  };
  feed_view_drawing(bytes);
  std::istringstream in(bytes);
  const auto document = report::parse_view_document(in, "fuzz.json");
  if (!document) {
    if (document.error().where.find("fuzz.json") == std::string::npos)
      stop("an error without a file");
    return;
  }
  const auto self = report::compare(*document, *document, {}, {});
  if (!self) stop("a drawing does not compare with itself");
  if (self->differs(false)) stop("a drawing differs from itself");
  const auto matched = [](const report::ViewDocument& before, const report::ViewDocument& after) {
    report::ViewDiffOptions options;
    options.files = report::match_files(before, after).value();
    return report::compare(before, after, options, {});
  };
  for (const auto& diff :
       {report::compare(*document, other, {}, {}), report::compare(other, *document, {}, {}),
        matched(*document, other), matched(other, *document)}) {
    if (!diff) continue;
    std::size_t size = 0;
    const auto count = [&](std::string_view piece) { size += piece.size(); };
    report::write_view_diff_json(*diff, count);
    report::write_view_diff_svg(*diff, count);
    if (size == 0) stop("a comparison without a document");
    (void)report::view_diff_table(*diff, {});
  }
}

}  // namespace strake::test
