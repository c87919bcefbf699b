// SPDX-License-Identifier: Apache-2.0
#include "drawing/pdf/pdf_file.hpp"

#include <fmt/format.h>

namespace strake::drawing {

PdfFile::PdfFile(Sink sink) : sink_(sink) {
  // Bytes beyond ASCII tell programs that the file is not text.
  put("%PDF-1.7\n%\xE2\xE3\xCF\xD3\n");
}

void PdfFile::put(std::string_view bytes) {
  hash_.add(bytes);
  written_ += bytes.size();
  sink_(bytes);
}

std::uint32_t PdfFile::reserve() {
  places_.push_back(0);
  return static_cast<std::uint32_t>(places_.size());
}

void PdfFile::begin(std::uint32_t number) {
  places_[number - 1] = written_;
  put(std::to_string(number) + " 0 obj\n");
}

void PdfFile::write_object(std::uint32_t number, std::string_view contents) {
  begin(number);
  put(contents);
  put("\nendobj\n");
}

void PdfFile::write_stream(std::uint32_t number, std::string_view entries,
                           std::string_view deflated) {
  begin(number);
  put(fmt::format("<<{}/Filter/FlateDecode/Length {}>>\nstream\n", entries, deflated.size()));
  put(deflated);
  put("\nendstream\nendobj\n");
}

void PdfFile::finish(std::uint32_t catalog, std::uint32_t info) {
  const std::size_t table = written_;
  std::string end = fmt::format("xref\n0 {}\n0000000000 65535 f \n", places_.size() + 1);
  for (const std::size_t place : places_) end += fmt::format("{:010} 00000 n \n", place);
  const std::string identity = hash_.value().text();
  end += fmt::format(
      "trailer\n<</Size {}/Root {} 0 R/Info {} 0 R/ID[<{}><{}>]>>\nstartxref\n{}\n%%EOF\n",
      places_.size() + 1, catalog, info, identity, identity, table);
  put(end);
}

}  // namespace strake::drawing
