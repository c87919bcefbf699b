// SPDX-License-Identifier: Apache-2.0
// One importer for several files, played by scripts: each file is read as if it were alone.
#include <gtest/gtest.h>
#include <signal.h>

#include <algorithm>
#include <chrono>
#include <filesystem>
#include <fstream>
#include <iterator>
#include <stop_token>
#include <string>
#include <thread>

#include "strake/io/importer.hpp"
#include "strake/parallel/team.hpp"
#include "support/fake_importers.hpp"

namespace strake::io {
namespace {

namespace fs = std::filesystem;

using test::FakeImporters;
using test::kEnd;

/// Importers that have a program for several files: it does what the other does, in a process for
/// each file. Its calls are told from those of the other.
class ImportersOfSeveralFiles : public FakeImporters {
 protected:
  ImportersOfSeveralFiles() {
    play_several(R"(while read -r word folder; do
  [ $word = run ] && serve &
  [ $word = end ] && kill -9 -$(cat $pids/$(basename $folder))
done)");
  }

  /// Makes the program for several files: a script, which knows serve, $folder and $pids.
  void play_several(const std::string& script) {
    const fs::path program = bin_ / "strake-import-many-toy";
    std::ofstream(program) << "#!/bin/sh\npids=" << pids_.string() << " toy=" << bin_.string()
                           << "/strake-import-toy\necho x >> " << hosts_.string() << R"(
serve() {
  cd $folder
  set -- $(tr '",[]{}' ' ' < job.json)
  shift 2
  rm job.json
  HOSTED=yes setsid $toy "$@" < /dev/null > log 2>&1 &
  echo $! > $pids/$(basename $folder)
  wait $!
  status=$?
  how='"status"'
  [ $status -gt 128 ] && how='"signal"' && status=$((status - 128))
  echo "{$how: $status}" > ended.part
  mv ended.part ended
}
)" << script << "\n";
    fs::permissions(program, fs::perms::owner_all);
  }
  [[nodiscard]] std::size_t lines_of(const fs::path& file) const {
    std::ifstream in(file);
    return static_cast<std::size_t>(std::count(std::istreambuf_iterator<char>(in), {}, '\n'));
  }
  [[nodiscard]] std::size_t hosts() const { return lines_of(hosts_); }
  [[nodiscard]] std::size_t hosted() const { return lines_of(hosted_); }
  /// Notes which files have a process of the program for several.
  [[nodiscard]] std::string note() const {
    return "[ \"$HOSTED\" ] && echo \"$input\" >> " + hosted_.string() + "\n";
  }

