// SPDX-License-Identifier: Apache-2.0
#include "project/model/stored_diagnostics.hpp"

#include <algorithm>
#include <array>
#include <cstdint>
#include <filesystem>
#include <tuple>
#include <utility>
#include <vector>

#include "project/codec/blob.hpp"
#include "project/model/columns.hpp"

namespace strake::project {
namespace {

/// What model::finish() adds, one code after the other; all others are of readers. They name the
/// file by its label.
constexpr std::array<std::string_view, 2> kOfFinish{"object-id-positional", "object-id-repeated"};

bool is_of_finish(std::string_view code) {
  return std::ranges::find(kOfFinish, code) != kOfFinish.end();
}

/// Adds those of a file of which `wanted` is true.
template <class Wanted>
void add_some(Diagnostics& all, const FileDiagnostics& file, Wanted&& wanted) {
  for (Diagnostic one : file.diagnostics.kept()) {
    if (!wanted(one.code)) continue;
    if (is_of_finish(one.code) && one.where.starts_with(file.name))
      one.where.replace(0, file.name.size(), file.label);
    all.add(std::move(one));
  }
  for (const Diagnostics::Count& count : file.diagnostics.counts())
    if (wanted(count.code) && count.count > Diagnostics::kMaxPerCode)
      all.count_more(count.code, count.count - Diagnostics::kMaxPerCode);
}

}  // namespace

Result<Blob> pack_diagnostics(const Diagnostics& diagnostics) {
  TextColumn texts, codes;
  std::vector<std::uint8_t> severities;
  for (const Diagnostic& one : diagnostics.kept()) {
    severities.push_back(static_cast<std::uint8_t>(one.severity));
    texts.add(one.code);
    texts.add(one.message);
    texts.add(one.where);
  }
  BlobWriter out;
  out.column<std::uint8_t>(severities);
  texts.write(out);
  std::vector<std::uint64_t> more;
  for (const Diagnostics::Count& count : diagnostics.counts()) {
    if (count.count <= Diagnostics::kMaxPerCode) continue;
    codes.add(count.code);
    more.push_back(count.count - Diagnostics::kMaxPerCode);
  }
  codes.write(out);
  out.column<std::uint64_t>(more);
  return out.finish();
}

Result<Diagnostics> unpack_diagnostics(std::span<const std::byte> blob, std::string what) {
  Result<BlobReader> in = BlobReader::open(blob, std::move(what));
  if (!in) return in.error();
  const std::vector<std::uint8_t> severities = in->column<std::uint8_t>();
  TextSource texts(*in);
  if (texts.size() != severities.size() * 3) in->refuse("messages lack");
  TextSource codes(*in);
  const std::vector<std::uint64_t> more = in->column<std::uint64_t>();
  if (codes.size() != more.size()) in->refuse("counts lack");
  if (std::ranges::any_of(severities, [](std::uint8_t severity) {
        return severity > static_cast<std::uint8_t>(Severity::skipped);
      }))
    in->refuse("a message is of no severity");
  if (const Status status = in->finish(); !status) return status.error();
  Diagnostics diagnostics;
  for (const std::uint8_t severity : severities) {
    Diagnostic one;
    one.severity = static_cast<Severity>(severity);
    one.code = texts.next();
    one.message = texts.next();
    one.where = texts.next();
    diagnostics.add(std::move(one));
  }
  for (const std::uint64_t count : more) diagnostics.count_more(codes.next(), count);
  return diagnostics;
}

Diagnostics joined_diagnostics(std::span<const FileDiagnostics> files, const Diagnostics& of_all) {
  std::vector<std::tuple<std::string, std::string, const FileDiagnostics*>> by_name;
  for (const FileDiagnostics& file : files)
    by_name.emplace_back(std::filesystem::path(file.given).filename().string(), file.given, &file);
  std::ranges::sort(by_name, {},
                    [](const auto& one) { return std::pair(std::get<0>(one), std::get<1>(one)); });
  Diagnostics all;
  for (const auto& [name, given, file] : by_name)
    add_some(all, *file, [](std::string_view code) { return !is_of_finish(code); });
  all.append(of_all);
  for (const std::string_view of_finish : kOfFinish)
    for (const FileDiagnostics& file : files)
      add_some(all, file, [&](std::string_view code) { return code == of_finish; });
  return all;
}

}  // namespace strake::project
