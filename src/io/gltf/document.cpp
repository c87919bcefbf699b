// SPDX-License-Identifier: Apache-2.0
#include "io/gltf/document.hpp"

#include <optional>
#include <utility>

namespace strake::io::gltf {
namespace {

constexpr std::string_view kNodes = "nodes";

}  // namespace

Result<Document> Document::open(std::string_view text, const parallel::Context& context,
                                std::size_t piece_bytes) {
  Document document;
  document.text_ = text;
  Result<std::optional<ArraySplit>> split = split_array(text, kNodes, piece_bytes, context);
  if (!split) return split.error();
  if (*split && document.index_rest(**split, context)) {
    document.nodes_ = *std::move(*split);
    return document;
  }
  Result<JsonDocument> whole = JsonDocument::parse(text, context);
  if (!whole) return whole.error();
  document.rest_ = std::move(*whole);
  document.take_nodes_of_index();
  return document;
}

/// Indexes the text without its nodes. False where that is no JSON, or has other nodes.
bool Document::index_rest(const ArraySplit& split, const parallel::Context& context) {
  rest_text_.assign(text_.begin(), text_.begin() + static_cast<std::ptrdiff_t>(split.begin));
  rest_text_.insert(rest_text_.end(), text_.begin() + static_cast<std::ptrdiff_t>(split.end),
                    text_.end());
  Result<JsonDocument> rest = JsonDocument::parse({rest_text_.data(), rest_text_.size()}, context);
  if (!rest) return false;
  rest_ = std::move(*rest);
  // Of repeated keys the first counts, and a key can be written with escapes.
  const JsonValue nodes = rest_.root()[kNodes];
  return nodes.is_array() && nodes.raw().data() + 1 == rest_text_.data() + split.begin;
}

void Document::take_nodes_of_index() {
  const JsonValue nodes = rest_.root()[kNodes];
  if (!nodes.is_array()) return;
  std::string_view inside = nodes.raw();
  inside.remove_prefix(1);
  inside.remove_suffix(1);
  nodes.elements([&](const JsonValue&) { ++nodes_.count; });
  if (nodes_.count > 0) nodes_.pieces.push_back({inside, 0, nodes_.count});
}

Error Document::fault(const parallel::Context& context) const {
  const Result<JsonDocument> whole = JsonDocument::parse(text_, context);
  if (!whole) return whole.error();
  return {ErrorCode::internal, "the nodes could not be read", "", ""};
}

}  // namespace strake::io::gltf
