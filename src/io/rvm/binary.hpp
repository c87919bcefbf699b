// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstdint>
#include <optional>
#include <string>

#include "io/rvm/big_endian.hpp"
#include "io/rvm/builder.hpp"
#include "io/rvm/diagnostic_log.hpp"
#include "io/source/text_decoder.hpp"
#include "strake/parallel/context.hpp"

namespace strake::io::rvm {

/// What the head of a file says.
struct FileHead {
  std::uint32_t version = 0;  ///< the version in HEAD; 0 when there is none
  std::string info, note, date, user, encoding;
  std::string project, name;
};

/// What reading found of the file as a whole.
struct FileRead {
  bool cancelled = false;   ///< then nothing else is of use
  bool ends_early = false;  ///< it has no END chunk
};

/// Returns the byte offset of the HEAD chunk within the first 64 KiB; nothing when there is none.
[[nodiscard]] std::optional<std::size_t> find_head(Bytes bytes);

/// Whether the file holds chunk ids with their low byte first: it was written by a program that got
/// the byte order of the format wrong.
[[nodiscard]] bool is_byte_swapped(Bytes bytes);

/// Reads the chunks of a binary file into the builder.
///
/// A damaged chunk is skipped with a diagnostic and reading goes on at the next place where a chunk
/// id is found; nesting is kept on a stack of our own.
[[nodiscard]] FileRead read_binary(Bytes bytes, const std::optional<TextDecoder>& stated_encoding,
                                   RvmBuilder& builder, DiagnosticLog& log, FileHead& head,
                                   const parallel::Context& context);

}  // namespace strake::io::rvm
