// SPDX-License-Identifier: Apache-2.0
#include "cli/output/run_files.hpp"

#include <sys/stat.h>

#include <algorithm>
#include <cstddef>
#include <fstream>
#include <string_view>
#include <system_error>

#include "core/text_encoding.hpp"
#include "io/source/input_file.hpp"
#include "strake/core/atomic_file.hpp"
#include "strake/io/reader.hpp"

namespace strake::cli {

namespace {

namespace fs = std::filesystem;

Error usage_of(std::string message, std::string option, std::string mend) {
  return {ErrorCode::usage, std::move(message), std::move(option), std::move(mend)};
}

Status check_place(const std::string& file) {
  std::error_code error;
  const fs::path folder = fs::path(file).parent_path();
  if (!folder.empty() && !fs::is_directory(folder, error))
    return Error{ErrorCode::output, "cannot be written: there is no such folder", file,
                 "make the folder first"};
  if (fs::is_directory(file, error))
    return Error{ErrorCode::output, "cannot be written: it is a folder", file,
                 "give the name of a file"};
  return {};
}

/// The first bytes of a file; none where it cannot be read, or is a pipe, which gives them once.
std::string head_of(const fs::path& file) {
  constexpr std::size_t kHead = 65536;
  std::error_code error;
  if (!fs::is_regular_file(file, error)) return {};
  std::ifstream in(file, std::ios::binary);
  std::string head(kHead, '\0');
  in.read(head.data(), kHead);
  head.resize(static_cast<std::size_t>(in.gcount()));
  return head;
}

/// Whether a file may be one that models name: results of earlier runs, which are replaced day by
/// day, are text, and speak of no material.
bool may_be_named_by_models(const fs::path& file) {
  const std::string text = head_of(file);
  const auto is_no_text = [](char c) {
    return static_cast<unsigned char>(c) < ' ' && c != '\n' && c != '\r' && c != '\t';
  };
  return std::ranges::any_of(text, is_no_text) || lowered(text).find("newmtl") != std::string::npos;
}

}  // namespace

RunFiles::Place RunFiles::Place::of(const fs::path& file) {
  Place place;
  std::error_code error;
  // A link to nowhere leads to the file that writing through it makes.
  const fs::path whole = fs::absolute(resolve_links(file), error);
  place.path = error ? file : fs::weakly_canonical(whole, error);
  if (error) place.path = file;
  struct stat facts{};
  if (::stat(file.c_str(), &facts) == 0)
    place.node.emplace(std::uint64_t{facts.st_dev}, std::uint64_t{facts.st_ino});
  return place;
}

bool RunFiles::Place::is(const Place& other) const {
  return path == other.path || (node && node == other.node);
}

Error RunFiles::overwritten(const std::string& file, const Input& input,
                            const std::string& option) {
  const std::string what = input.read_with.empty() ? " is one of the inputs"
                                                   : " is read with " + in_quotes(input.read_with);
  return usage_of(in_quotes(file) + what + " and would be overwritten", option,
                  "give another name");
}

Status RunFiles::add(const fs::path& file, const std::string& read_with) {
  Input input{Place::of(file), read_with};
  for (const Output& output : outputs_)
    if (output.place.is(input.place)) return overwritten(output.file, input, output.option);
  inputs_.push_back(std::move(input));
  return {};
}

Status RunFiles::add_input(const fs::path& file) { return add(file, {}); }

Status RunFiles::add_inputs(const std::vector<std::string>& files) {
  for (const std::string& file : files)
    if (Status status = add(file, {}); !status) return status;
  return {};
}

Status RunFiles::add_project(const fs::path& file) {
  if (Status status = add(file, {}); !status) return status;
  const fs::path base = resolve_links(file);
  for (const char* const ending : {"-wal", "-shm"})
    if (Status status = add(base.string() + ending, file.string()); !status) return status;
  return {};
}

Status RunFiles::add_companions(const io::FileBytes& file, const parallel::Context& context) {
  for (const fs::path& beside : io::files_read_with(file, context))
    if (Status status = add(beside, file.path.string()); !status) return status;
  return {};
}

Status RunFiles::add_all_companions(const fs::path& file, const parallel::Context& context) {
  const Result<io::FileContent> content = io::FileContent::read(file, context);
  return content ? add_companions({file, content->bytes()}, context) : Status{};
}

Status RunFiles::add_model(const fs::path& file, const parallel::Context& context) {
  if (Status status = add(file, {}); !status) return status;
  if (outputs_.empty()) return {};
  const std::string head = head_of(file);
  if (Status status = add_companions({file, std::as_bytes(std::span(head))}, context); !status)
    return status;
  const bool may_overwrite = std::ranges::any_of(outputs_, [](const Output& output) {
    return output.place.node && may_be_named_by_models(output.place.path);
  });
  return may_overwrite ? add_all_companions(file, context) : Status{};
}

Status RunFiles::add_output(const std::string& option, const std::string& file,
                            std::span<const OutputFormat> formats) {
  if (const auto number = format_number(formats, file); !number) {
    Error error = number.error();
    error.where = option;
    return error;
  }
  Output output{option, file, Place::of(file)};
  for (const Input& input : inputs_)
    if (input.place.is(output.place)) return overwritten(file, input, option);
  for (const Output& other : outputs_)
    if (other.place.is(output.place))
      return usage_of(in_quotes(file) + (other.option == option
                                             ? " is given twice"
                                             : " is the output of " + other.option + " already"),
                      option, "give each output its own name");
  if (Status status = check_place(file); !status) return status;
  outputs_.push_back(std::move(output));
  return {};
}

Status RunFiles::add_outputs(const std::vector<std::string>& files,
                             std::span<const OutputFormat> formats) {
  for (const std::string& file : files)
    if (Status status = add_output("-o", file, formats); !status) return status;
  return {};
}

Status RunFiles::check(const fs::path& target) const {
  const Place place = Place::of(target);
  for (const Input& input : inputs_)
    if (input.place.is(place)) return overwritten(target.string(), input, {});
  return {};
}

}  // namespace strake::cli
