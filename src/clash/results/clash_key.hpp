// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstdint>
#include <optional>
#include <string>
#include <string_view>

#include "strake/core/hash.hpp"
#include "strake/model/model.hpp"

/// Names that stay the same from run to run, so that what was decided about a clash is found again.
/// Bytes of a label or id that are not UTF-8 count as U+FFFD, which is how files show them.
namespace strake::clash {

/// Returns 64 bits of hash of an object's file label and durable id.
[[nodiscard]] std::uint64_t element_hash(std::string_view file_label, std::string_view id);
[[nodiscard]] std::uint64_t element_hash(const model::Model& model, model::ObjectId id);

/// Returns the key of a clash: 26 characters of 0-9 and a-z without i, l, o and u. It depends on
/// the name of the test, the file labels and the durable ids of the two alone: it is the same
/// tomorrow, whatever the class, for swapped sets and files in another order.
[[nodiscard]] std::string pair_key(std::string_view test, const model::Model& model,
                                   model::ObjectId a, model::ObjectId b);

/// Returns it as the hash that it is.
[[nodiscard]] Hash128 pair_hash(std::string_view test, const model::Model& model, model::ObjectId a,
                                model::ObjectId b);

/// A durable id, with what it is unique within.
struct ElementName {
  std::string_view file_label, id;
};

/// Returns the key of two objects that are known by name, as the hash that it is.
[[nodiscard]] Hash128 pair_hash(std::string_view test, const ElementName& a, const ElementName& b);

/// Convert a hash to such a text, and back; any other text gives nothing. Texts are ordered as the
/// hashes are.
[[nodiscard]] std::string key_text(Hash128 hash);
[[nodiscard]] std::optional<Hash128> parse_key(std::string_view text);

}  // namespace strake::clash
