// SPDX-License-Identifier: Apache-2.0
#include "io/importer/work_folder.hpp"

#include <cstdlib>
#include <string>
#include <system_error>
#include <utility>

namespace strake::io {

std::unique_ptr<WorkFolder> WorkFolder::make(const std::filesystem::path& within) {
  std::string name = (within / (std::string(kWorkPrefix) + "XXXXXX")).string();
  if (::mkdtemp(name.data()) == nullptr) return nullptr;
  return std::unique_ptr<WorkFolder>(new WorkFolder(std::move(name)));
}

WorkFolder::~WorkFolder() {
  std::error_code ignored;
  std::filesystem::remove_all(path_, ignored);
}

}  // namespace strake::io
