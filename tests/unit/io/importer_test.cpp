// SPDX-License-Identifier: Apache-2.0
// Importers, played by scripts: whatever they do, the file is read or the error says why not.
#include "strake/io/importer.hpp"

#include <gtest/gtest.h>
#include <signal.h>

#include <algorithm>
#include <chrono>
#include <filesystem>
#include <fstream>
#include <stop_token>
#include <string>
#include <string_view>
#include <thread>
#include <vector>

#include "io/importer/import_report.hpp"
#include "io/importer/scene_cache.hpp"
#include "strake/parallel/team.hpp"
#include "support/fake_importers.hpp"
#include "support/gltf_files.hpp"
#include "support/io_files.hpp"

namespace strake::io {
namespace {

namespace fs = std::filesystem;

using test::FakeImporters;
using test::kEnd;

TEST_F(FakeImporters, AreCalledOnceForAFileAndItsSceneIsItsModel) {
  play_well(R"(echo '{"progress": 0.5}' >> "$report"
echo '{"severity": "skipped", "code": "toy-lost", "object": "T7", "message": "no shape"}' >> "$report")");
  for (int run = 0; run < 2; ++run) {
    const Result<model::Model> model = read({toy_});
    ASSERT_TRUE(model) << model.error().text();
    const model::SourceFile& file = model->files.at(0);
    EXPECT_EQ(file.label, "arch.toy");
    EXPECT_EQ(file.format, "TOY2");
    EXPECT_EQ(file.unit, "mm (stated)");
    EXPECT_EQ(file.bytes, 6U);
    ASSERT_EQ(model->objects.size(), 1U);
    EXPECT_EQ(model->objects[0].id, "T1");
    EXPECT_EQ(model->diagnostics.skipped(), 1U);
    EXPECT_EQ(model->diagnostics.kept().at(0).where, toy_.string() + ", T7");
    EXPECT_EQ(calls(), 1U) << "the second run finds the scene";
  }
  EXPECT_TRUE(is_tidy());
}

TEST_F(FakeImporters, GetASagOnlyWhereOneIsStated) {
  play_well("echo \"$*\" >> " + (folder_.path() / "words").string());
  const auto words = [&] {
    std::ifstream in(folder_.path() / "words");
    return std::string(std::istreambuf_iterator<char>(in), {});
  };
  ASSERT_TRUE(read({toy_}));
  EXPECT_EQ(words().find("--sag"), std::string::npos);
  settings_.sag_mm = 0.25;
  ASSERT_TRUE(read({toy_}));
  EXPECT_TRUE(words().ends_with(" --sag 0.25\n")) << words();
  ASSERT_TRUE(read({toy_}));
  EXPECT_EQ(calls(), 2U) << "another sag is another scene, and the same is found";
}

TEST_F(FakeImporters, WhatTheContentStatesWins) {
  play_well();
  const fs::path glb = folder_.write("b.toy", test::triangle_glb(R"("nodes":[{"mesh":0}])"));
  const Result<model::Model> model = read({glb});
  ASSERT_TRUE(model) << model.error().text();
  EXPECT_EQ(model->files[0].format, "GLB");
  EXPECT_EQ(calls(), 0U);
}

TEST_F(FakeImporters, AreNamedByTheSchemaOfAStepFile) {
  play(make_scene() + kEnd, "ifc");
  EXPECT_TRUE(
      read({folder_.write("a.stp", "ISO-10303-21;\nHEADER;FILE_SCHEMA(('IFC4'));ENDSEC;\n")}));
  const fs::path step =
      folder_.write("b.stp", "ISO-10303-21;\nHEADER;FILE_SCHEMA(('AUTOMOTIVE_DESIGN'));\n");
  EXPECT_NE(read({step}).error().text().find("strake-import-step"), std::string::npos);
  play(make_scene() + kEnd, "step");
  EXPECT_TRUE(read({step}));
}

TEST_F(FakeImporters, WithoutOneTheErrorStatesWhatToInstall) {
  const std::string stated = read({folder_.write("a.ifc", "ISO-10303-21;\n")}).error().text();
  EXPECT_NE(stated.find("IFC files are read by an importer: pip install 'strake[ifc]'"),
            std::string::npos)
      << stated;
  EXPECT_EQ(stated.find('\n'), std::string::npos);
}

TEST_F(FakeImporters, AUnitThatIsGivenIsThatOfTheFile) {
  play_well();  // the file is in millimetres, its scene in metres
  ReadOptions options;
  options.unit_mm = 10;
  const Result<model::Model> model = read({toy_}, {}, options);
  ASSERT_TRUE(model) << model.error().text();
  EXPECT_EQ(model->files[0].unit, "cm (given)");
  const auto width = [](const model::Model& m) {
    return std::get<geometry::TriangleMesh>(m.shapes.at(0)).vertices.at(1).x;
  };
  EXPECT_DOUBLE_EQ(width(*model), 10 * width(*read({toy_})));
}

TEST_F(FakeImporters, FailWithTheReasonThatTheyGive) {
  play(R"(echo '{"error": "no geometry at all", "mend": "export it again"}' >> "$report"; exit 1)");
  EXPECT_EQ(error(), toy_.string() + ": no geometry at all (export it again)");
  play(make_scene() + R"(echo '{"error": "half of it is lost"}' >> "$report")");
  EXPECT_NE(error().find("half of it is lost"), std::string::npos) << "an exit status of 0 or not";
  play("echo out of luck; exit 3");
  EXPECT_NE(
      error().find("ended with exit status 3 and gave no reason; it printed last: out of luck"),
      std::string::npos)
      << error();
  play("exit 0");
  EXPECT_NE(error().find("its report has no end"), std::string::npos);
  play(kEnd);
  EXPECT_NE(error().find("made no scene"), std::string::npos);
  play(std::string("echo nothing > \"$output\"\n") + kEnd);
  EXPECT_NE(error().find("no GLB"), std::string::npos);
  play("ln -s /etc/passwd \"$output\"\n" + std::string(kEnd));
  EXPECT_NE(error().find("made no scene"), std::string::npos);
  EXPECT_TRUE(is_tidy());
  EXPECT_EQ(kept(), 0U) << "what failed is not kept";
}

TEST_F(FakeImporters, ThatOfAllSuffixesStatesWhatWasTriedBeforeIt) {
  play(R"(echo '{"error": "nothing reads .odd", "mend": "install one"}' >> "$report"; exit 1)");
  const fs::path any = bin_ / "strake-import";
  fs::copy_file(bin_ / "strake-import-toy", any);
  const fs::path odd = folder_.write("model.odd", "odd");
  const auto read_odd = read({odd});
  ASSERT_FALSE(read_odd);
  EXPECT_EQ(read_odd.error().text(),
            odd.string() +
                ": nothing reads .odd (install one; Strake itself does not read such files, "
                "strake-import-odd is in none of the folders that are searched, and " +
                any.string() + " was asked)");
  EXPECT_EQ(error(), toy_.string() + ": nothing reads .odd (install one)");
}

TEST_F(FakeImporters, ACrashNamesTheFileAndTheSignal) {
  play("echo at element 77; kill -SEGV $$");
  EXPECT_NE(error().find("signal 11 (segmentation fault); it printed last: at element 77"),
            std::string::npos)
      << error();
  EXPECT_TRUE(error().starts_with(toy_.string()));
}

TEST_F(FakeImporters, ATruncatedSceneIsAnErrorAndNotKept) {
  play("head -c 200 " + scene_.string() + " > \"$output\"\n" + kEnd);
  EXPECT_NE(error().find("the scene that strake-import-toy made cannot be read"), std::string::npos)
      << error();
  EXPECT_EQ(kept(), 0U);
  play_well();
  EXPECT_TRUE(read({toy_}));
}

TEST_F(FakeImporters, ASceneHoldsAllThatItShows) {
  const fs::path secret = folder_.write("secret.bin", std::string(42, 'x'));
  const auto scene_with = [&](const std::string& more) {
    play("cp " +
         folder_.write("other", test::triangle_glb(R"("nodes":[{"mesh":0}])", more)).string() +
         " \"$output\"\n" + kEnd);
    return error();
  };
  EXPECT_NE(scene_with(R"(,"images":[{"uri":"secret.bin"}])").find("names the file 'secret.bin'"),
            std::string::npos)
      << error();
  EXPECT_EQ(kept(), 0U);
  EXPECT_EQ(scene_with(R"(,"images":[{"uri":"data:image/png;base64,AAAA"}])"), "no error");
  const fs::path outside = folder_.write(
      "outside", test::glb(R"({"asset":{"version":"2.0"},"buffers":[{"byteLength":42,)"
                           R"("\u0075ri":"secret.bin"}],"nodes":[]})",
                           {}));
  play("cp " + outside.string() + " \"$output\"\n" + kEnd);
  EXPECT_NE(error().find("a scene holds all that it shows"), std::string::npos) << error();
  EXPECT_TRUE(fs::exists(secret)) << "it was there to be read";
}

TEST_F(FakeImporters, StateWhereAFileLiesOnAMap) {
  // A quarter turn to the left, 5 m east, 7 m north, 9 m up; the other lies a metre farther east.
  play(make_scene() + R"(east=5000; grep -q other "$input" && east=6000
echo '{"made_by": "toy", "map": {"crs": "EPSG:1", "matrix": [0,1,0,0,-1,0,0,0,0,0,1,0,'$east',7000,9000.5,1]}}' >> "$report")");
  const fs::path other = folder_.write("other.toy", "other");
  ReadOptions on_map;
  on_map.on_map = true;
  const auto corner = [&](const model::Model& model, std::size_t body) {
    const model::Body& b = model.bodies.at(body);
    return b.placement *
           std::get<geometry::TriangleMesh>(model.shapes.at(index(b.shape))).vertices.at(1);
  };
  for (int run = 0; run < 2; ++run) {
    const Result<model::Model> own = read({toy_, other});
    ASSERT_TRUE(own) << own.error().text();
    EXPECT_EQ(corner(*own, 0), (geometry::Vec3d{1000, 0, 0}));
    EXPECT_EQ(own->diagnostics.count("map-place-differs"), 1U);
    const Result<model::Model> put = read({toy_, other}, {}, on_map);
    ASSERT_TRUE(put) << put.error().text();
    EXPECT_EQ(corner(*put, 0), (geometry::Vec3d{5000, 8000, 9000.5}));
    EXPECT_EQ(corner(*put, 1), (geometry::Vec3d{6000, 8000, 9000.5}));
    EXPECT_EQ(put->diagnostics.counts().size(), 0U);
  }
  EXPECT_EQ(calls(), 2U) << "one scene serves both";
  EXPECT_EQ(read({toy_, toy_})->diagnostics.counts().size(), 0U);
  const fs::path plain = folder_.write("plain.glb", test::triangle_glb(R"("nodes":[{"mesh":0}])"));
  EXPECT_EQ(read({toy_, plain}, {}, on_map)->diagnostics.count("map-place-unknown"), 1U);
  EXPECT_EQ(read({toy_, plain})->diagnostics.counts().size(), 0U);
  EXPECT_EQ(read({plain}, {}, on_map)->diagnostics.count("map-place-unknown"), 1U);
}

TEST_F(FakeImporters, APlaceOnAMapThatIsNoneIsOdd) {
  const std::string identity = "[1,0,0,0,0,1,0,0,0,0,1,0,0,0,0,1]";
  for (const std::string& map :
       {std::string("7"), std::string("{}"), R"({"crs": "E", "matrix": [1,2]})" + std::string(),
        R"({"crs": 5, "matrix": )" + identity + "}",
        std::string(R"({"crs": "E", "matrix": [1,0,0,0,0,1,0,0,0,0,1,0,1e999,0,0,1]})"),
        std::string(R"({"crs": "E", "matrix": [1,0,0,0,0,-1,0,0,0,0,1,0,0,0,0,1]})"),
        std::string(R"({"crs": "E", "matrix": [1,0,0,1,0,1,0,0,0,0,1,0,0,0,0,1]})")}) {
    play(make_scene() + R"(echo '{"made_by": "toy", "map": )" + map + R"(}' >> "$report")");
    const Result<model::Model> model = read({toy_});
    ASSERT_TRUE(model) << model.error().text();
    EXPECT_EQ(model->diagnostics.count("import-report"), 1U) << map;
  }
}

TEST_F(FakeImporters, WorkInAFolderOfTheirOwn) {
  settings_.cache = fs::relative(folder_.path() / "cache");
  settings_.folders = {fs::relative(bin_)};
  play("pwd; ls -A | grep -v '^log$'; exit 7");
  EXPECT_NE(error().find("printed last: " + (folder_.path() / "cache").string()), std::string::npos)
      << error();
  EXPECT_EQ(error().find("arch.toy "), std::string::npos) << "the model does not lie there";
  play_well();
  EXPECT_EQ(error(), "no error");
}

TEST_F(FakeImporters, OnlySilenceEndsThem) {
  settings_.silence_s = 1;
  play_well(
      "for i in 1 2 3 4 5 6; do sleep 0.4; echo '{\"progress\": 0.'$i'}' >> \"$report\"; done");
  EXPECT_TRUE(read({toy_})) << "slow, but it goes on";
  settings_.silence_s = 0.3;
  play("echo thinking; sleep 60");
  const auto begin = std::chrono::steady_clock::now();
  EXPECT_NE(error().find("was ended after 0.3 s without progress; it printed last: thinking"),
            std::string::npos)
      << error();
  EXPECT_LT(std::chrono::steady_clock::now() - begin, std::chrono::seconds(30));
  play("while :; do echo chatter; sleep 0.01; done");
  EXPECT_NE(error().find("without progress"), std::string::npos) << "what it prints is no progress";
}

TEST_F(FakeImporters, MayPrintWhatFillsADisk) {
  // It waits until its log is short again.
  play_well(R"(head -c 300000000 /dev/zero | tr '\0' 'x'
log=$(readlink /proc/$$/fd/1)
until [ $(stat -c %s "$log") -lt 20000000 ]; do sleep 0.01; done)");
  EXPECT_EQ(error(), "no error");
}

TEST_F(FakeImporters, LeaveNobodyBehind) {
  const fs::path pid = folder_.path() / "pid";
  play_well("sleep 600 & echo $! > " + pid.string());
  ASSERT_TRUE(read({toy_}));
  int number = 0;
  std::ifstream(pid) >> number;
  ASSERT_GT(number, 0);
  for (int i = 0; i < 500 && ::kill(number, 0) == 0; ++i)
    std::this_thread::sleep_for(std::chrono::milliseconds(10));
  // It may wait for init to take notice of its end.
  std::string state;
  std::ifstream status("/proc/" + std::to_string(number) + "/stat");
  std::string id, name;
  if (status >> id >> name >> state) {
    EXPECT_EQ(state, "Z");
  }
}

TEST_F(FakeImporters, HaveNoneOfOurFiles) {
  const std::ifstream held(scene_);
  play("ls /proc/self/fd | tr '\\n' ' '; exit 7");
  // Its own three, and that of the folder which ls reads.
  EXPECT_NE(error().find("printed last: 0 1 2 3"), std::string::npos) << error();
  EXPECT_EQ(error().find(" 4 "), std::string::npos) << error();
}

TEST_F(FakeImporters, AreCancelledWithTheRun) {
  play("sleep 60");
  std::stop_source stop;
  std::thread stopper([&] {
    std::this_thread::sleep_for(std::chrono::milliseconds(200));
    stop.request_stop();
  });
  const Result<model::Model> model = read({toy_}, {.stop = stop.get_token()});
  stopper.join();
  ASSERT_FALSE(model);
  EXPECT_EQ(model.error().code, ErrorCode::cancelled);
  EXPECT_TRUE(is_tidy());
}

TEST_F(FakeImporters, OddReportsAreCountedAndSurvived) {
  play_well(R"(printf 'no json\n[1]\n{"progress": "much"}\n\377\376\n' >> "$report"
echo '{"severity": "fatal", "code": "x"}' >> "$report"
head -c 3000000 /dev/zero | tr '\0' '[' >> "$report"; echo >> "$report")");
  const Result<model::Model> model = read({toy_});
  ASSERT_TRUE(model) << model.error().text();
  EXPECT_EQ(model->diagnostics.count("import-report"), 6U);
}

TEST_F(FakeImporters, AChangedProgramOrPartOfItMakesTheSceneAnew) {
  const fs::path part = folder_.write("part.py", "1");
  play(make_scene() + R"(echo '{"made_by": "toy 1", "depends_on": [")" + part.string() +
       R"("]}' >> "$report")");
  ASSERT_TRUE(read({toy_}));
  ASSERT_TRUE(read({toy_}));
  EXPECT_EQ(calls(), 1U);
  EXPECT_EQ(read({toy_})->files[0].format, "TOY");
  std::ofstream(part) << "22";
  ASSERT_TRUE(read({toy_}));
  EXPECT_EQ(calls(), 2U);
  play_well();
  ASSERT_TRUE(read({toy_}));
  EXPECT_EQ(calls(), 3U);
  std::ofstream(toy_) << "another toy\n";
  ASSERT_TRUE(read({toy_}));
  EXPECT_EQ(calls(), 4U);
}

