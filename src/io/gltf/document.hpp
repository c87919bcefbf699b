// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstddef>
#include <span>
#include <string_view>
#include <vector>

#include "io/gltf/json/array_split.hpp"
#include "io/gltf/json/json.hpp"
#include "strake/core/result.hpp"
#include "strake/parallel/context.hpp"

namespace strake::io::gltf {

/// The JSON of a glTF file: its nodes as text, in pieces, and an index of all the rest.
///
/// Most of the text of a large model is nodes. Each is looked at once, so that a piece is indexed,
/// read and forgotten by one worker; an index of all of them was the largest thing in memory
/// (decision 0067).
class Document {
 public:
  /// The index of a piece of this size stays in the cache of its worker. Between 64 KiB and 1 MiB
  /// no difference can be seen (decision 0073).
  static constexpr std::size_t kPieceBytes = std::size_t{1} << 18U;

  /// The text must outlive the document. The error's `where` is the byte offset alone.
  [[nodiscard]] static Result<Document> open(std::string_view text,
                                             const parallel::Context& context = {},
                                             std::size_t piece_bytes = kPieceBytes);

  /// Returns the document; where the text is long, its nodes are an empty array there.
  [[nodiscard]] JsonValue root() const { return rest_.root(); }
  [[nodiscard]] std::span<const ArrayPiece> node_pieces() const { return nodes_.pieces; }
  [[nodiscard]] std::size_t node_count() const { return nodes_.count; }

  /// Parses the whole text for the sake of its error, once a piece of the nodes turned out to be no
  /// JSON.
  [[nodiscard]] Error fault(const parallel::Context& context) const;

 private:
  bool index_rest(const ArraySplit& split, const parallel::Context& context);
  void take_nodes_of_index();

  std::string_view text_;
  std::vector<char> rest_text_;  ///< what `rest_` is of, unless it is the text itself
  JsonDocument rest_;
  ArraySplit nodes_;
};

/// How many values enclose a node.
inline constexpr std::size_t kNodeDepth = 2;

}  // namespace strake::io::gltf
