// SPDX-License-Identifier: Apache-2.0
#include <fmt/format.h>

#include <algorithm>
#include <limits>
#include <optional>
#include <utility>

#include "io/gltf/json.hpp"
#include "io/gltf/json_cuts.hpp"
#include "io/gltf/json_piece.hpp"
#include "strake/parallel/for_each.hpp"
#include "strake/parallel/transform.hpp"

namespace strake::io::gltf {
namespace {

using Pieces = std::vector<JsonPiece>;

/// Ties what one piece opened to what a later one closed. False: the pieces are no document.
class Joiner {
 public:
  explicit Joiner(JsonEntry* entries) : entries_(entries) {}

  bool add(const JsonPiece& piece, std::uint32_t base) {
    if (open_.size() + piece.deepest > JsonDocument::kMaxDepth) return false;
    for (const JsonPiece::Close& close : piece.closes) {
      if (!top_is(close.type)) return false;
      JsonEntry& opened = entries_[open_.back()];
      opened.end = close.text_end;
      opened.next = base + close.entries;
      open_.pop_back();
    }
    if (piece.outer != JsonType::absent && !top_is(piece.outer)) return false;
    for (const std::uint32_t entry : piece.open) open_.push_back(base + entry);
    return true;
  }
  [[nodiscard]] bool is_complete() const { return open_.empty(); }

 private:
  [[nodiscard]] bool top_is(JsonType type) const {
    return !open_.empty() && entries_[open_.back()].type == type;
  }

  JsonEntry* entries_;
  std::vector<std::uint32_t> open_;  ///< what earlier pieces left open, outermost first
};

Error invalid(const char* message, std::size_t at) {
  return {ErrorCode::input, fmt::format("is not valid JSON: {}", message),
          fmt::format("byte {}", at), "copy or export the file again"};
}

Result<Pieces> index_pieces(std::string_view text, std::size_t piece_bytes,
                            const parallel::Context& context) {
  const Result<std::vector<std::size_t>> cuts = json_cuts(text, piece_bytes, context);
  if (!cuts) return cuts.error();
  return parallel::transform(
      context, {.name = "index glTF text", .n = cuts->size() + 1}, [&](std::size_t k) {
        return index_json_piece(text, k == 0 ? 0 : (*cuts)[k - 1],
                                k == cuts->size() ? text.size() : (*cuts)[k]);
      });
}

/// The first fault of an only piece, which begins and ends as the text does.
std::optional<Error> fault_of(const JsonPiece& only) {
  if (only.message != nullptr) return invalid(only.message, only.at);
  if (only.behind_comma || !only.open.empty()) return invalid("the text ends too early", only.at);
  return std::nullopt;
}

}  // namespace

Result<JsonDocument> JsonDocument::parse(std::string_view text, const parallel::Context& context,
                                         std::size_t piece_bytes) {
  if (text.size() >= std::numeric_limits<std::uint32_t>::max())
    return invalid("more than 4 GiB of text", 0);
  Result<Pieces> pieces = index_pieces(text, piece_bytes, context);
  if (!pieces) return pieces.error();
  if (pieces->size() == 1)
    if (std::optional<Error> fault = fault_of(pieces->front())) return *std::move(fault);

  JsonDocument document;
  document.text_ = text;
  std::vector<std::uint32_t> bases{0};
  for (const JsonPiece& piece : *pieces)
    bases.push_back(bases.back() + static_cast<std::uint32_t>(piece.entries.size()));
  document.size_ = bases.back();
  document.entries_ = std::make_unique_for_overwrite<JsonEntry[]>(document.size_);
  const Status gathered = parallel::for_each(
      context, {.name = "gather glTF index", .n = pieces->size()}, [&](std::size_t k) {
        JsonEntry* out = document.entries_.get() + bases[k];
        for (const JsonEntry& entry : (*pieces)[k].entries) {
          *out = entry;
          out++->next += bases[k];
        }
        std::vector<JsonEntry>().swap((*pieces)[k].entries);
      });
  if (!gathered) return gathered.error();

  Joiner joiner(document.entries_.get());
  bool good = !pieces->back().behind_comma;
  for (std::size_t k = 0; k < pieces->size() && good; ++k)
    good = (*pieces)[k].message == nullptr && joiner.add((*pieces)[k], bases[k]);
  if (good && joiner.is_complete()) return document;
  // In one piece the text is read as it stands, and says where it is at fault.
  return parse(text, context, std::max<std::size_t>(text.size(), 1));
}

}  // namespace strake::io::gltf
