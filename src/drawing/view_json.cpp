// SPDX-License-Identifier: Apache-2.0
#include <fmt/format.h>

#include <cstdint>
#include <iterator>
#include <string>
#include <string_view>

#include "drawing/batches.hpp"
#include "drawing/buffered.hpp"
#include "drawing/view_head.hpp"
#include "strake/drawing/write.hpp"

namespace strake::drawing {

namespace {

void append_line(std::string& out, const Line& line, std::string_view object, std::uint32_t curve,
                 const Listed& listed) {
  out += "{\"object\":";
  out += object;
  fmt::format_to(
      std::back_inserter(out), ",\"object_index\":{},\"edge\":{},\"kind\":\"{}\",\"state\":\"{}\"",
      listed.number(line.object), line.edge, kind_name(line.kind), state_name(line.state));
  if (line.kind == hlr::EdgeKind::intersection)
    fmt::format_to(std::back_inserter(out), ",\"other_index\":{}", listed.number(line.other));
  if (curve != PaperCurves::kNone)
    fmt::format_to(std::back_inserter(out), ",\"curve_index\":{}", curve);
  out += ",\"a_mm\":";
  append_numbers(out, {line.a_mm.x, line.a_mm.y, line.a_mm.z});
  out += ",\"b_mm\":";
  append_numbers(out, {line.b_mm.x, line.b_mm.y, line.b_mm.z});
  out += ",\"a_paper_mm\":";
  append_numbers(out, {line.a_paper.x, line.a_paper.y});
  out += ",\"b_paper_mm\":";
  append_numbers(out, {line.b_paper.x, line.b_paper.y});
  out += '}';
}

}  // namespace

Status write_view_json(const NeutralDrawing& drawing, const model::Model& model, Sink sink,
                       const parallel::Context& context) {
  const Listed listed(drawing.lines, model.objects.size());
  {
    Buffered out(sink);
    write_view_head(out, drawing, model, listed);
    out << "\"pieces\":[";
  }
  const auto encode = [&](std::size_t begin, std::size_t end, std::string& out) {
    std::string id;
    for (std::size_t i = begin; i < end; ++i) {
      const Line& line = drawing.lines[i];
      if (i == begin || drawing.lines[i - 1].object != line.object)
        id = json_quoted(model.object(line.object).id);
      out += i == 0 ? "\n" : ",\n";
      append_line(out, line, id, drawing.curves.index_of(line), listed);
    }
  };
  const Status status =
      write_in_batches("neutral drawing", drawing.lines.size(), encode, sink, context);
  if (!status) return status;
  sink("]}\n");
  return {};
}

}  // namespace strake::drawing
