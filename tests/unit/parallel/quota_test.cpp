// SPDX-License-Identifier: Apache-2.0
#include "parallel/quota.hpp"

#include <gtest/gtest.h>

#include <filesystem>
#include <fstream>

#include "strake/parallel/team.hpp"

namespace strake::parallel {
namespace {

namespace fs = std::filesystem;

class Quota : public ::testing::Test {
 protected:
  Quota() : root_(fs::path(::testing::TempDir()) / unique_name()) { fs::create_directories(root_); }
  ~Quota() override { fs::remove_all(root_); }
  Quota(const Quota&) = delete;
  Quota& operator=(const Quota&) = delete;
  Quota(Quota&&) = delete;
  Quota& operator=(Quota&&) = delete;

  void write(const fs::path& relative, const std::string& text) const {
    fs::create_directories((root_ / relative).parent_path());
    std::ofstream(root_ / relative) << text;
  }
  [[nodiscard]] std::optional<double> quota() const { return cpu_quota(root_, root_ / "self"); }

 private:
  static std::string unique_name() {
    return std::string("strake_quota_") +
           ::testing::UnitTest::GetInstance()->current_test_info()->name();
  }
  fs::path root_;
};

TEST_F(Quota, version_two_takes_the_tightest_group_above) {
  write("self", "0::/a/b\n");
  write("cpu.max", "max 100000\n");
  write("a/cpu.max", "150000 100000\n");
  write("a/b/cpu.max", "400000 100000\n");
  EXPECT_EQ(quota(), 1.5);
}

TEST_F(Quota, version_one_names_its_controllers) {
  write("self", "4:memory:/x\n3:cpu,cpuacct:/job/1\n0::/\n");
  write("cpu,cpuacct/job/1/cpu.cfs_quota_us", "50000\n");
  write("cpu,cpuacct/job/1/cpu.cfs_period_us", "100000\n");
  EXPECT_EQ(quota(), 0.5);
}

TEST_F(Quota, no_limit_is_no_limit) {
  write("self", "3:cpu:/\n0::/\n");
  write("cpu/cpu.cfs_quota_us", "-1\n");
  write("cpu/cpu.cfs_period_us", "100000\n");
  write("unified/cpu.max", "max 100000\n");
  EXPECT_FALSE(quota());
}

TEST_F(Quota, nonsense_is_no_limit) {
  EXPECT_FALSE(quota()) << "no file at all";
  write("self", "nothing\n::\n0:\n0::/../../..\n");
  write("cpu.max", "many few\n");
  EXPECT_FALSE(quota());
}

TEST(DefaultWorkers, is_at_least_one) {
  EXPECT_GE(default_workers(), 1U);
  EXPECT_LE(default_workers(), 4096U);
}

}  // namespace
}  // namespace strake::parallel
