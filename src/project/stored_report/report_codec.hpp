// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstddef>
#include <cstdint>
#include <optional>
#include <span>
#include <string>
#include <vector>

#include "strake/clash/clash.hpp"
#include "strake/clash/incremental.hpp"
#include "strake/core/hash.hpp"
#include "strake/core/result.hpp"
#include "strake/parallel/context.hpp"

/// Reports as bytes. The pairs of a range of objects are a part of their own, so that a run after a
/// small change writes a small part of a large report again.
namespace strake::project {

/// The pairs of so many objects, as their a, are one part.
inline constexpr std::uint32_t kObjectsPerPart = 1024;
static_assert(kObjectsPerPart == clash::PartnerBlocks::kObjects);

/// A report, and the row of the table `clash` for each of its pairs; 0: it has none.
struct RememberedReport {
  clash::Report report;
  std::vector<std::int64_t> rows;
  std::vector<Hash128> parts;  ///< of the bytes of its parts, where it was decoded
  std::optional<clash::PartnerBlocks> partners;  ///< where it was decoded
};

/// The same of a report that is somewhere else.
struct ReportRows {
  const clash::Report& report;
  std::span<const std::int64_t> rows;

  ReportRows(const clash::Report& of, std::span<const std::int64_t> its) : report(of), rows(its) {}
  ReportRows(const RememberedReport& all)  // NOLINT(google-explicit-constructor): it is a view
      : report(all.report), rows(all.rows) {}
};

/// The pairs of one part, and their regions, as ranges of a report.
struct PartRange {
  std::size_t first_pair = 0, last_pair = 0, first_region = 0, last_region = 0;
};

/// Returns the parts of a report over so many objects; an empty one for objects without pairs.
[[nodiscard]] std::vector<PartRange> parts_of(const clash::Report& report, std::size_t objects);

/// Whether a part of one report is the same as one of another, with the same rows.
[[nodiscard]] bool is_same_part(const ReportRows& x, const PartRange& of_x, const ReportRows& y,
                                const PartRange& of_y);

/// Whether two reports over one model say the same, bit for bit; what the runs took does not count.
[[nodiscard]] Result<bool> is_same_result(const clash::Report& x, const clash::Report& y);

/// The level of zstd at which parts are stored, and that for those that are read once and soon.
inline constexpr int kStoredLevel = 1, kPassingLevel = -5;

/// Encode a report without its pairs, its regions and its log, and one part of these.
[[nodiscard]] Result<std::vector<std::byte>> encode_head(const clash::Report& report);
[[nodiscard]] Result<std::vector<std::byte>> encode_part(const ReportRows& report,
                                                         const PartRange& range,
                                                         int level = kStoredLevel);

/// The pairs of one part, and their regions: Pair::first_region is one more than the place in
/// `regions`, or 0 where none are listed.
struct DecodedPart {
  std::vector<clash::Pair> pairs;
  std::vector<clash::Region> regions;
  std::vector<std::int64_t> rows;
};

/// Returns the part of this number of a report over so many objects, of which the head is decoded.
/// Errors: input; `what` is what they call it.
[[nodiscard]] Result<DecodedPart> decode_part(std::span<const std::byte> bytes,
                                              const clash::Report& head, std::size_t objects,
                                              std::size_t part, const std::string& what);

/// Returns what tells the bytes of a report from any others: by it a part that is missing, or one
/// of an earlier run, is not taken for a result. `parts` are the hashes of the bytes of the parts.
[[nodiscard]] Hash128 seal_of(std::span<const std::byte> head, std::span<const std::byte> kept,
                              std::span<const Hash128> parts);

/// A report as it is stored; the bytes must outlast decode_report().
struct EncodedReport {
  std::span<const std::byte> head, kept;
  std::vector<std::vector<std::byte>> parts;
  Hash128 seal;  ///< seal_of() all of it
};

/// Returns the report that was encoded, without a log and without what is kept for changes. Errors:
/// input for bytes that are no report over so many objects or not those that were sealed,
/// cancelled; `what` is what errors call it.
[[nodiscard]] Result<RememberedReport> decode_report(const EncodedReport& encoded,
                                                     std::size_t objects, const std::string& what,
                                                     const parallel::Context& context);

}  // namespace strake::project
