// SPDX-License-Identifier: Apache-2.0
#include "drawing/svg_layers.hpp"

#include <fmt/format.h>

#include <cstddef>
#include <span>
#include <vector>

#include "drawing/layers.hpp"
#include "strake/core/number.hpp"
#include "strake/drawing/write.hpp"

namespace strake::drawing {

namespace {

void append_point(std::string& out, const PaperPoint& p) {
  out += shortest(p.x);
  out += ' ';
  out += shortest(p.y);
}

void write_object(Chunked& out, const model::Model& model, std::span<const Line* const> lines) {
  const std::vector<Chain> chains = join_lines(lines);
  if (chains.empty()) return;
  const model::Object& object = model.object(lines.front()->object);
  out << "<g data-id=\"" << xml_escaped(object.id) << "\" data-name=\"" << xml_escaped(object.name)
      << "\" data-file=\"" << xml_escaped(model.files[object.file].label) << "\"><path d=\"";
  for (const Chain& chain : chains) {
    append_svg_chain(out.buffer(), chain);
    out << "";
  }
  out << "\"/></g>\n";
}

void write_layer(Chunked& out, const Ink& ink, const model::Model& model, const Layer& layer,
                 std::string_view prefix) {
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
    write_object(out, model, std::span(lines).subspan(i, end - i));
    i = end;
  }
  out << "</g>\n";
}

}  // namespace

void append_svg_chain(std::string& out, const Chain& chain) {
  const bool closed = chain.size() > 3 && chain.front() == chain.back();
  out += 'M';
  append_point(out, chain.front());
  for (std::size_t i = 1; i + (closed ? 1 : 0) < chain.size(); ++i) {
    out += i == 1 ? 'L' : ' ';
    append_point(out, chain[i]);
  }
  if (closed) out += 'Z';
}

void write_layers(Chunked& out, const Ink& ink, const model::Model& model,
                  std::string_view prefix) {
  for (const Layer& layer : kLayers) write_layer(out, ink, model, layer, prefix);
}

}  // namespace strake::drawing
