// SPDX-License-Identifier: Apache-2.0
#include "page/blocks/columns.hpp"

#include <algorithm>
#include <iterator>
#include <memory>

#include "core/text_encoding.hpp"

namespace strake::page {

namespace {

constexpr std::size_t kKeyCharacters = 26;

}  // namespace

Block view_block(std::string id, std::string_view text) {
  return {std::move(id),
          {{text.size(), text.size(), [text](std::size_t begin, std::size_t end, std::string& out) {
              out += text.substr(begin, end - begin);
            }}}};
}

Block text_block(std::string id, std::string text) {
  const auto shared = std::make_shared<const std::string>(std::move(text));
  Block block = view_block(std::move(id), *shared);
  // Who keeps the block keeps the text.
  block.sections.front().append = [shared, inner = block.sections.front().append](
                                      std::size_t begin, std::size_t end, std::string& out) {
    inner(begin, end, out);
  };
  return block;
}

void Columns::add(std::string_view name, std::string_view type, std::uint64_t count,
                  std::uint64_t text_bytes, std::vector<RowSource> sections) {
  directory_ += directory_.empty() ? "{\"columns\": [" : ", ";
  directory_.append("{\"name\": \"").append(name).append("\", \"type\": \"").append(type);
  directory_ += "\", \"count\": " + std::to_string(count);
  if (type == "text") directory_ += ", \"bytes\": " + std::to_string(text_bytes);
  directory_ += '}';
  std::ranges::move(sections, std::back_inserter(block_.sections));
}

void Columns::keys(std::string_view name, std::size_t rows,
                   std::function<void(std::size_t row, std::string& out)> append) {
  add(name, "key", rows, 0,
      {{rows, rows * kKeyCharacters,
        [append = std::move(append)](std::size_t begin, std::size_t end, std::string& out) {
          for (std::size_t row = begin; row < end; ++row) append(row, out);
        }}});
}

void Columns::texts(std::string_view name, std::size_t rows, const TextOf& text) {
  const auto shown = [text](std::size_t row, std::string& room, std::string& mended) {
    return valid_utf8(text(row, room), mended);
  };
  std::uint64_t bytes = 0;
  std::string room, mended;
  for (std::size_t row = 0; row < rows; ++row) bytes += shown(row, room, mended).size();
  RowSource lengths{rows, rows * sizeof(std::uint32_t),
                    [shown](std::size_t begin, std::size_t end, std::string& out) {
                      std::string of_row, valid;
                      for (std::size_t row = begin; row < end; ++row)
                        append_number(out,
                                      static_cast<std::uint32_t>(shown(row, of_row, valid).size()));
                    }};
  RowSource all{rows, bytes, [shown](std::size_t begin, std::size_t end, std::string& out) {
                  std::string of_row, valid;
                  for (std::size_t row = begin; row < end; ++row) out += shown(row, of_row, valid);
                }};
  add(name, "text", rows, bytes, {std::move(lengths), std::move(all)});
}

Block Columns::finish() && {
  directory_ += directory_.empty() ? "{\"columns\": []}" : "]}";
  std::string head = "SCOL";
  append_number(head, static_cast<std::uint32_t>(directory_.size()));
  RowSource first = std::move(text_block({}, head + directory_).sections.front());
  block_.sections.insert(block_.sections.begin(), std::move(first));
  return std::move(block_);
}

}  // namespace strake::page
