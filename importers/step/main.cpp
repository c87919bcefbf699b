// SPDX-License-Identifier: Apache-2.0

// strake-import-step: makes of a STEP or IGES file the scene that strake reads
// (docs/formats/importers.md). All of Open CASCADE is in this program.

#include <fmt/format.h>
#include <unistd.h>

#include <Message.hxx>
#include <Message_Messenger.hxx>
#include <Message_Printer.hxx>
#include <OSD.hxx>
#include <OSD_Parallel.hxx>
#include <OSD_ThreadPool.hxx>
#include <Standard_ErrorHandler.hxx>
#include <Standard_Failure.hxx>
#include <clocale>
#include <exception>
#include <filesystem>
#include <new>
#include <span>
#include <string>
#include <string_view>
#include <system_error>

#include "arguments.hpp"
#include "document.hpp"
#include "message_log.hpp"
#include "report.hpp"
#include "scene_model.hpp"
#include "source_file.hpp"
#include "strake/io/writer.hpp"

namespace strake::import_step {
namespace {

namespace fs = std::filesystem;

/// The files of the scene's making besides the program itself: those that the model refers to.
std::vector<std::string> files_beside(const fs::path& input, const Document& document) {
  std::vector<std::string> files;
  for (const std::string& file : document.outer_files)
    files.push_back(fs::absolute(input.parent_path() / file).lexically_normal().string());
  return files;
}

/// Says of each reference to nothing where it is; of many, how many more there are.
void report_missing_references(const StepReferences& references, Report& report) {
  for (const std::string& one : references.listed)
    report.add(Severity::skipped, "step-missing-entity", one.substr(0, one.find(' ')), one);
  if (references.missing > references.listed.size())
    report.add(Severity::skipped, "step-missing-entity", "",
               std::to_string(references.missing - references.listed.size()) +
                   " more references name entities that are not there");
}

Status convert(const Arguments& arguments, Report& report) {
  const Result<SourceFile> source = inspect_source(arguments.input);
  if (!source) return source.error();
  report_missing_references(source->references, report);
  const Handle(ReportProgress) progress = new ReportProgress(report);
  progress->next(0, 0);
  const Result<Document> document = read_document(arguments.input, source->kind, progress);
  if (!document) return document.error();
  SceneOptions options;
  options.mesh.sag_mm = arguments.sag_mm;
  options.mesh.threads = arguments.threads;
  options.kind = source->kind;
  options.file_name = arguments.input.stem().string();
  const Result<model::Model> model = make_scene_model(*document, options, report, progress);
  if (!model) return model.error();
  io::WriteOptions write;
  write.millimetres_z_up = true;
  const Status written = io::write_glb(*model, arguments.output, write, {});
  if (!written) return written;
  report.end(source->format, document->unit, files_beside(arguments.input, *document));
  return {};
}

/// What Open CASCADE prints goes where errors go: standard output is not its.
void keep_standard_output_clean() {
  ::dup2(STDERR_FILENO, STDOUT_FILENO);
  Message::DefaultMessenger()->ChangePrinters().Clear();
}

int converted(const Arguments& arguments, Report& report) {
  const Status done = convert(arguments, report);
  if (done) return 0;
  report.fail(done.error());
  return 1;
}

int run(std::span<char*> words) {
  const Result<Arguments> arguments = parse_arguments(words);
  if (!arguments) {
    fmt::print(stderr, "strake-import-step: {}\n", arguments.error().text());
    return 2;
  }
  Report report(arguments->report);
  if (!report.is_open()) {
    fmt::print(stderr, "strake-import-step: {} cannot be written\n", arguments->report.string());
    return 2;
  }
  OSD::SetSignal(Standard_False);
  OSD_Parallel::SetUseOcctThreads(Standard_True);
  OSD_ThreadPool::DefaultPool(static_cast<int>(arguments->threads) - 1);
  try {
    OCC_CATCH_SIGNALS
    return converted(*arguments, report);
  } catch (const std::bad_alloc&) {
    report.fail(out_of_memory());
  } catch (const Standard_Failure& failure) {
    report.fail({ErrorCode::input, failure_text(failure), "",
                 "the file may be damaged: export it again, or in another version"});
  }
  return 1;
}

}  // namespace
}  // namespace strake::import_step

int main(int count, char** words) {
  strake::import_step::keep_standard_output_clean();
  return strake::import_step::run({words, static_cast<std::size_t>(count)});
}
