// SPDX-License-Identifier: Apache-2.0
// What tests read back of PDF files that Strake wrote: objects by the table at the end, streams
// inflated. It takes nothing for granted that a reader has to look up.
#pragma once

#include <zlib.h>

#include <cstddef>
#include <cstdlib>
#include <map>
#include <string>
#include <string_view>

namespace strake::test {

/// Returns the bytes that deflated() made; "damaged" where they are none.
inline std::string inflated(std::string_view bytes) {
  std::string out;
  z_stream stream{};
  if (inflateInit(&stream) != Z_OK) return "damaged";
  std::string input(bytes);
  stream.next_in = reinterpret_cast<Bytef*>(input.data());
  stream.avail_in = static_cast<uInt>(input.size());
  int status = Z_OK;
  while (status == Z_OK) {
    std::string room(std::size_t{1} << 16U, '\0');
    stream.next_out = reinterpret_cast<Bytef*>(room.data());
    stream.avail_out = static_cast<uInt>(room.size());
    status = inflate(&stream, Z_NO_FLUSH);
    out.append(room, 0, room.size() - stream.avail_out);
  }
  inflateEnd(&stream);
  return status == Z_STREAM_END ? out : "damaged";
}

struct PdfObjects {
  std::map<int, std::string> dictionaries;  ///< by number; of streams what stands before them
  std::map<int, std::string> streams;
  std::string trailer, fault;

  /// All contents of pages, one after another.
  [[nodiscard]] std::string contents() const {
    std::string all;
    for (const auto& [number, bytes] : streams)
      if (dictionaries.at(number).starts_with("<</Filter")) all += bytes;
    return all;
  }
  [[nodiscard]] bool has(std::string_view text) const {
    for (const auto& [number, dictionary] : dictionaries)
      if (dictionary.find(text) != std::string::npos) return true;
    return false;
  }
};

inline PdfObjects read_pdf(const std::string& pdf) {
  PdfObjects found;
  const auto fail = [&](const std::string& why) {
    found.fault = why;
    return found;
  };
  if (!pdf.starts_with("%PDF-1.7\n") || !pdf.ends_with("%%EOF\n"))
    return fail("no beginning or end");
  const std::size_t mark = pdf.rfind("startxref\n");
  const std::size_t table = std::strtoul(pdf.c_str() + mark + 10, nullptr, 10);
  if (pdf.compare(table, 5, "xref\n") != 0) return fail("the table is elsewhere");
  const int count = std::atoi(pdf.c_str() + table + 7);
  const std::size_t rows = pdf.find('\n', table + 5) + 1;
  found.trailer = pdf.substr(rows + 20 * static_cast<std::size_t>(count));
  if (!found.trailer.starts_with("trailer")) return fail("the table has another length");
  for (int number = 1; number < count; ++number) {
    const std::size_t row = rows + 20 * static_cast<std::size_t>(number);
    const std::size_t at = std::strtoul(pdf.c_str() + row, nullptr, 10);
    const std::string head = std::to_string(number) + " 0 obj\n";
    if (pdf.compare(at, head.size(), head) != 0) return fail(head + "is elsewhere");
    const std::size_t begin = at + head.size(), line = pdf.find('\n', begin);
    const std::size_t length_at = pdf.find("/Length ", begin);
    if (pdf.compare(line + 1, 7, "stream\n") == 0 && length_at < line) {
      const std::size_t length = std::strtoul(pdf.c_str() + length_at + 8, nullptr, 10);
      const std::size_t first = line + 8;
      if (pdf.compare(first + length, 18, "\nendstream\nendobj\n") != 0)
        return fail(head + "has another length");
      found.dictionaries[number] = pdf.substr(begin, line - begin);
      found.streams[number] = inflated(std::string_view(pdf).substr(first, length));
      if (found.streams[number] == "damaged") return fail(head + "is damaged");
    } else {
      found.dictionaries[number] = pdf.substr(begin, pdf.find("\nendobj\n", begin) - begin);
    }
  }
  return found;
}

}  // namespace strake::test
