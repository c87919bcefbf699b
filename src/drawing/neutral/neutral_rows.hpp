// SPDX-License-Identifier: Apache-2.0
#pragma once

// Decision 0028 says why the file is rows behind a JSON head.
// Decision 0047 says why a checksum stands behind the rows.

#include <array>
#include <bit>
#include <cstdint>
#include <string>
#include <string_view>
#include <type_traits>

#include "strake/core/hash.hpp"

// The binary neutral drawing (docs/drawing.md): kMagic; the number of bytes of a text; the text, a
// document of schemas/view.schema.json that has "rows" in the place of "pieces"; the rows; where
// "rows" has a "checksum", that of everything before it. Numbers are little-endian.
namespace strake::drawing {

static_assert(std::endian::native == std::endian::little, "rows are copied as they are");

inline constexpr std::string_view kViewMagic = "STRKVIEW";
/// Rows begin at a multiple of this many bytes: blanks at the end of the text fill the gap.
inline constexpr std::uint64_t kRowsAlign = 16;

/// The name that "checksum" has for the 128 bits of the hash, the low half first.
inline constexpr std::string_view kChecksumName = "XXH3-128";
inline constexpr std::uint64_t kChecksumBytes = 16;

/// Returns the bytes of a checksum as a file has them.
[[nodiscard]] std::string checksum_bytes(const Hash128& checksum);

/// A Line in whole micrometres: Int is std::int32_t where that suffices, else std::int64_t.
template <class Int>
struct ViewRow {
  std::uint32_t object = 0, other = 0;  ///< indices into "objects"
  std::uint32_t edge = 0;
  std::uint32_t curve = 0;           ///< index into "curves", or 2^32 - 1
  std::uint8_t kind = 0, state = 0;  ///< indices into "kinds" and "states"
  std::array<std::uint8_t, 6> zero{};
  std::array<Int, 3> a{}, b{};              ///< ends in the model, from the form's origin
  std::array<Int, 2> a_paper{}, b_paper{};  ///< ends on the sheet
};
static_assert(std::has_unique_object_representations_v<ViewRow<std::int32_t>>);
static_assert(std::has_unique_object_representations_v<ViewRow<std::int64_t>>);

/// Returns the member "fields" of "rows", without blanks: the layout of a row.
template <class Int>
[[nodiscard]] std::string row_fields();

}  // namespace strake::drawing
