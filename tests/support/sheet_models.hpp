// SPDX-License-Identifier: Apache-2.0
// Sheets of small models made by hand.
#pragma once

#include <map>
#include <string>

#include "strake/model/scene.hpp"
#include "strake/sheets/sheet_file.hpp"
#include "strake/sheets/write.hpp"
#include "support/clash_model.hpp"

namespace strake::test {

/// Templates by their names; no other files are read.
using Templates = std::map<std::string, std::string>;

inline Result<sheets::SheetFile> sheet_file(std::string_view text,
                                            const Templates& templates = {}) {
  return sheets::SheetFile::parse(
      text, "s.toml", [&](std::string_view name) -> Result<std::string> {
        const auto found = templates.find(std::string(name));
        if (found != templates.end()) return found->second;
        return Error{ErrorCode::input, "cannot be read: there is no such file", std::string(name),
                     "check the path"};
      });
}

/// What is wrong with a file, or nothing.
inline std::string fault_of(std::string_view text, const Templates& templates = {}) {
  const auto file = sheet_file(text, templates);
  return file ? std::string() : file.error().text();
}

/// A box of 4 x 2 x 1 m with a smaller one on it and one beside.
inline ClashModel three_boxes() {
  ClashModel m;
  m.box("base", {0, 0, 0}, {4000, 2000, 1000});
  m.box("top", {500.003, 250.007, 1000}, {1500.011, 1000.013, 1777.777});
  m.box("far", {5000, 0, 0}, {6000, 500, 250});
  m.model.objects[0].attributes = {{"DN", "80"}, {"MARK", "B1"}};
  m.model.objects[1].attributes = {{"DN", "50"}};
  return m;
}

struct Drawn {
  ClashModel model;
  sheets::Sheet sheet;
  std::string svg;
};

inline Result<Drawn> drawn(const std::string& text, const Templates& templates = {},
                           const parallel::Context& context = {}) {
  Drawn d{three_boxes(), {}, {}};
  const auto scene = model::make_scene(d.model.model, {}, context).value();
  const auto file = sheet_file(text, templates);
  if (!file) return file.error();
  auto sheet = file->compose(scene, {}, context);
  if (!sheet) return sheet.error();
  d.sheet = std::move(*sheet);
  sheets::write_svg(d.sheet, d.model.model, [&](std::string_view part) { d.svg += part; });
  return d;
}

}  // namespace strake::test
