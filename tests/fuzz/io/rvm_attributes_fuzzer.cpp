// SPDX-License-Identifier: Apache-2.0
#include <cstddef>
#include <cstdint>
#include <cstdlib>
#include <string_view>

#include "core/text_encoding.hpp"
#include "io/rvm/attributes.hpp"
#include "io/source/text_decoder.hpp"

/// Any bytes as an attribute file: nodes whose parents come before them, or an error.
extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
  using namespace strake::io;
  const std::string_view text(reinterpret_cast<const char*>(data), size);
  const TextDecoder decode;
  if (!strake::is_utf8(decode(text))) std::abort();
  const auto file = rvm::parse_attributes(text);
  if (!file) return 0;
  rvm::RvmModel built;
  for (std::size_t n = 0; n < file->nodes.size(); ++n) {
    const rvm::AttributeNode& node = file->nodes[n];
    if (node.parent != rvm::kNoGroup && node.parent >= n) std::abort();
    built.model.groups.push_back({decode(node.name), {}});
    built.groups.push_back({node.parent, 0, 0, n});
    strake::model::Object object;
    object.name = decode(node.name);
    built.model.objects.push_back(object);
    built.group_of.push_back(static_cast<std::uint32_t>(n));
  }
  strake::Diagnostics diagnostics;
  rvm::attach_attributes(built, *file, decode, "fuzz", diagnostics);
  return 0;
}
