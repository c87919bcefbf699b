// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstddef>
#include <cstdint>
#include <cstdio>
#include <cstdlib>
#include <span>
#include <string>

#include "strake/io/reader.hpp"
#include "support/model_check.hpp"

namespace strake::test {

/// Gives bytes to a reader: it must answer with a sound model or with an error that names the
/// file, and ask recognise() without harm.
inline void feed(const io::Reader& reader, const char* name, const std::uint8_t* data,
                 std::size_t size) {
  const io::FileBytes file{name, std::as_bytes(std::span(data, size))};
  const int sureness = reader.recognise(file);
  const Result<model::Model> model = reader.read(file, {}, {});
  std::string fault = sureness < 0 || sureness > 100 ? "a sureness out of range" : "";
  if (model && fault.empty()) fault = model_fault(*model);
  if (!model && model.error().where.find(name) == std::string::npos)
    fault = "an error that does not name the file: " + model.error().text();
  if (fault.empty()) return;
  std::fprintf(stderr, "the reader gave %s\n", fault.c_str());
  std::abort();
}

}  // namespace strake::test
