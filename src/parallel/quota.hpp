// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <filesystem>
#include <optional>

namespace strake::parallel {

/// Returns the CPUs' worth of time that the control groups of a process allow, or nothing where
/// there is no limit. `self_cgroup` is /proc/self/cgroup or a file like it; both versions are
/// understood.
[[nodiscard]] std::optional<double> cpu_quota(const std::filesystem::path& cgroup_root,
                                              const std::filesystem::path& self_cgroup);

}  // namespace strake::parallel
