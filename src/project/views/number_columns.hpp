// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstddef>
#include <cstdint>
#include <span>
#include <vector>

#include "project/codec/blob.hpp"

/// Columns of whole numbers that are near to their neighbours, in few bytes and fast to read.
namespace strake::project {

/// Appends numbers as differences from one to the next, the lowest bytes of all first, then the
/// next higher ones as far as any is not zero: compression finds little to do in the high bytes.
void append_numbers(std::vector<std::uint8_t>& bytes, std::span<const std::int64_t> values);

/// Takes as many numbers off the front of the bytes as there is room for; any bytes give some.
/// False where there are too few.
[[nodiscard]] bool take_numbers(std::span<const std::uint8_t>& bytes,
                                std::span<std::int64_t> values);

/// Appends a column of such numbers to a blob.
void write_numbers(BlobWriter& out, std::span<const std::int64_t> values);

/// Takes a column that must have `size` numbers; otherwise the reader has a fault, and it returns
/// none. The caller knows that the blob has as many bytes, so that it cannot claim memory.
[[nodiscard]] std::vector<std::int64_t> read_numbers(BlobReader& in, std::size_t size);

}  // namespace strake::project
