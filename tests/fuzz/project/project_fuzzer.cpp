// SPDX-License-Identifier: Apache-2.0
#include <cstddef>
#include <cstdint>

#include "feed_project.hpp"

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
  const strake::test::TemporaryFolder folder;
  static_cast<void>(
      strake::test::feed_project({reinterpret_cast<const char*>(data), size}, folder.path()));
  return 0;
}
