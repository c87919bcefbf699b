// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstdint>
#include <filesystem>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

#include "io/rvm/builder.hpp"
#include "io/source/text_decoder.hpp"
#include "strake/core/diagnostics.hpp"
#include "strake/core/result.hpp"
#include "strake/model/model.hpp"

namespace strake::io::rvm {

/// An element of an attribute file. Texts are views of the file, not yet decoded.
struct AttributeNode {
  std::string_view name;
  std::uint32_t parent = kNoGroup;
  std::vector<std::pair<std::string_view, std::string_view>> values;
};

struct AttributeFile {
  std::vector<AttributeNode> nodes;  ///< parents before children; the header block left out
  std::uint64_t unreadable_lines = 0;
  bool ends_early = false;  ///< it ends within an element: what the rest said is not known
};

/// Parses an attribute file (".att" or ".txt" beside the model): blocks `NEW name … END` of
/// `key := value` lines, with the four tokens that its first line declares.
///
/// Indentation has no meaning. A missing END counts as closed by the next NEW only at the end of
/// the file, since a missing END cannot be distinguished from nesting. It is an error when the
/// first line is not that of an attribute file.
[[nodiscard]] Result<AttributeFile> parse_attributes(std::string_view text);

/// Returns the attribute file beside a model: same name, ending .att or .txt in any case, .att
/// first.
[[nodiscard]] std::optional<std::filesystem::path> find_attribute_file(
    const std::filesystem::path& model_path);

/// Gives the objects, and the groups that hold others, the attributes of the elements they are, by
/// path from the root where that matches, otherwise by a name that occurs once on both sides; an
/// ambiguous name matches nothing. What stays without a partner is counted in a note.
void attach_attributes(RvmModel& built, const AttributeFile& file, const TextDecoder& decode,
                       std::string_view where, Diagnostics& diagnostics);

/// Returns the reference number of an element ("=16821/2"), which survives renaming; empty when
/// absent or null.
[[nodiscard]] std::string reference_of(const model::Attributes& attributes);

}  // namespace strake::io::rvm
