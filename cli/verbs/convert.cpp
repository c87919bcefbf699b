// SPDX-License-Identifier: Apache-2.0
#include <CLI/CLI.hpp>
#include <cstdint>
#include <filesystem>
#include <memory>
#include <nlohmann/json.hpp>
#include <string>
#include <system_error>
#include <utility>

#include "cli/output/diagnostics_json.hpp"
#include "cli/run/load.hpp"
#include "cli/verbs/verb.hpp"
#include "core/output_format.hpp"
#include "io/model_writers.hpp"

namespace strake::cli {

namespace {

using Json = nlohmann::ordered_json;

struct ConvertOptions {
  InputOptions input;
  std::string sag;
};

/// Takes the last of the files, which is the output.
Result<std::string> take_output(InputOptions& input) {
  if (input.files.size() < 2)
    return Error{ErrorCode::usage, "one file is given, and two are needed", "files",
                 "name what is read, then what is written, as in.rvm out.glb"};
  std::string output = std::move(input.files.back());
  input.files.pop_back();
  return output;
}

Result<io::WriteOptions> write_options(const ConvertOptions& options) {
  SceneInput curves;
  curves.sag = options.sag;
  io::WriteOptions how;
  const Result<model::SceneOptions> scene = scene_options(curves, how.sag_mm);
  if (!scene) return scene.error();
  how.sag_mm = scene->sag_mm;
  how.keep_all = true;
  return how;
}

/// Returns what became of the files, as schemas/convert.schema.json has it.
std::string conversion_json(const model::Model& model, const std::string& output) {
  constexpr int kConvertSchemaVersion = 1;
  Json files = Json::array(), counts = Json::array(), messages = Json::array();
  for (const model::SourceFile& file : model.files) {
    Json entry{{"file", file.label},
               {"format", file.format},
               {"unit", file.unit},
               {"up_axis", file.up_axis},
               {"bytes", file.bytes}};
    if (file.ends_early) entry["ends_early"] = true;
    files.push_back(std::move(entry));
  }
  add_diagnostics(counts, messages, model.diagnostics);
  std::error_code unknown;
  const std::uintmax_t bytes = std::filesystem::file_size(output, unknown);
  const Json all{{"schema_version", kConvertSchemaVersion}, {"output", output},
                 {"bytes", unknown ? Json() : Json(bytes)}, {"files", std::move(files)},
                 {"objects", model.objects.size()},         {"groups", model.groups.size()},
                 {"bodies", model.bodies.size()},           {"shapes", model.shapes.size()},
                 {"skipped", model.diagnostics.skipped()},  {"diagnostics", std::move(counts)},
                 {"messages", std::move(messages)}};
  return all.dump(2, ' ', false, Json::error_handler_t::replace) + "\n";
}

Result<ExitCode> run_convert(Session& session, const ConvertOptions& options) {
  InputOptions input = options.input;
  const Result<std::string> output = take_output(input);
  if (!output) return output.error();
  const Result<io::WriteOptions> how = write_options(options);
  if (!how) return how.error();
  if (const Status s = session.files().add_output("OUT", *output, formats_of(io::model_writers()));
      !s)
    return s.error();
  const Result<io::ModelWriter> writer = find_writer(io::model_writers(), *output);
  if (!writer) return writer.error();
  const Result<model::Model> model = load_model(session, input);
  if (!model) return model.error();
  if (const Status s = session.will_write(*output); !s) return s.error();
  const Status written = [&] {
    const auto timer = session.step("write " + *output);
    return writer->write(*model, *output, *how, session.context());
  }();
  if (!written) return written.error();
  session.console().note("wrote " + *output);
  if (session.json())
    if (const Status status = session.write_stdout(conversion_json(*model, *output)); !status)
      return status.error();
  return strict_exit_code(input, model->diagnostics);
}

}  // namespace

Verb add_convert(CLI::App& program, CommonOptions& common) {
  const auto options = std::make_shared<ConvertOptions>();
  CLI::App* const command = program.add_subcommand(
      "convert", "Model files as one file: IN... OUT, the last of the files being written");
  add_input_options(*command, options->input);
  command->get_option("files")->description(
      describe_formats("What is read, then what is written,", formats_of(io::model_writers())));
  command
      ->add_option("--sag", options->sag,
                   "Largest distance of what viewers are shown of a curve from the true one "
                   "(default 0.5mm)")
      ->type_name("LENGTH")
      ->group("Input");
  add_common_options(*command, common);
  command->footer(R"(
A GLB keeps all that Strake knows of a model (docs/formats/gltf.md): clashes and drawings of it are
those of what it was made of. An OBJ has triangles and ids.

Examples:
  strake convert platform.rvm platform.glb
  strake convert arch.ifc mep.ifc house.glb
  strake convert platform.rvm platform.obj --sag 0.1mm)");
  return {command, [options](Session& session) { return run_convert(session, *options); }};
}

}  // namespace strake::cli