  fs::path hosts_ = folder_.path() / "hosts", hosted_ = folder_.path() / "hosted";
  fs::path pids_ = [this] {
    fs::create_directory(folder_.path() / "pids");
    return folder_.path() / "pids";
  }();
  fs::path a_ = folder_.write("a.toy", "a"), b_ = folder_.write("b.toy", "b"),
           c_ = folder_.write("c.toy", "c");
};

TEST_F(ImportersOfSeveralFiles, OneIsStartedForAllThatThereAre) {
  play_well(note() + "[ \"$(ls)\" = log ] || exit 9");
  for (const unsigned workers : {1U, 3U}) {
    parallel::Team team(workers);
    const Result<model::Model> model = read({a_, b_, c_}, {.team = &team});
    ASSERT_TRUE(model) << model.error().text();
    EXPECT_EQ(model->objects.size(), 3U);
    EXPECT_EQ(hosts(), 1U);
    EXPECT_EQ(hosted(), 3U);
    EXPECT_EQ(calls(), 3U);
    EXPECT_TRUE(is_tidy());
  }
  std::ofstream(a_) << "anew";
  ASSERT_TRUE(read({a_, b_, c_}));
  EXPECT_EQ(hosts(), 1U) << "a file that is alone has its importer";
  EXPECT_EQ(calls(), 4U);
}

TEST_F(ImportersOfSeveralFiles, WhatGoesWrongWithOneIsNothingToTheOthers) {
  settings_.silence_s = 2;
  play(note() + "case $input in *a.toy) echo at 7; kill -SEGV $$;; *b.toy) sleep 600;; esac\n" +
       make_scene() + kEnd);
  EXPECT_NE(read({c_, a_}).error().text().find(
                a_.string() + ": strake-import-toy crashed on the file: it was ended by signal 11"),
            std::string::npos);
  EXPECT_EQ(hosted(), 2U);
  EXPECT_EQ(calls(), 2U) << "what crashed by itself is not tried again";
  EXPECT_EQ(kept(), 1U);
  std::ofstream(c_) << "anew";
  EXPECT_NE(read({c_, b_}).error().text().find(b_.string() + ": strake-import-toy was ended after"),
            std::string::npos);
  EXPECT_EQ(kept(), 2U);
  EXPECT_TRUE(is_tidy());
  int process = 0;
  for (const auto& entry : fs::directory_iterator(pids_)) {
    std::ifstream(entry.path()) >> process;
    EXPECT_NE(::kill(process, 0), 0) << "nobody is left behind";
  }
}

TEST_F(ImportersOfSeveralFiles, FilesOfOneThatIsGoneHaveTheirOwn) {
  play_well(note());
  // At once; with the first file; in the middle of a file, of which a part is written.
  const std::string in_the_middle =
      "[ \"$HOSTED\" ] && echo '{\"progress\": 0.9}' >> $report && kill -9 $(cat " +
      (folder_.path() / "host").string() + ") && sleep 3 && exit 1\n";
  std::size_t round = 0;
  for (const std::string script :
       {"exit 1", "read -r word; exit 1",
        "echo $$ > $pids/../host; while read -r word folder; do serve & done"}) {
    if (++round == 3) play_well(note() + in_the_middle);
    play_several(script);
    for (const fs::path& file : {a_, b_}) std::ofstream(file) << "round " << round << file;
    parallel::Team team(2);
    const Result<model::Model> model = read({a_, b_}, {.team = &team});
    ASSERT_TRUE(model) << model.error().text();
    EXPECT_EQ(model->objects.size(), 2U);
    EXPECT_EQ(hosts(), round);
    EXPECT_TRUE(is_tidy());
  }
}

TEST_F(ImportersOfSeveralFiles, OneThatDoesNotObeyIsKilled) {
  play_several("while read -r word folder; do [ $word = run ] && serve & done");
  settings_.silence_s = 0.3;
  play("sleep 60");
  const auto begin = std::chrono::steady_clock::now();
  EXPECT_NE(read({a_, b_}).error().text().find("without progress"), std::string::npos);
  EXPECT_LT(std::chrono::steady_clock::now() - begin, std::chrono::seconds(50));
}

TEST_F(ImportersOfSeveralFiles, OneThatHangsCostsNoFile) {
  play_several("sleep 600");
  settings_.silence_s = 3;  // enough for a script on a busy machine
  play_well(note());
  const Result<model::Model> model = read({a_, b_});
  ASSERT_TRUE(model) << model.error().text();
  EXPECT_EQ(hosted(), 0U);
  EXPECT_EQ(calls(), 2U);
}

TEST_F(ImportersOfSeveralFiles, AnAnswerThatIsNoneIsALostHost) {
  play_well(note());
  std::size_t round = 0;
  for (const std::string answer : {"echo '[]' > $folder/ended", "mkdir $folder/ended",
                                   "echo '{\"status\": 1e300}' > $folder/ended"}) {
    play_several("while read -r word folder; do " + answer + "; done");
    for (const fs::path& file : {a_, b_}) std::ofstream(file) << answer << file;
    const Result<model::Model> model = read({a_, b_});
    ASSERT_TRUE(model) << answer << ": " << model.error().text();
    EXPECT_EQ(hosted(), 0U);
    EXPECT_EQ(calls(), 2 * ++round);
  }
}

TEST_F(ImportersOfSeveralFiles, AreCancelledWithTheRun) {
  play("sleep 600");
  // One that still loads reads no order, and is not waited for either.
  for (const std::string several : {"while read -r word folder; do serve & done", "sleep 600"}) {
    play_several(several);
    std::stop_source stop;
    std::chrono::steady_clock::time_point stopped;
    std::thread stopper([&] {
      std::this_thread::sleep_for(std::chrono::milliseconds(400));
      stopped = std::chrono::steady_clock::now();
      stop.request_stop();
    });
    parallel::Team team(2);
    const Result<model::Model> model = read({a_, b_}, {.team = &team, .stop = stop.get_token()});
    const auto end = std::chrono::steady_clock::now();
    stopper.join();
    ASSERT_FALSE(model);
    EXPECT_EQ(model.error().code, ErrorCode::cancelled);
    EXPECT_LT(end - stopped, std::chrono::seconds(4));
    EXPECT_TRUE(is_tidy());
  }
}

}  // namespace
}  // namespace strake::io
