// SPDX-License-Identifier: Apache-2.0
// draw_view MODEL... : an isometric view without the lines that are hidden, as view.svg.
#include <cstdio>
#include <filesystem>
#include <string_view>
#include <vector>

#include "strake/strake.hpp"

namespace {

strake::Status draw_view(const std::vector<std::filesystem::path>& files) {
  using namespace strake;
  parallel::Team team(parallel::default_workers());
  const parallel::Context context{.team = &team};

  const Result<model::Model> model = io::read_models(files, {}, context);
  if (!model) return model.error();
  const Result<model::Scene> scene = model::make_scene(*model, {}, context);
  if (!scene) return scene.error();
  const std::vector<bool> all(model->objects.size(), true);
  const hlr::View view{.direction = *drawing::direction_by_name("iso")};
  const drawing::LayoutOptions layout{.view_name = "iso"};
  const Result<double> sag = drawing::sag_for_paper(*scene, all, view, layout, context);
  if (!sag) return sag.error();

  const Result<hlr::Drawing> lines =
      hlr::draw(*scene, all, view, {.sag_mm = *sag, .hidden = false}, context);
  if (!lines) return lines.error();
  const Result<drawing::NeutralDrawing> sheet = drawing::lay_out(*lines, *model, layout, context);
  if (!sheet) return sheet.error();
  const Result<drawing::Ink> ink = drawing::choose_ink(*sheet, {}, context);
  if (!ink) return ink.error();
  Result<AtomicFile> file = AtomicFile::create("view.svg");
  if (!file) return file.error();
  drawing::write_svg(*sheet, *ink, *model, [&](std::string_view text) { file->write(text); });
  return file->commit();
}

}  // namespace

int main(int count, char** arguments) {
  const strake::Status status = draw_view({arguments + 1, arguments + count});
  if (!status) std::fprintf(stderr, "%s\n", status.error().text().c_str());
  return status ? 0 : 1;
}
