// SPDX-License-Identifier: Apache-2.0
// Where scenes lie, and what peers write.
#pragma once

#include <fmt/core.h>
#include <unistd.h>

#include <filesystem>
#include <string>
#include <string_view>
#include <utility>

#include "strake/io/writer.hpp"

namespace strake::bench {

/// A folder that is kept where it was named, and otherwise goes when this does.
class WorkFolder {
 public:
  WorkFolder(std::filesystem::path kept, std::string_view program)
      : path_(std::move(kept)), is_kept_(!path_.empty()) {
    if (!is_kept_)
      path_ = std::filesystem::temp_directory_path() / fmt::format("{}.{}", program, getpid());
    std::filesystem::create_directories(path_);
  }
  ~WorkFolder() {
    std::error_code ignored;
    if (!is_kept_) std::filesystem::remove_all(path_, ignored);
  }
  WorkFolder(const WorkFolder&) = delete;
  WorkFolder& operator=(const WorkFolder&) = delete;
  WorkFolder(WorkFolder&&) = delete;
  WorkFolder& operator=(WorkFolder&&) = delete;

  [[nodiscard]] const std::filesystem::path& path() const { return path_; }

  /// Writes a scene as OBJ, which peers read, and where the folder is kept as GLB too. Returns the
  /// OBJ file.
  [[nodiscard]] Result<std::filesystem::path> write_scene(const model::Model& model,
                                                          const std::string& name,
                                                          const parallel::Context& context) const {
    std::filesystem::path obj = path_ / (name + ".obj");
    if (const Status status = io::write_obj(model, obj, {}, context); !status)
      return status.error();
    if (is_kept_)
      if (const Status status = io::write_glb(model, path_ / (name + ".glb"), {}, context); !status)
        return status.error();
    return obj;
  }

 private:
  std::filesystem::path path_;
  bool is_kept_;
};

}  // namespace strake::bench
