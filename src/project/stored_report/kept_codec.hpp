// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstddef>
#include <cstdint>
#include <optional>
#include <span>
#include <string>
#include <vector>

#include "strake/clash/clash.hpp"
#include "strake/core/result.hpp"

namespace strake::project {

/// Encodes what a run keeps for the next one, but for KeptForChanges::elements, which lie with what
/// the result was computed from; nothing is no bytes.
[[nodiscard]] Result<std::vector<std::byte>> encode_kept(
    const std::optional<clash::KeptForChanges>& kept);

/// Decodes it; `elements` are those that lie elsewhere. Errors: input for what does not fit a
/// report over so many objects.
[[nodiscard]] Result<std::optional<clash::KeptForChanges>> decode_kept(
    std::span<const std::byte> bytes, const clash::Report& report, std::size_t objects,
    std::vector<std::uint64_t> elements, const std::string& what);

}  // namespace strake::project
