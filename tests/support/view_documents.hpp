// SPDX-License-Identifier: Apache-2.0
// Drawings of small crowds of boxes, as the neutral file has them.
#pragma once

#include <cstdint>
#include <cstdlib>
#include <sstream>
#include <string>
#include <string_view>
#include <vector>

#include "strake/drawing/drawing.hpp"
#include "strake/drawing/write.hpp"
#include "strake/hlr/hlr.hpp"
#include "strake/report/view_document.hpp"
#include "support/clash_model.hpp"
#include "support/io_seeds.hpp"

namespace strake::test {

struct Drawn {
  hlr::View view{};
  hlr::Options options{};
  drawing::LayoutOptions layout{};
};

enum class ViewForm : std::uint8_t { text, rows };

/// The view file of a model.
[[nodiscard]] inline std::string view_file(const model::Model& model, const Drawn& how = {},
                                           ViewForm form = ViewForm::text) {
  const auto scene = model::make_scene(model, {}, {});
  if (!scene) std::abort();
  const auto lines = hlr::draw(*scene, {}, how.view, how.options, {});
  if (!lines) std::abort();
  const auto paper = drawing::lay_out(*lines, model, how.layout, {});
  if (!paper) std::abort();
  std::string text;
  const auto append = [&](std::string_view piece) { text += piece; };
  const Status written = form == ViewForm::rows
                             ? drawing::write_view_rows(*paper, model, append, {})
                             : drawing::write_view_json(*paper, model, append, {});
  if (!written) std::abort();
  return text;
}

[[nodiscard]] inline report::ViewDocument view_document(const std::string& text,
                                                        const std::string& name = "view.json") {
  std::istringstream in(text);
  auto document = report::parse_view_document(in, name);
  if (!document) std::abort();
  return std::move(*document);
}

/// Drawings of a small model, before and after something moved.
[[nodiscard]] inline std::vector<Seed> view_document_seeds() {
  const auto written = [](double from, ViewForm form) {
    ClashModel m;
    m.box("a", {0, 0, 0}, {100, 100, 100}).box("b", {90, 20, 20}, {from, 60, 60});
    return view_file(m.model, {}, form);
  };
  return {{"before.json", written(180, ViewForm::text)},
          {"after.json", written(210, ViewForm::text)},
          {"before.view", written(180, ViewForm::rows)}};
}

}  // namespace strake::test
