// SPDX-License-Identifier: Apache-2.0
// Outputs of a run, each in the format that the name of its file requests.
#pragma once

#include <span>
#include <string>

#include "cli/run/session.hpp"
#include "core/output_format.hpp"
#include "strake/core/result.hpp"
#include "strake/model/model.hpp"

namespace strake::cli {

/// Writes a value to each of some files. Errors: those of find_writer() and Session::write().
template <class Writer, class Value>
[[nodiscard]] Status write_files(Session& session, std::span<const std::string> files,
                                 std::span<const Writer> writers, const Value& value) {
  for (const std::string& file : files) {
    const Result<Writer> writer = find_writer(writers, file);
    if (!writer) return writer.error();
    const Status status = session.write(file, [&](Session::Sink sink) {
      writer->write(value, sink);
      return Status{};
    });
    if (!status) return status;
  }
  return {};
}

/// Writes a model, and says so. Errors: those of find_writer() and of the writer.
[[nodiscard]] Status write_model(Session& session, const model::Model& model,
                                 const std::string& file);

}  // namespace strake::cli
