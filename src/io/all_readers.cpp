// SPDX-License-Identifier: Apache-2.0
#include "strake/io/reader.hpp"

namespace strake::io {

std::vector<std::unique_ptr<Reader>> all_readers() {
  std::vector<std::unique_ptr<Reader>> readers;
  readers.push_back(make_rvm_reader());
  readers.push_back(make_gltf_reader());
  readers.push_back(make_obj_reader());
  readers.push_back(make_stl_reader());
  return readers;
}

}  // namespace strake::io