TEST_F(FakeImporters, ADamagedSceneIsMadeAnew) {
  play_well();
  ASSERT_TRUE(read({toy_}));
  const fs::path entry = list_scenes(*settings_.cache).at(0).path;
  const auto size = fs::file_size(entry);
  for (std::uintmax_t at = 0; at < size; at += 97) {
    std::fstream file(entry, std::ios::in | std::ios::out | std::ios::binary);
    file.seekg(static_cast<std::streamoff>(at));
    const char was = static_cast<char>(file.get());
    file.seekp(static_cast<std::streamoff>(at));
    file.put(static_cast<char>(was ^ 0x20));
    file.close();
    const std::size_t before = calls();
    const Result<model::Model> model = read({toy_});
    ASSERT_TRUE(model) << model.error().text();
    EXPECT_EQ(model->files[0].format, "TOY2");
    EXPECT_EQ(calls(), before + 1) << "byte " << at;
  }
  fs::resize_file(entry, size / 2);
  EXPECT_TRUE(read({toy_}));
}

TEST_F(FakeImporters, TheLeastRecentlyUsedSceneGoes) {
  play_well();
  std::vector<fs::path> files;
  for (int i = 0; i < 3; ++i)
    files.push_back(folder_.write("f" + std::to_string(i) + ".toy", std::to_string(i)));
  ASSERT_TRUE(read({files[0]}));
  settings_.cache_bytes = 2 * list_scenes(*settings_.cache).at(0).bytes + 10;
  ASSERT_TRUE(read({files[1]}));
  ASSERT_TRUE(read({files[0]}));  // used again, so that the other goes
  ASSERT_TRUE(read({files[2]}));
  EXPECT_EQ(kept(), 2U);
  EXPECT_EQ(calls(), 3U);
  ASSERT_TRUE(read({files[0]}));
  EXPECT_EQ(calls(), 3U);
  ASSERT_TRUE(read({files[1]}));
  EXPECT_EQ(calls(), 4U);
  settings_.cache_bytes = 10;
  std::ofstream(files[0]) << "new";
  const Result<model::Model> model = read({files[0], files[2]});
  ASSERT_TRUE(model);
  EXPECT_EQ(model->diagnostics.count("scene-not-kept"), 1U);
}

