// SPDX-License-Identifier: Apache-2.0
#include "drawing/svg_layers.hpp"

#include <fmt/format.h>

#include <cstddef>
#include <span>
#include <vector>

#include "drawing/layers.hpp"
#include "drawing/svg_path.hpp"
#include "strake/drawing/write.hpp"

namespace strake::drawing {

namespace {

void write_object(Buffered& out, const PaperCurves& curves, const model::Model& model,
                  std::span<const Line* const> lines) {
  const std::vector<JoinedLines> chains = join_lines(lines);
  if (chains.empty()) return;
  const model::Object& object = model.object(lines.front()->object);
  out << "<g data-id=\"" << xml_escaped(object.id) << "\" data-name=\"" << xml_escaped(object.name)
      << "\" data-file=\"" << xml_escaped(model.files[object.file].label) << "\"><path d=\"";
  for (const JoinedLines& chain : chains) {
    append_svg_path(out.text(), chain, curves);
    out << "";
  }
  out << "\"/></g>\n";
}

void write_layer(Buffered& out, const PaperCurves& curves, const Ink& ink,
                 const model::Model& model, const Layer& layer, std::string_view prefix) {
  std::vector<const Line*> lines;
  for (const Line& line : ink.lines)
    if (belongs(line, layer)) lines.push_back(&line);
  if (lines.empty()) return;
  const std::string_view state = layer.hidden ? "hidden" : "visible";
  const std::string_view kind = kind_name(layer.kind);
  out << fmt::format(
      "<g inkscape:groupmode=\"layer\" inkscape:label=\"{}\" id=\"{}{}-{}\" class=\"{} {}\">\n",
      layer.label, prefix, state, kind, state, kind);
  for (std::size_t i = 0; i < lines.size();) {
    std::size_t end = i + 1;
    while (end < lines.size() && lines[end]->object == lines[i]->object) ++end;
    write_object(out, curves, model, std::span(lines).subspan(i, end - i));
    i = end;
  }
  out << "</g>\n";
}

}  // namespace

void write_layers(Buffered& out, const PaperCurves& curves, const Ink& ink,
                  const model::Model& model, std::string_view prefix) {
  for (const Layer& layer : kLayers) write_layer(out, curves, ink, model, layer, prefix);
}

}  // namespace strake::drawing
