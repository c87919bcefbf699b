// SPDX-License-Identifier: Apache-2.0
#include "strake/io/reader.hpp"

#include <fmt/format.h>

#include <fstream>
#include <iterator>
#include <string>
#include <utility>

#include "core/text/dates.hpp"
#include "io/rvm/attributes.hpp"
#include "io/rvm/binary.hpp"
#include "io/rvm/builder.hpp"
#include "io/rvm/diagnostic_log.hpp"
#include "io/rvm/text_variant.hpp"
#include "io/source/reader_support.hpp"
#include "io/source/text_decoder.hpp"
#include "model/object_assemblies.hpp"

namespace strake::io {

namespace {

using namespace rvm;  // NOLINT(google-build-using-namespace): this file is that namespace's door

std::string_view as_text(Bytes bytes) {
  return {reinterpret_cast<const char*>(bytes.data()), bytes.size()};
}

std::string file_name(const FileBytes& file) {
  return file.path.empty() ? "RVM data" : file.path.filename().string();
}

/// Returns names from the root down, each begun by a '/'; nothing when that is too long to be an id
/// or the element itself has no name.
std::optional<std::string> path_id(const RvmModel& built, std::uint32_t group) {
  constexpr std::size_t kLongest = 4096;
  if (built.model.groups[group].name.empty()) return std::nullopt;
  std::vector<const std::string*> names;
  std::size_t length = 0;
  for (std::uint32_t g = group; g != kNoGroup; g = built.groups[g].parent) {
    names.push_back(&built.model.groups[g].name);
    length += names.back()->size() + 1;
    if (length > kLongest) return std::nullopt;
  }
  std::string id;
  id.reserve(length);
  for (auto name = names.rbegin(); name != names.rend(); ++name) {
    if (!(*name)->starts_with('/')) id.push_back('/');
    id += **name;
  }
  return id;
}

/// Whether a group or one above it is called by a number only.
bool is_counted(const RvmModel& built, std::uint32_t group) {
  for (std::uint32_t g = group; g != kNoGroup; g = built.groups[g].parent)
    if (model::is_counted_name(built.model.groups[g].name)) return true;
  return false;
}

/// Gives each object its id: the reference number where attributes give one, else the full name
/// path, else the place in the file.
void assign_ids(RvmModel& built) {
  for (std::size_t o = 0; o < built.model.objects.size(); ++o) {
    model::Object& object = built.model.objects[o];
    const std::uint32_t group = built.group_of[o];
    if (group == kNoGroup) {
      object.id = "@root";
      continue;
    }
    object.id = reference_of(object.attributes);
    if (!object.id.empty()) continue;
    const std::optional<std::string> path = path_id(built, group);
    object.positional_id = !path || is_counted(built, group);
    object.id = path.value_or(fmt::format("@{}", built.groups[group].offset));
  }
}

std::optional<std::string> read_whole(const std::filesystem::path& path) {
  std::ifstream in(path, std::ios::binary);
  if (!in) return std::nullopt;
  std::string text{std::istreambuf_iterator<char>(in), std::istreambuf_iterator<char>()};
  if (in.bad()) return std::nullopt;
  return text;
}

/// Adds attributes, which are a help, never a condition: whatever is wrong with their file is a
/// diagnostic.
void add_attributes(RvmModel& built, const FileBytes& file,
                    const std::optional<TextDecoder>& stated) {
  const auto path = find_attribute_file(file.path);
  if (!path) return;
  const std::string where = path->filename().string();
  Diagnostics& diagnostics = built.model.diagnostics;
  const auto text = read_whole(*path);
  if (!text) {
    diagnostics.add(Severity::warning, "rvm-attributes-unread", "the file cannot be read", where);
    return;
  }
  const auto parsed = parse_attributes(*text);
  if (!parsed) {
    diagnostics.add(Severity::warning, "rvm-attributes-unread", parsed.error().message, where);
    return;
  }
  attach_attributes(built, *parsed, stated.value_or(TextDecoder()), where, diagnostics);
}

/// Has all elements inherit when the file says that it was written.
void state_date(model::Model& model, const std::string& date) {
  const std::optional<std::string> utc = utc_of_c_time(date);
  if (!utc) return;
  for (model::Group& group : model.groups) {
    if (group.parent != model::GroupId::none) continue;
    if (group.attributes == model::Group::kNoAttributes) {
      group.attributes = static_cast<std::uint32_t>(model.group_attributes.size());
      model.group_attributes.emplace_back();
    }
    model.group_attributes[group.attributes].emplace_back("FileDate", *utc);
  }
}

class RvmReader final : public Reader {
 public:
  [[nodiscard]] std::string_view format() const override { return "RVM"; }