TEST_F(FakeImporters, WorkWithoutAFolderForScenes) {
  play_well();
  settings_.cache.reset();
  const Result<model::Model> off = read({toy_});
  ASSERT_TRUE(off) << off.error().text();
  EXPECT_EQ(off->diagnostics.count("scene-not-kept"), 0U) << "nobody asked for it";
  settings_.cache = toy_ / "no folder";
  const fs::path other = folder_.write("other.toy", "other");
  const Result<model::Model> model = read({toy_, other});
  ASSERT_TRUE(model) << model.error().text();
  EXPECT_EQ(model->diagnostics.count("scene-not-kept"), 1U) << "it is said once";
}

TEST_F(FakeImporters, RunAtTheSameTimeWithThreadsSharedOut) {
  // Each waits for the other: one by one they would wait for ever.
  const std::string all = folder_.path().string();
  play_well("echo $threads >> " + all + "/threads; touch " + all +
            "/here.$(basename $input); until [ -e " + all + "/here.a.toy ] && [ -e " + all +
            "/here.b.toy ]; do sleep 0.01; done");
  const fs::path a = folder_.write("a.toy", "a"), b = folder_.write("b.toy", "b");
  parallel::Team team(4);
  const Result<model::Model> model = read({a, b}, {.team = &team});
  ASSERT_TRUE(model) << model.error().text();
  std::ifstream in(folder_.path() / "threads");
  const std::string threads(std::istreambuf_iterator<char>(in), {});
  EXPECT_EQ(threads, "2\n2\n");
}

