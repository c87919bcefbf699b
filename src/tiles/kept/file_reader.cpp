// SPDX-License-Identifier: Apache-2.0
#include "tiles/kept/file_reader.hpp"

#include <fmt/format.h>

#include <cstdint>
#include <numeric>

#include "io/read_file.hpp"

namespace strake::tiles {

std::filesystem::path FileReader::kept_file(std::size_t file) const {
  return folder_ / fmt::format("file{:06}.strake-kept", file);
}

Result<const model::Model*> FileReader::read(std::size_t file, const parallel::Context& context) {
  if (last_ && number_ == file) return &*last_;
  last_.reset();
  // An environment that says no settings tells of it where an importer is needed.
  Result<io::ReadFile> read = io::read_file(files_[file], settings_, context);
  if (!read) return read.error();
  number_ = file;
  last_.emplace(std::move(read->model));
  map_ = std::move(read->map);
  return &*last_;
}

Status FileReader::keep(std::size_t file, const parallel::Context& context) {
  if (folder_.empty() || files_.size() == 1 || !last_ || number_ != file) return {};
  std::vector<std::uint32_t> objects(last_->objects.size());
  std::iota(objects.begin(), objects.end(), std::uint32_t{0});
  const Result<Section> section = write_section(kept_file(file), *last_, objects, context);
  // Where there is no room for it the file is read a second time.
  if (!section) return section.error().code == ErrorCode::output ? Status{} : section.error();
  kept_[file] = *section;
  last_.reset();
  return {};
}

Result<const model::Model*> FileReader::read_again(std::size_t file,
                                                   const parallel::Context& context) {
  if ((last_ && number_ == file) || !kept_[file]) return read(file, context);
  last_.reset();
  model::Model model;
  model.files.emplace_back();
  const Status s = append_section(kept_file(file), *kept_[file], model, context);
  if (!s && s.error().code != ErrorCode::input) return s.error();
  if (!s) {
    kept_[file].reset();
    return read(file, context);
  }
  number_ = file;
  last_.emplace(std::move(model));
  return &*last_;
}

}  // namespace strake::tiles
