// SPDX-License-Identifier: Apache-2.0
#include "drawing/drawing_writers.hpp"

#include <array>

namespace strake::drawing {
namespace {

Result<Diagnostics> nothing_amiss(const Status& status) {
  if (!status) return status.error();
  return Diagnostics();
}

Result<Diagnostics> as_svg(const DrawingContents& contents, Sink sink,
                           const parallel::Context& context) {
  return nothing_amiss(write_svg(contents.drawing, contents.ink, contents.model, sink, context));
}

Result<Diagnostics> as_pdf(const DrawingContents& contents, Sink sink,
                           const parallel::Context& context) {
  return write_pdf(contents.drawing, contents.ink, contents.model, sink, context);
}

Result<Diagnostics> as_dxf(const DrawingContents& contents, Sink sink,
                           const parallel::Context& context) {
  return nothing_amiss(write_dxf(contents.drawing, contents.ink, contents.model, sink, context));
}

Result<Diagnostics> as_json(const DrawingContents& contents, Sink sink,
                            const parallel::Context& context) {
  return nothing_amiss(write_view_json(contents.drawing, contents.model, sink, context));
}

Result<Diagnostics> as_rows(const DrawingContents& contents, Sink sink,
                            const parallel::Context& context) {
  return nothing_amiss(write_view_rows(contents.drawing, contents.model, sink, context));
}

constexpr std::array kWriters{
    DrawingWriter{{".svg", " as {}"}, true, as_svg},
    DrawingWriter{{".pdf", " or {}"}, true, as_pdf},
    DrawingWriter{{".dxf", ", for CAD as {}"}, true, as_dxf},
    DrawingWriter{{".json", ", or its neutral form as {}"}, false, as_json},
    DrawingWriter{{".view", ", or {} for millions of lines"}, false, as_rows},
};

}  // namespace

std::span<const DrawingWriter> drawing_writers() { return kWriters; }

}  // namespace strake::drawing
