// SPDX-License-Identifier: Apache-2.0
#include "tiles/found_file.hpp"

#include <algorithm>
#include <iterator>
#include <string>
#include <utility>

#include "project/codec/blob.hpp"
#include "project/stored_report/report_head.hpp"
#include "tiles/tile.hpp"

namespace strake::tiles {
namespace {

using project::BlobReader;
using project::BlobWriter;

/// Takes the blobs of a file in their order.
class Blobs {
 public:
  Blobs(std::vector<Blob> all, const std::filesystem::path& file)
      : all_(std::move(all)), file_(file) {}

  /// Returns the next one; an empty one behind the last, which nothing can be read from.
  Blob next() { return at_ < all_.size() ? std::move(all_[at_++]) : Blob(); }

  /// Opens the next one. Errors: input (kLost); memory.
  Result<BlobReader> open_next() {
    Result<BlobReader> in = BlobReader::open(next(), file_.string());
    if (!in && in.error().code == ErrorCode::input) return lost(file_);
    return in;
  }

  [[nodiscard]] std::size_t left() const { return all_.size() - at_; }
  [[nodiscard]] const std::filesystem::path& file() const { return file_; }

 private:
  std::vector<Blob> all_;
  const std::filesystem::path& file_;
  std::size_t at_ = 0;
};

/// Takes the blobs of a test; what is known of it stands in `test`.
Status read_test(Blobs& blobs, std::size_t objects, FoundTest& test) {
  Result<BlobReader> in = blobs.open_next();
  if (!in) return in.error();
  clash::TileReport& tile = test.tile;
  tile.hash_sum = in->hash();
  for (std::uint64_t* const n : {&tile.hashed, &tile.box_pairs, &tile.parts}) *n = in->number();
  tile.unknown_sag = in->column<std::uint8_t>();
  const std::uint64_t parts = in->number();
  const Hash128 seal = in->hash();
  const bool fits = parts == (objects + project::kObjectsPerPart - 1) / project::kObjectsPerPart;
  if (!in->finish() || !fits || blobs.left() < 1 || parts > blobs.left() - 1)
    return lost(blobs.file());
  const Blob head = blobs.next();
  std::vector<Hash128> hashes;
  for (std::uint64_t p = 0; p < parts; ++p)
    hashes.push_back(hash_bytes(test.parts.emplace_back(blobs.next())));
  if (project::seal_of(head, {}, hashes) != seal) return lost(blobs.file());
  Result<clash::Report> report = project::decode_head(head, objects, blobs.file().string());
  if (!report) return report.error().code == ErrorCode::input ? lost(blobs.file()) : report.error();
  tile.report = std::move(*report);
  return {};
}

}  // namespace

Status FoundWriter::add(const clash::TileReport& tile) {
  const std::vector<std::int64_t> rows(tile.report.pairs.size(), 0);
  const project::ReportRows report(tile.report, rows);
  Result<Blob> head = project::encode_head(tile.report);
  if (!head) return head.error();
  std::vector<Blob> parts;
  std::vector<Hash128> hashes;
  for (const project::PartRange& range : project::parts_of(tile.report, objects_.size())) {
    Result<Blob> part = project::encode_part(report, range, project::kPassingLevel);
    if (!part) return part.error();
    hashes.push_back(hash_bytes(*part));
    parts.push_back(std::move(*part));
  }
  BlobWriter out;
  out.hash(tile.hash_sum);
  for (const std::uint64_t n : {tile.hashed, tile.box_pairs, tile.parts}) out.number(n);
  out.column(std::span(tile.unknown_sag));
  out.number(parts.size());
  out.hash(project::seal_of(*head, {}, hashes));
  Result<Blob> start = out.finish();
  if (!start) return start.error();
  blobs_.push_back(std::move(*start));
  blobs_.push_back(std::move(*head));
  std::ranges::move(parts, std::back_inserter(blobs_));
  counts_.push_back(tile.report.pairs.size());
  counts_.push_back(tile.report.regions.size());
  return {};
}

Status FoundWriter::write(const std::filesystem::path& file) && {
  BlobWriter out;
  out.number(objects_.size());
  out.hash(hash_of(objects_));
  for (const std::uint64_t count : counts_) out.number(count);
  Result<Blob> start = out.finish();
  if (!start) return start.error();
  blobs_.front() = std::move(*start);
  return write_blobs(file, blobs_);
}

Result<FoundFile> FoundFile::open(const std::filesystem::path& file,
                                  std::span<const std::uint32_t> objects, std::size_t tests,
                                  const parallel::Context& context) {
  Result<std::vector<Blob>> read = read_blobs(file, 1, context);
  if (!read) return read.error();
  Blobs blobs(std::move(*read), file);
  Result<BlobReader> in = blobs.open_next();
  if (!in) return in.error();
  const bool fits = in->number() == objects.size() && in->hash() == hash_of(objects);
  FoundFile found(file, objects);
  found.tests_.resize(tests);
  for (FoundTest& test : found.tests_) {
    test.pairs = in->number();
    test.regions = in->number();
  }
  if (!in->finish() || !fits) return lost(file);
  for (FoundTest& test : found.tests_)
    if (const Status s = read_test(blobs, objects.size(), test); !s) return s.error();
  return found;
}

Result<project::DecodedPart> FoundFile::part(std::size_t test, std::size_t number) const {
  const FoundTest& of_test = tests_[test];
  Result<project::DecodedPart> part =
      project::decode_part(of_test.parts[number], of_test.tile.report, objects_.size(), number,
                           file_->string() + ", part " + std::to_string(number));
  if (!part && part.error().code == ErrorCode::input) return lost(*file_);
  return part;
}

}  // namespace strake::tiles
