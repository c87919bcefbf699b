// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstddef>
#include <cstdint>
#include <filesystem>
#include <span>
#include <vector>

#include "clash/detect.hpp"
#include "project/stored_report/report_codec.hpp"
#include "strake/core/result.hpp"
#include "strake/parallel/context.hpp"
#include "tiles/kept/blob_file.hpp"

/// What the tests find in a tile, as a file: a blob with what the file is, and for each test one
/// with what joins it, one with its head, and its parts.
namespace strake::tiles {

/// Puts together what was found in a tile of some objects.
class FoundWriter {
 public:
  /// `objects` are the numbers of the tile's, and must outlive this.
  explicit FoundWriter(std::span<const std::uint32_t> objects) : objects_(objects), blobs_(1) {}

  /// Adds the report of the next test. Errors: memory.
  [[nodiscard]] Status add(const clash::TileReport& tile);
  /// Errors: output, memory.
  [[nodiscard]] Status write(const std::filesystem::path& file) &&;

 private:
  std::span<const std::uint32_t> objects_;
  std::vector<Blob> blobs_;
  std::vector<std::uint64_t> counts_;  ///< pairs and regions of each test
};

/// The results of one test in a tile, of which pairs are decoded when they are requested.
struct FoundTest {
  std::uint64_t pairs = 0, regions = 0;
  clash::TileReport tile;  ///< without these
  std::vector<Blob> parts;
};

/// What was found in a tile, read at once.
class FoundFile {
 public:
  /// Reads what so many tests found of these objects. Path and objects must outlive it. Errors:
  /// input where it is missing, damaged or of another tile (kLost).
  [[nodiscard]] static Result<FoundFile> open(const std::filesystem::path& file,
                                              std::span<const std::uint32_t> objects,
                                              std::size_t tests, const parallel::Context& context);

  [[nodiscard]] const std::filesystem::path& path() const { return *file_; }
  [[nodiscard]] std::span<const std::uint32_t> objects() const { return objects_; }
  [[nodiscard]] FoundTest& test(std::size_t t) { return tests_[t]; }
  [[nodiscard]] const FoundTest& test(std::size_t t) const { return tests_[t]; }

  /// Returns the pairs of a part, numbered as the tile numbers them. Errors: input (kLost).
  [[nodiscard]] Result<project::DecodedPart> part(std::size_t test, std::size_t number) const;

 private:
  FoundFile(const std::filesystem::path& file, std::span<const std::uint32_t> objects)
      : file_(&file), objects_(objects) {}

  const std::filesystem::path* file_;
  std::span<const std::uint32_t> objects_;
  std::vector<FoundTest> tests_;
};

}  // namespace strake::tiles
