// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <chrono>
#include <cstdint>
#include <filesystem>
#include <optional>
#include <span>
#include <string>
#include <vector>

#include "io/importer/scene_entry.hpp"
#include "strake/core/hash.hpp"
#include "strake/io/importer.hpp"

/// Scenes of importers that are kept for the next run. Any number of processes may use a folder at
/// once: an entry appears whole under its name, and one that goes while it is read is read to its
/// end.
namespace strake::io {

class SceneCache {
 public:
  SceneCache(std::filesystem::path folder, std::uint64_t max_bytes)
      : folder_(std::move(folder)), max_bytes_(max_bytes) {}

  /// Makes the folder; returns why it cannot be used, nothing where it can.
  [[nodiscard]] std::optional<std::string> open() const;
  /// Returns the facts of an entry whose importer is as it was.
  [[nodiscard]] std::optional<EntryFacts> find(const Hash128& key) const;
  [[nodiscard]] std::filesystem::path file_of(const Hash128& key) const;
  /// Says that an entry was used today.
  void touch(const Hash128& key) const;
  void remove(const Hash128& key) const;
  /// Moves a scene, which lies on the same disk, into the folder, and lets the least recently used
  /// go for it. Returns why it is not kept, nothing where it is.
  [[nodiscard]] std::optional<std::string> keep(const Hash128& key,
                                                const std::filesystem::path& scene,
                                                std::span<const std::byte> bytes,
                                                const EntryFacts& facts) const;

 private:
  void make_room(std::uint64_t bytes) const;

  std::filesystem::path folder_;
  std::uint64_t max_bytes_;
};

/// An entry as lists show it.
struct KeptScene {
  std::filesystem::path path;
  EntryFacts facts;
  std::uint64_t bytes = 0;
  std::chrono::seconds unused{0};  ///< how long ago it was used last
};

/// Returns the scenes of a folder, the latest used first; of equal age in the order of names.
[[nodiscard]] std::vector<KeptScene> list_scenes(const std::filesystem::path& folder);

struct Cleared {
  std::uint64_t scenes = 0, bytes = 0;
};

/// Removes what was not used for so long, and what killed runs left behind. Errors: output, where a
/// file cannot be removed.
[[nodiscard]] Result<Cleared> clear_scenes(const std::filesystem::path& folder,
                                           std::chrono::seconds unused);

}  // namespace strake::io
