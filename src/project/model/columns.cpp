// SPDX-License-Identifier: Apache-2.0
#include "project/model/columns.hpp"

#include <algorithm>
#include <numeric>
#include <unordered_map>
#include <utility>

#include "core/seeded_hash.hpp"

namespace strake::project {
namespace {

std::vector<std::uint32_t> of_length(std::vector<std::uint32_t> values, BlobReader& in,
                                     std::size_t count) {
  if (values.size() != count) in.refuse("a column has another number of values than the others");
  values.resize(count);
  return values;
}

}  // namespace

void write_steps(BlobWriter& out, std::span<const std::uint32_t> values) {
  std::vector<std::uint32_t> steps;
  steps.reserve(values.size());
  std::uint32_t expected = 0;
  for (const std::uint32_t value : values) {
    steps.push_back(value - expected);
    expected = value + 1;
  }
  out.planes(steps);
}

std::vector<std::uint32_t> read_steps(BlobReader& in) {
  std::vector<std::uint32_t> values = in.planes<std::uint32_t>();
  std::uint32_t expected = 0;
  for (std::uint32_t& value : values) {
    value += expected;
    expected = value + 1;
  }
  return values;
}

std::vector<std::uint32_t> read_steps(BlobReader& in, std::size_t count) {
  return of_length(read_steps(in), in, count);
}

std::vector<std::uint32_t> read_planes(BlobReader& in, std::size_t count) {
  return of_length(in.planes<std::uint32_t>(), in, count);
}

void TextColumn::add(std::string_view text) {
  lengths_.push_back(static_cast<std::uint32_t>(text.size()));
  all_ += text;
}

void TextColumn::write(BlobWriter& out) const {
  out.planes(lengths_);
  out.text(all_);
}

TextSource::TextSource(BlobReader& in) : lengths_(in.planes<std::uint32_t>()), all_(in.text()) {
  const std::uint64_t sum = std::accumulate(lengths_.begin(), lengths_.end(), std::uint64_t{0});
  if (sum == all_.size()) return;
  in.refuse("texts are cut off");
  lengths_.clear();
}

std::string_view TextSource::next() {
  if (at_ == lengths_.size()) return {};
  const std::size_t length = lengths_[at_++];
  begin_ += length;
  return std::string_view(all_).substr(begin_ - length, length);
}

void write_attributes(BlobWriter& out, std::span<const model::Attributes* const> owners) {
  std::vector<std::uint32_t> counts, texts;
  TextColumn dictionary;
  std::unordered_map<std::string_view, std::uint32_t, SeededHash> numbers;
  const auto number_of = [&](std::string_view text) {
    if (text.size() > kLongestShared) {
      dictionary.add(text);
      return static_cast<std::uint32_t>(dictionary.size() - 1);
    }
    const auto [at, added] =
        numbers.try_emplace(text, static_cast<std::uint32_t>(dictionary.size()));
    if (added) dictionary.add(text);
    return at->second;
  };
  counts.reserve(owners.size());
  for (const model::Attributes* const attributes : owners) {
    counts.push_back(static_cast<std::uint32_t>(attributes->size()));
    for (const auto& [key, value] : *attributes) {
      texts.push_back(number_of(key));
      texts.push_back(number_of(value));
    }
  }
  dictionary.write(out);
  out.planes(counts);
  out.planes(texts);
}

void read_attributes(BlobReader& in, std::span<model::Attributes* const> owners) {
  TextSource source(in);
  std::vector<std::string_view> dictionary(source.size());
  for (std::string_view& text : dictionary) text = source.next();
  const std::vector<std::uint32_t> counts = read_planes(in, owners.size());
  const std::vector<std::uint32_t> texts = in.planes<std::uint32_t>();
  const std::uint64_t sum = std::accumulate(counts.begin(), counts.end(), std::uint64_t{0});
  const bool known =
      std::ranges::all_of(texts, [&](std::uint32_t text) { return text < dictionary.size(); });
  if (2 * sum != texts.size() || !known) in.refuse("attributes are cut off");
  if (in.failed()) return;
  std::vector<bool> taken(dictionary.size(), false);
  for (const std::uint32_t text : texts) {
    if (taken[text] && dictionary[text].size() > kLongestShared)
      return in.refuse("a long text stands for many");
    taken[text] = true;
  }
  std::size_t at = 0;
  for (std::size_t i = 0; i < owners.size(); ++i) {
    owners[i]->reserve(counts[i]);
    for (std::uint32_t k = 0; k < counts[i]; ++k, at += 2)
      owners[i]->emplace_back(dictionary[texts[at]], dictionary[texts[at + 1]]);
  }
}

}  // namespace strake::project
