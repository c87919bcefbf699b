// SPDX-License-Identifier: Apache-2.0
#include "cli/run/write_files.hpp"

#include "io/model_writers.hpp"

namespace strake::cli {

Status write_model(Session& session, const model::Model& model, const std::string& file) {
  const Result<io::ModelWriter> writer = find_writer(io::model_writers(), file);
  if (!writer) return writer.error();
  if (const Status status = session.will_write(file); !status) return status;
  const auto timer = session.step("write " + file);
  const Status status = writer->write(model, file, {}, session.context());
  if (status) session.console().note("wrote " + file);
  return status;
}

}  // namespace strake::cli
