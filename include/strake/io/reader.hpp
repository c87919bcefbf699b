// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <filesystem>
#include <memory>
#include <optional>
#include <span>
#include <string>
#include <string_view>
#include <vector>

#include "strake/core/result.hpp"
#include "strake/model/model.hpp"
#include "strake/parallel/context.hpp"

/// Reads model files of all supported formats.
namespace strake::io {

enum class UpAxis { x, y, z };

/// What the user says about a file; it overrides what the format states.
struct ReadOptions {
  std::optional<double> unit_mm;  ///< length of the file's unit in mm (1000 for metres)
  std::optional<UpAxis> up_axis;
  std::optional<std::string> encoding;  ///< the encoding of names, where the format leaves it open
  /// Whether coordinates are those of the map where an importer says how it lies on one: east,
  /// north and up.
  bool on_map = false;
};

/// A whole file in memory (or mapped), with its path for messages and for files beside it.
struct FileBytes {
  std::filesystem::path path;
  std::span<const std::byte> bytes;
};

/// A reader of one format. Readers never throw on bad input, never print, and never allocate more
/// than a small multiple of the file's size on the word of a count that the file states.
class Reader {
 public:
  virtual ~Reader() = default;
  /// Returns "RVM", "glTF", "OBJ", "STL" or "PLY"; "imported" of the one that runs importers.
  [[nodiscard]] virtual std::string_view format() const = 0;
  /// Returns how sure this reader is, from the content first and the extension as a tie-breaker: 0
  /// (not mine) to 100 (certain).
  [[nodiscard]] virtual int recognise(const FileBytes& file) const = 0;
  /// Reads the objects of the file as one model with one SourceFile; finish() is not called.
  [[nodiscard]] virtual Result<model::Model> read(const FileBytes& file, const ReadOptions& options,
                                                  const parallel::Context& context) const = 0;
  /// Returns the files beside it that read() would read with it, whether or not they are there.
  [[nodiscard]] virtual std::vector<std::filesystem::path> companions(
      const FileBytes& file, const parallel::Context& context) const;
};

[[nodiscard]] std::unique_ptr<Reader> make_rvm_reader();
[[nodiscard]] std::unique_ptr<Reader> make_gltf_reader();
[[nodiscard]] std::unique_ptr<Reader> make_obj_reader();
[[nodiscard]] std::unique_ptr<Reader> make_stl_reader();
[[nodiscard]] std::unique_ptr<Reader> make_ply_reader();

/// Returns all readers of this build, in a fixed order; the last runs importers as the environment
/// says (strake/io/importer.hpp).
[[nodiscard]] std::vector<std::unique_ptr<Reader>> all_readers();

/// Returns the files that are read with a model file, as the attributes of an RVM file; none where
/// no reader recognises it.
[[nodiscard]] std::vector<std::filesystem::path> files_read_with(const FileBytes& file,
                                                                 const parallel::Context& context);

/// Reads files into one finished model, each by the reader that recognises it best. Importers are
/// run at the same time where there are workers for it. A file that no reader recognises, or that
/// holds nothing usable, is an error that names it.
[[nodiscard]] Result<model::Model> read_models(std::span<const std::filesystem::path> paths,
                                               const ReadOptions& options,
                                               const parallel::Context& context);

/// A file, and what the user says about it.
struct FileToRead {
  std::filesystem::path path;
  ReadOptions options;
};

/// Reads as the other read_models() does, but each file by options of its own.
[[nodiscard]] Result<model::Model> read_models(std::span<const FileToRead> files,
                                               const parallel::Context& context);

}  // namespace strake::io
