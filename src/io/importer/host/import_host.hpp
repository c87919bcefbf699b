// SPDX-License-Identifier: Apache-2.0
#pragma once

// Decision 0126 says why several files may have one importer.

#include <filesystem>
#include <memory>
#include <stop_token>
#include <string_view>
#include <utility>

#include "io/importer/child_process.hpp"
#include "io/importer/work_folder.hpp"

namespace strake::io {

/// An importer of several files: it loads its libraries once, and then has a process of its own for
/// each file. Any thread may run a file by it.
class ImportHost {
 public:
  /// Starts it, and does not wait; null where that cannot be done.
  [[nodiscard]] static std::unique_ptr<ImportHost> start(const std::filesystem::path& program);
  ~ImportHost();
  ImportHost(const ImportHost&) = delete;
  ImportHost& operator=(const ImportHost&) = delete;
  ImportHost(ImportHost&&) = delete;
  ImportHost& operator=(ImportHost&&) = delete;

  /// Whether it is gone, so that files need programs of their own.
  [[nodiscard]] bool has_ended() const { return process_->has_ended(); }
  /// Whether it can be told of a file: names that are no UTF-8 cannot be.
  [[nodiscard]] static bool takes(const ChildProgram& program);
  /// Does for one file what run_child() does; lost, where the host has ended meanwhile.
  [[nodiscard]] ChildEnd run(const ChildProgram& program, const std::stop_token& stop) const;

 private:
  friend class HostedFile;
  ImportHost(std::unique_ptr<WorkFolder> folder, std::unique_ptr<RunningChild> process, int orders)
      : folder_(std::move(folder)), process_(std::move(process)), orders_(orders) {}
  /// Sends a line; returns whether the host can still read it.
  [[nodiscard]] bool order(std::string_view word, const std::filesystem::path& folder) const;
  void kill() const { process_->kill(); }

  std::unique_ptr<WorkFolder> folder_;
  std::unique_ptr<RunningChild> process_;
  int orders_;  ///< a socket: what is written to it, the host reads
};

}  // namespace strake::io
