// SPDX-License-Identifier: Apache-2.0
#include "parallel/quota.hpp"

#include <sched.h>

#include <algorithm>
#include <cmath>
#include <cstdlib>
#include <fstream>
#include <sstream>
#include <string>
#include <string_view>
#include <system_error>
#include <thread>

#include "strake/parallel/team.hpp"

namespace strake::parallel {

namespace {

namespace fs = std::filesystem;

void lower(std::optional<double>& limit, double quota, double period) {
  if (quota > 0 && period > 0) limit = std::min(limit.value_or(quota / period), quota / period);
}

std::optional<double> number_in(const fs::path& file) {
  std::ifstream in(file);
  double value = 0;
  return in >> value ? std::optional(value) : std::nullopt;
}

bool present(const fs::path& path) {
  std::error_code ignored;
  return fs::exists(path, ignored);
}

/// Reads the limit of cgroup v2: "max 100000" or "150000 100000".
void read_v2(const fs::path& folder, std::optional<double>& limit) {
  std::ifstream in(folder / "cpu.max");
  std::string quota;
  double period = 0;
  if (in >> quota >> period && quota != "max")
    lower(limit, std::strtod(quota.c_str(), nullptr), period);
}

void read_v1(const fs::path& folder, std::optional<double>& limit) {
  const auto quota = number_in(folder / "cpu.cfs_quota_us");
  const auto period = number_in(folder / "cpu.cfs_period_us");
  if (quota && period) lower(limit, *quota, *period);
}

/// Calls read on the group's folder and on every one above it: each may set a limit.
template <class Read>
void climb(const fs::path& root, const std::string& group, Read read) {
  fs::path folder = root / fs::path(group).relative_path();
  for (;;) {
    read(folder);
    if (folder == root || folder == folder.parent_path()) return;
    folder = folder.parent_path();
    if (folder.native().size() < root.native().size()) return;
  }
}

bool lists(const std::string& controllers, std::string_view name) {
  std::istringstream in(controllers);
  std::string one;
  while (std::getline(in, one, ','))
    if (one == name) return true;
  return false;
}

}  // namespace

std::optional<double> cpu_quota(const fs::path& cgroup_root, const fs::path& self_cgroup) {
  std::optional<double> limit;
  std::ifstream in(self_cgroup);
  std::string line;
  while (std::getline(in, line)) {
    // hierarchy-ID:controllers:path; version 2 has the id 0 and no controllers.
    const std::size_t first = line.find(':');
    const std::size_t second = first == std::string::npos ? first : line.find(':', first + 1);
    if (second == std::string::npos) continue;
    const std::string controllers = line.substr(first + 1, second - first - 1);
    const std::string group = line.substr(second + 1);
    if (controllers.empty()) {
      const bool hybrid = present(cgroup_root / "unified");
      climb(hybrid ? cgroup_root / "unified" : cgroup_root, group,
            [&](const fs::path& folder) { read_v2(folder, limit); });
    } else if (lists(controllers, "cpu")) {
      climb(cgroup_root / (present(cgroup_root / controllers) ? controllers : "cpu"), group,
            [&](const fs::path& folder) { read_v1(folder, limit); });
    }
  }
  return limit;
}

unsigned default_workers() {
  unsigned cpus = std::max(1U, std::thread::hardware_concurrency());
  cpu_set_t mask;
  CPU_ZERO(&mask);
  if (sched_getaffinity(0, sizeof mask, &mask) == 0)
    cpus = static_cast<unsigned>(std::max(1, CPU_COUNT(&mask)));
  const std::optional<double> quota = cpu_quota("/sys/fs/cgroup", "/proc/self/cgroup");
  if (quota && std::ceil(*quota) < cpus)
    cpus = std::max(1U, static_cast<unsigned>(std::ceil(*quota)));
  return cpus;
}

}  // namespace strake::parallel
