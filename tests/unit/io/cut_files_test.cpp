// SPDX-License-Identifier: Apache-2.0
// Files cut off at every byte: a model of what is left either is refused, or told as what ends
// early or lacks something, or is whole.
#include <gtest/gtest.h>

#include <algorithm>
#include <cstddef>
#include <functional>
#include <string>
#include <string_view>
#include <vector>

#include "strake/io/reader.hpp"
#include "support/io_files.hpp"
#include "support/io_seeds.hpp"
#include "support/rvm_writer.hpp"

namespace strake::io {
namespace {

using test::RvmWriter;
using test::Seed;

/// Whether it is told that something is missing, and so that --strict and not_compared know.
bool is_reported(const Result<model::Model>& model) {
  if (!model) return true;
  const bool incomplete = std::ranges::any_of(model->objects, &model::Object::incomplete);
  return model->diagnostics.skipped() > 0 && (incomplete || model->files.at(0).ends_early);
}

/// Whether what is left of a file is whole.
using Whole = std::function<bool(std::string_view rest)>;

void cut_everywhere(const Reader& reader, const Seed& seed, const Whole& whole) {
  EXPECT_FALSE(is_reported(test::read_bytes(reader, seed.bytes, seed.name, {}))) << seed.name;
  for (std::size_t length = 0; length < seed.bytes.size(); ++length) {
    const std::string rest = seed.bytes.substr(0, length);
    const Result<model::Model> model = test::read_bytes(reader, rest, seed.name, {});
    if (whole(rest)) continue;
    EXPECT_TRUE(is_reported(model)) << seed.name << " cut at " << length << ":\n" << rest;
  }
}

std::vector<std::string> words_of(std::string_view line) {
  std::vector<std::string> words;
  for (std::size_t at = 0; at < line.size();) {
    const std::size_t begin = std::min(line.find_first_not_of(" \t\r", at), line.size());
    const std::size_t end = std::min(line.find_first_of(" \t\r", begin), line.size());
    if (end > begin) words.emplace_back(line.substr(begin, end - begin));
    at = end;
  }
  for (std::string& word : words)
    for (char& c : word)
      if (c >= 'A' && c <= 'Z') c = static_cast<char>(c - 'A' + 'a');
  return words;
}

std::vector<std::vector<std::string>> lines_of(std::string_view text) {
  std::vector<std::vector<std::string>> lines;
  while (!text.empty()) {
    const std::size_t length = std::min(text.find('\n'), text.size());
    if (auto words = words_of(text.substr(0, length)); !words.empty()) lines.push_back(words);
    text.remove_prefix(std::min(length + 1, text.size()));
  }
  return lines;
}

/// The grammar of a text STL, with comments between solids.
bool is_whole_stl(std::string_view text) {
  bool open = false, some = false;
  std::size_t step = 0;  // within a facet
  for (const std::vector<std::string>& line : lines_of(text)) {
    constexpr std::string_view kSteps[] = {"facet",  "outer",   "vertex",  "vertex",
                                           "vertex", "endloop", "endfacet"};
    if (!open && line[0] == "solid") {
      open = true;
    } else if (open && step == 0 && line[0] == "endsolid") {
      open = false;
    } else if (open && line[0] == kSteps[step]) {
      if (line[0] == "vertex" && line.size() != 4) return false;
      step = (step + 1) % std::size(kSteps);
      some = some || step == 0;
    } else if (open || line[0][0] != '#') {
      return false;
    }
  }
  return !open && some;
}

std::string facet(double x, std::string_view end = "\n") {
  const std::string at = std::to_string(x);
  std::string text;
  for (const std::string& line :
       {std::string("facet normal 0 0 1"), std::string("  outer loop"), "    vertex " + at + " 0 0",
        "    vertex " + at + "1 1e1 0.25", "    vertex -" + at + " 0 12.5e-1",
        std::string("  endloop"), std::string("endfacet")})
    text += line + std::string(end);
  return text;
}

std::vector<Seed> text_stl_files() {
  std::vector<Seed> seeds{test::stl_seeds()[1]};
  seeds.push_back({"crlf.stl", "solid a b\r\n" + facet(1, "\r\n") + "endsolid a b\r\n\r\n"});
  seeds.push_back({"plain.stl", "solid\n" + facet(1) + facet(2) + "endsolid"});
  seeds.push_back({"several.stl", "solid one\n" + facet(1) +
                                      "endsolid one\n# of a program\nsolid two\n" + facet(2) +
                                      facet(3) + "endsolid\n\n  solid three\n" + facet(4) +
                                      "endsolid three\n"});
  std::string capitals = seeds.back().bytes;
  for (char& c : capitals)
    if (c >= 'a' && c <= 'z' && c != 'e') c = static_cast<char>(c - 'a' + 'A');
  seeds.push_back({"capitals.stl", capitals});
  return seeds;
}

TEST(CutFiles, TextStl) {
  for (const Seed& seed : text_stl_files()) cut_everywhere(*make_stl_reader(), seed, is_whole_stl);
}

TEST(CutFiles, TextStlWithoutItsLastLine) {
  const std::string one = "solid one\n" + facet(1),
                    two = "solid two\n" + facet(2) + "endsolid two\n";
  const auto cut = test::read_bytes(*make_stl_reader(), one, "part.stl", {});
  ASSERT_TRUE(cut);
  EXPECT_TRUE(cut->files.at(0).ends_early);
  EXPECT_TRUE(cut->objects.at(0).incomplete);
  EXPECT_EQ(cut->diagnostics.kept().at(0).code, "stl-truncated");
  EXPECT_EQ(cut->diagnostics.kept().at(0).where, "part.stl:9");
  // A solid that another one cuts off, as of files put together.
  const auto joined = test::read_bytes(*make_stl_reader(), one + two, "part.stl", {});
  ASSERT_TRUE(joined);
  ASSERT_EQ(joined->objects.size(), 2U);
  EXPECT_FALSE(joined->files.at(0).ends_early);
  EXPECT_TRUE(joined->objects[0].incomplete);
  EXPECT_FALSE(joined->objects[1].incomplete);
}

TEST(CutFiles, BinaryStl) {
  cut_everywhere(*make_stl_reader(), test::stl_seeds()[0], [](std::string_view) { return false; });
}

/// An OBJ has no end: what is left of it is whole where it ends with a line that says something.
TEST(CutFiles, Obj) {
  const Whole whole = [](std::string_view text) {
    if (text.empty() || text.back() == '\n') return true;
    const auto lines = lines_of(text);
    const std::vector<std::string>& last = lines.back();
    const bool number = last.back().find_last_of("0123456789.") + 1 == last.back().size();
    if (last[0] == "v") return last.size() >= 4 && number;
    if (last[0] == "f") return last.size() >= 4;
    if (last[0] == "l") return last.size() >= 3;
    return true;
  };
  for (const Seed& seed : {Seed{"small.obj",
                                "# of a program\no one\nv 0 0 0\nv 10 0 0\nv 10 10 0\nv 0 10 "
                                "5.25\nf 1 2 3\nf 1 3 4\no two\n"
                                "v 1.5e1 0 0\nl 1 5\nf 1//1 2//1 5//1\n"},
                           test::obj_seeds()[0]})
    cut_everywhere(*make_obj_reader(), seed, whole);
}

TEST(CutFiles, Gltf) {
  // Blanks behind the last brace.
  const Whole whole = [](std::string_view text) {
    return std::ranges::count(text, '{') == std::ranges::count(text, '}') && text.ends_with('}');
  };
  cut_everywhere(*make_gltf_reader(), test::gltf_seeds()[0], whole);
  for (const std::size_t glb : {1U, 2U})
    cut_everywhere(*make_gltf_reader(), test::gltf_seeds()[glb],
                   [](std::string_view) { return false; });
}

RvmWriter small_rvm() {
  RvmWriter w;
  w.head().modl().colr(1, 10, 20, 30).cntb("/A").prim(8, {50, 400});
  w.cntb("/B").facets({{{{0, 0, 0}, {9, 0, 0}, {9, 9, 0}, {0, 9, 0}}}}).cnte().cnte();
  w.finish();
  return w;
}

TEST(CutFiles, BinaryRvm) {
  const RvmWriter w = small_rvm();
  const std::string bytes(reinterpret_cast<const char*>(w.bytes().data()), w.bytes().size());
  constexpr std::size_t kFrame = 24;  // of the END chunk, behind which nothing counts
  const std::size_t end = w.last_chunk() + kFrame;
  cut_everywhere(*make_rvm_reader(), {"small.rvm", bytes},
                 [&](std::string_view rest) { return rest.size() >= end; });
}

TEST(CutFiles, TextRvm) {
  const std::string bytes =
      "HEAD\n1 1\ninfo\nnote\ndate\nuser\nMODL\n1 1\nP\n/M\nCNTB\n1 2\n/A\n 0.0 0.0 0.0\n7\n"
      "PRIM\n1 1\n8\n0.001 0.0 0.0 0.0\n0.0 0.001 0.0 0.0\n0.0 0.0 0.001 0.0\n"
      "-1 -1 -1\n1 1 1\n50.5 400.25\nCNTE\n1 2\nEND:\n1 1\n";
  cut_everywhere(*make_rvm_reader(), {"small.rev", bytes}, [&](std::string_view rest) {
    return rest.find("END:") != std::string_view::npos;
  });
}

}  // namespace
}  // namespace strake::io