  [[nodiscard]] std::vector<std::filesystem::path> companions(
      const FileBytes& file, const parallel::Context& /*context*/) const override {
    const auto attributes = find_attribute_file(file.path);
    if (!attributes) return {};
    return {*attributes};
  }

  [[nodiscard]] int recognise(const FileBytes& file) const override {
    const std::string extension = lower_extension(file.path);
    const bool named = extension == ".rvm" || extension == ".rev";
    if (const auto head = find_head(file.bytes)) return *head == 0 ? 100 : 80;
    if (is_text_variant(as_text(file.bytes))) return 90;
    if (is_byte_swapped(file.bytes)) return 90;
    return named || extension == ".rvs" ? 20 : 0;
  }

  [[nodiscard]] Result<model::Model> read(const FileBytes& file, const ReadOptions& options,
                                          const parallel::Context& context) const override;
};

std::optional<Error> refusal(const FileBytes& file) {
  const std::string name = file_name(file);
  if (lower_extension(file.path) == ".rvs")
    return Error{ErrorCode::input, "a Review state file (.rvs) holds no geometry", name,
                 "give the RVM file that it was saved for"};
  if (file.bytes.empty())
    return Error{ErrorCode::input, "the file is empty", name, "export the model again"};
  if (is_byte_swapped(file.bytes))
    return Error{ErrorCode::input,
                 "the numbers stand low byte first at byte 0; RVM is high byte first", name,
                 "export the model again with a program that writes RVM as AVEVA does"};
  if (!find_head(file.bytes) && !is_text_variant(as_text(file.bytes)))
    return Error{ErrorCode::input, "no HEAD chunk within the first 64 KiB: this is no RVM file",
                 name, "give a binary RVM file or its text variant (.rev)"};
  return std::nullopt;
}

/// World coordinates are metres with z up, by the format.
constexpr FrameDefault kFrame{1000, UpAxis::z, true};

Result<model::Model> RvmReader::read(const FileBytes& file, const ReadOptions& options,
                                     const parallel::Context& context) const {
  if (auto error = refusal(file)) return *std::move(error);
  std::optional<TextDecoder> decoder;
  if (options.encoding) {
    auto made = TextDecoder::for_encoding(*options.encoding);
    if (!made) return made.error();
    decoder = *made;
  }
  const std::string name = file_name(file);
  Diagnostics diagnostics;
  DiagnosticLog log(diagnostics, name);
  const bool text = !find_head(file.bytes);
  Transcoded transcoded;
  if (text) {
    transcoded = transcode_text(as_text(file.bytes), log);
    log.use_lines(transcoded.marks);
  }
  RvmBuilder builder(log, choose_frame(options, kFrame));
  FileHead head;
  const FileRead done = read_binary(text ? Bytes(transcoded.bytes) : file.bytes, decoder, builder,
                                    log, head, context);
  if (done.cancelled) return cancelled(file);
  auto built = builder.build(context);
  if (!built) return built.error();
  built->model.diagnostics = std::move(diagnostics);
  if (built->model.bodies.empty()) return end_model(file, std::move(built->model), context);
  model::Model started =
      start_model(file, text ? "RVM text" : fmt::format("RVM {}", head.version), options, kFrame);
  built->model.files = std::move(started.files);
  built->model.files.front().ends_early = done.ends_early;
  add_attributes(*built, file, decoder);
  state_date(built->model, head.date);
  assign_ids(*built);
  return end_model(file, std::move(built->model), context);
}

}  // namespace

std::unique_ptr<Reader> make_rvm_reader() { return std::make_unique<RvmReader>(); }

}  // namespace strake::io
