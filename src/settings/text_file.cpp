// SPDX-License-Identifier: Apache-2.0
#include "settings/text_file.hpp"

#include <cstdint>
#include <fstream>
#include <iterator>
#include <system_error>

namespace strake::settings {
namespace {

constexpr std::uintmax_t kLargestFile = std::uintmax_t{16} << 20U;

}  // namespace

Result<std::string> read_text_file(const std::filesystem::path& file, std::string_view what,
                                   std::string_view hint) {
  std::error_code error;
  if (!std::filesystem::exists(file, error))
    return Error{ErrorCode::input, "cannot be read: there is no such file", file.string(),
                 "check the path"};
  const auto size = std::filesystem::file_size(file, error);
  if (error || !std::filesystem::is_regular_file(file))
    return Error{ErrorCode::input, "cannot be read: it is no file", file.string(),
                 "give the name of a " + std::string(what)};
  if (size > kLargestFile)
    return Error{ErrorCode::input, "is larger than any " + std::string(what), file.string(),
                 "give a " + std::string(what) + std::string(hint)};
  std::ifstream stream(file, std::ios::binary);
  std::string text{std::istreambuf_iterator<char>(stream), std::istreambuf_iterator<char>()};
  if (!stream)
    return Error{ErrorCode::input, "cannot be read", file.string(), "check who may read it"};
  return text;
}

}  // namespace strake::settings