TEST_F(FakeImporters, TheFirstFileThatFailsIsReported) {
  play(
      "case $input in *a.toy) sleep 0.3; echo '{\"error\": \"bad a\"}' >> $report; exit 1;; "
      "*b.toy) echo '{\"error\": \"bad b\"}' >> $report; exit 1;; *) sleep 60;; esac");
  const fs::path a = folder_.write("a.toy", "a"), b = folder_.write("b.toy", "b"),
                 c = folder_.write("c.toy", "c");
  parallel::Team team(3);
  const auto begin = std::chrono::steady_clock::now();
  EXPECT_NE(read({a, b, c}, {.team = &team}).error().text().find("bad a"), std::string::npos);
  EXPECT_LT(std::chrono::steady_clock::now() - begin, std::chrono::seconds(30))
      << "those of later files are given up";
}

TEST_F(FakeImporters, FilesWithEqualBytesShareAScene) {
  play_well();
  settings_.cache.reset();
  const fs::path twin = folder_.write("twin.toy", "a toy\n");
  const Result<model::Model> model = read({toy_, twin});
  ASSERT_TRUE(model) << model.error().text();
  EXPECT_EQ(model->objects.size(), 2U);
  EXPECT_EQ(calls(), 1U);
}

TEST_F(FakeImporters, AFileThatIsWrittenMeanwhileIsNotRead) {
  play_well("echo more >> \"$input\"");
  EXPECT_NE(error().find("is being written while it is read"), std::string::npos) << error();
  EXPECT_EQ(kept(), 0U);
}

TEST(ImportReport, HoldsLittleWhateverIsWritten) {
  ImportReport report;
  for (int i = 0; i < 5000; ++i)
    report.feed("{\"severity\": \"warning\", \"code\": \"c" + std::to_string(i) + "\"}\n");
  report.feed("{\"severity\": \"warning\", \"code\": \"one\"}\n");
  report.feed("{\"severity\": \"skipped\", \"code\": \"c1\", \"message\": \"" +
              std::string(100000, 'x') + "\"}\n");
  report.feed(R"({"progress": 7})");
  report.feed("\n{\"progress\": 0.1}\n");
  report.end();
  const Diagnostics& diagnostics = report.facts().diagnostics;
  EXPECT_LE(diagnostics.counts().size(), ImportReport::kMaxCodes + 3);
  EXPECT_EQ(diagnostics.skipped(), 1U) << "a code that was one of warnings before";
  EXPECT_LT(diagnostics.kept().back().message.size(), 2000U);
  EXPECT_EQ(report.progress(), 1);
  EXPECT_FALSE(report.is_complete());
}

}  // namespace
}  // namespace strake::io
