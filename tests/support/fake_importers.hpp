// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <gtest/gtest.h>

#include <algorithm>
#include <cstddef>
#include <filesystem>
#include <fstream>
#include <iterator>
#include <string>
#include <system_error>
#include <vector>

#include "io/importer/scene_cache.hpp"
#include "strake/io/importer.hpp"
#include "support/gltf_files.hpp"
#include "support/io_files.hpp"

namespace strake::test {

namespace fs = std::filesystem;

/// What ends the report of an importer that a script plays.
inline constexpr const char* kEnd =
    R"(echo '{"made_by": "toy 1", "format": "TOY2", "unit": "mm"}' >> "$report")";

/// Two folders: one with importers, one with what they made.
class FakeImporters : public testing::Test {
 protected:
  FakeImporters() {
    fs::create_directory(bin_);
    settings_.folders = {bin_};
    settings_.cache = folder_.path() / "cache";
    settings_.silence_s = 20;
    scene_ = folder_.write("scene", triangle_glb(R"("nodes":[{"mesh":0,"extras":{"id":"T1"}}])"));
  }

  /// Makes the importer of a suffix: a script, which knows $input, $output, $report and $threads.
  void play(const std::string& script, const std::string& suffix = "toy") {
    const fs::path program = bin_ / ("strake-import-" + suffix);
    std::ofstream(program) << "#!/bin/sh\ninput=$2 output=$4 report=$6 threads=$8\necho x >> "
                           << calls_.string() << "\n"
                           << script << "\n";
    fs::permissions(program, fs::perms::owner_all);
  }
  [[nodiscard]] std::string make_scene() const {
    return "cp " + scene_.string() + " \"$output\"\n";
  }
  void play_well(const std::string& more = {}) { play(more + "\n" + make_scene() + kEnd); }

  [[nodiscard]] Result<model::Model> read(const std::vector<fs::path>& files,
                                          const parallel::Context& context = {},
                                          const io::ReadOptions& options = {}) const {
    std::vector<io::FileToRead> to_read;
    for (const fs::path& file : files) to_read.push_back({file, options});
    return io::read_models(to_read, settings_, context);
  }
  [[nodiscard]] std::string error() const {
    const Result<model::Model> model = read({toy_});
    return model ? "no error" : model.error().text();
  }
  /// How often importers were run.
  [[nodiscard]] std::size_t calls() const {
    std::ifstream in(calls_);
    return static_cast<std::size_t>(std::count(std::istreambuf_iterator<char>(in), {}, '\n'));
  }
  [[nodiscard]] std::size_t kept() const { return io::list_scenes(*settings_.cache).size(); }
  /// Whether nothing of an importer's own folder is left.
  [[nodiscard]] bool is_tidy() const {
    std::error_code none;
    for (const auto& entry : fs::directory_iterator(*settings_.cache, none))
      if (entry.is_directory()) return false;
    return true;
  }

  TemporaryFolder folder_;
  fs::path bin_ = folder_.path() / "bin", calls_ = folder_.path() / "calls", scene_;
  fs::path toy_ = folder_.write("arch.toy", "a toy\n");
  io::ImportSettings settings_;
};

}  // namespace strake::test
