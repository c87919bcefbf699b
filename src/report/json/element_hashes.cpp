// SPDX-License-Identifier: Apache-2.0
#include "report/json/element_hashes.hpp"

#include <utility>

#include "clash/results/clash_key.hpp"
#include "core/text_encoding.hpp"
#include "strake/parallel/deal.hpp"
#include "strake/parallel/for_each.hpp"
#include "strake/parallel/transform.hpp"

namespace strake::report {

Result<ElementHashes> ElementHashes::of(const model::Model& model,
                                        const parallel::Context& context) {
  constexpr std::size_t kGrain = 1024, kBuckets = 256;
  const auto hashed = parallel::transform(
      context, {.name = "hashes of elements", .n = model.objects.size(), .grain = kGrain},
      [&](std::size_t i) {
        const auto o = static_cast<std::uint32_t>(i);
        return HashedElement{clash::element_hash(model, model::ObjectId{o}), o};
      });
  if (!hashed) return hashed.error();
  // Hashes are spread evenly: buckets by their first byte are about equally long.
  auto dealt = parallel::deal<HashedElement, kBuckets>(
      context, "buckets of elements", hashed->size(),
      [&](std::size_t i) { return std::size_t{(*hashed)[i].hash >> 56U}; },
      [&](std::size_t i) { return (*hashed)[i]; });
  if (!dealt) return dealt.error();
  ElementHashes all;
  all.elements_ = std::move(dealt->values);
  const auto& begin = dealt->begin;
  const Status sorted =
      parallel::for_each(context, {.name = "sort elements", .n = kBuckets}, [&](std::size_t b) {
        const auto bucket = std::span(all.elements_).subspan(begin[b], begin[b + 1] - begin[b]);
        std::ranges::sort(bucket, [](const HashedElement& x, const HashedElement& y) {
          return x.hash != y.hash ? x.hash < y.hash : x.object < y.object;
        });
      });
  if (!sorted) return sorted.error();
  return all;
}

namespace {

/// Appends n items as base64, by all workers: append(i, bytes) adds the bytes of eight items from i
/// on, or of those that are left.
template <class Append>
Status append_encoded(std::string& out, std::size_t n, const parallel::Context& context,
                      const Append& append) {
  // Whole triples of bytes, be it a bit, a byte or eight for each item: texts of pieces are that of
  // the whole, end to end.
  constexpr std::size_t kPerPiece = std::size_t{24} * 2048;
  const auto texts = parallel::transform(
      context, {.name = "elements as text", .n = (n + kPerPiece - 1) / kPerPiece},
      [&](std::size_t piece) {
        std::vector<std::uint8_t> bytes;
        const std::size_t end = std::min(n, (piece + 1) * kPerPiece);
        for (std::size_t i = piece * kPerPiece; i < end; i += 8) append(i, bytes);
        std::string text;
        append_base64(text, bytes);
        return text;
      });
  if (!texts) return texts.error();
  for (const std::string& text : *texts) out += text;
  return {};
}

}  // namespace

Status ElementHashes::append_list(std::string& out, const parallel::Context& context) const {
  return append_encoded(out, elements_.size(), context,
                        [&](std::size_t first, std::vector<std::uint8_t>& bytes) {
                          for (const HashedElement& e : eight_from(first))
                            for (unsigned shift = 0; shift < 64; shift += 8)
                              bytes.push_back(static_cast<std::uint8_t>((e.hash >> shift) & 255U));
                        });
}

Status ElementHashes::append_members(std::string& out, const std::vector<bool>& member,
                                     const parallel::Context& context) const {
  return append_encoded(out, elements_.size(), context,
                        [&](std::size_t first, std::vector<std::uint8_t>& bytes) {
                          unsigned bits = 0, bit = 1;
                          for (const HashedElement& e : eight_from(first)) {
                            if (e.object < member.size() && member[e.object]) bits |= bit;
                            bit <<= 1U;
                          }
                          bytes.push_back(static_cast<std::uint8_t>(bits));
                        });
}

Status ElementHashes::append_bytes(std::string& out, const std::vector<std::uint8_t>& of_object,
                                   const parallel::Context& context) const {
  return append_encoded(
      out, elements_.size(), context, [&](std::size_t first, std::vector<std::uint8_t>& bytes) {
        for (const HashedElement& e : eight_from(first))
          bytes.push_back(e.object < of_object.size() ? of_object[e.object] : std::uint8_t{0});
      });
}

}  // namespace strake::report
