// SPDX-License-Identifier: Apache-2.0
#include <fmt/core.h>

#include <CLI/CLI.hpp>
#include <algorithm>
#include <array>
#include <memory>
#include <ostream>
#include <streambuf>
#include <string>

#include "cli/run/write_files.hpp"
#include "cli/verbs/verb.hpp"
#include "core/output_format.hpp"
#include "io/model_writers.hpp"
#include "strake/generate/ship.hpp"

namespace strake::cli {

namespace {

struct GenerateOptions {
  std::string objects, seed, kind, imported_detail, imported_triangles, output, truth;
  bool turned = false;
};

/// A stream buffer that hands its text on to a sink.
class SinkBuffer : public std::streambuf {
 public:
  explicit SinkBuffer(Session::Sink sink) : sink_(sink) {}

 protected:
  int_type overflow(int_type c) override {
    if (traits_type::eq_int_type(c, traits_type::eof())) return traits_type::not_eof(c);
    const char one = traits_type::to_char_type(c);
    sink_(std::string_view(&one, 1));
    return c;
  }
  std::streamsize xsputn(const char* text, std::streamsize size) override {
    sink_(std::string_view(text, static_cast<std::size_t>(size)));
    return size;
  }

 private:
  Session::Sink sink_;
};

constexpr std::array<OutputFormat, 1> kTruthFormats{{{".json"}}};

Result<ExitCode> run_generate(Session& session, const GenerateOptions& given) {
  generate::ShipOptions options;
  options.turned = given.turned;
  const auto kind = std::ranges::find(generate::kShipKinds, given.kind);
  if (kind != generate::kShipKinds.end())
    options.kind = static_cast<generate::ShipKind>(kind - generate::kShipKinds.begin());
  if (const Status s = whole_number(options.objects, given.objects, "--objects"); !s)
    return s.error();
  if (const Status s = whole_number(options.seed, given.seed, "--seed"); !s) return s.error();
  if (const Status s =
          whole_number(options.imported_detail, given.imported_detail, "--imported-detail");
      !s)
    return s.error();
  if (const Status s = whole_number(options.imported_triangles, given.imported_triangles,
                                    "--imported-triangles");
      !s)
    return s.error();
  if (const Status s = session.files().add_outputs({given.output}, formats_of(io::model_writers()));
      !s)
    return s.error();
  if (!given.truth.empty())
    if (const Status s = session.files().add_output("--truth", given.truth, kTruthFormats); !s)
      return s.error();
  const Result<generate::Ship> ship = [&] {
    const auto timer = session.step("generate");
    return generate::generate_ship(options, session.context());
  }();
  if (!ship) return ship.error();
  session.console().note(
      fmt::format("a ship section of {} objects, seed {}; {} pairs touch or clash",
                  ship->model.objects.size(), ship->options.seed, ship->truth.pairs.size()));
  if (const Status s = write_model(session, ship->model, given.output); !s) return s.error();
  const auto truth = [&](Session::Sink sink) {
    SinkBuffer buffer(sink);
    std::ostream out(&buffer);
    out.exceptions(std::ios::badbit);  // what the sink throws comes through
    generate::write_truth(*ship, out);
    return Status{};
  };
  if (!given.truth.empty())
    if (const Status s = session.write(given.truth, truth); !s) return s.error();
  if (session.json())
    if (const Status s = session.write_stdout(truth); !s) return s.error();
  return ExitCode::done;
}

}  // namespace

Verb add_generate(CLI::App& program, CommonOptions& common) {
  const auto options = std::make_shared<GenerateOptions>();
  CLI::App* const group = program.add_subcommand("generate", "Models made from parameters");
  group->require_subcommand(1);
  CLI::App* const command = group->add_subcommand(
      "ship", "A ship section of any size with planted clashes, and the truth about every pair");
  const generate::ShipOptions defaults;
  command
      ->add_option("--objects", options->objects,
                   fmt::format("How many objects it has (default {})", defaults.objects))
      ->type_name("N");
  command
      ->add_option("--seed", options->seed,
                   fmt::format("Equal seeds give equal ships (default {})", defaults.seed))
      ->type_name("N");
  command->add_flag("--turned", options->turned,
                    "Turn the whole ship so that no face lies along an axis");
  add_choice(*command, "--kind", options->kind,
             {generate::kShipKinds.begin(), generate::kShipKinds.end()},
             "What it is like: slender (half as many lanes and levels, three at most), dense "
             "(engine rooms only), "
             "repeated (cabins only: few shapes at many places), unlike (every eighth body a mesh "
             "like no other) (default usual)");
  CLI::Option* const imported =
      command
          ->add_option("--imported-detail", options->imported_detail,
                       "So many of the objects are meshes with far too much detail, no two alike, "
                       "as imported from elsewhere, while the weather deck has room (default 0)")
          ->type_name("N");
  command
      ->add_option("--imported-triangles", options->imported_triangles,
                   fmt::format("About how many triangles each of those has (default {})",
                               defaults.imported_triangles))
      ->needs(imported)
      ->type_name("N");
  command
      ->add_option("-o,--output", options->output,
                   describe_formats("The model,", formats_of(io::model_writers())))
      ->type_name("FILE")
      ->required();
  command
      ->add_option("--truth", options->truth,
                   "Every pair that is not NO_HIT at 25mm clearance, known from the construction "
                   "(.json)")
      ->type_name("FILE");
  add_common_options(*command, common);
  group->footer("\n'strake generate ship --help' tells its options.");
  command->footer(R"(
Example:
  strake generate ship --objects 20000 --seed 1 -o ship.glb --truth ship.truth.json)");
  return {command, [options](Session& session) { return run_generate(session, *options); }};
}

}  // namespace strake::cli
