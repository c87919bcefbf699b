// SPDX-License-Identifier: Apache-2.0
#include "sheets/arrangement/far_objects_of_views.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cstddef>
#include <string>
#include <utility>

#include "drawing/layout/far_objects.hpp"

namespace strake::sheets {

namespace {

using drawing::FarObjects;

class FarObjectsOfViews {
 public:
  FarObjectsOfViews(const SheetSpec& what, const model::Scene& scene,
                    std::span<std::vector<bool>* const> drawn, Diagnostics& diagnostics)
      : what_(what), scene_(scene), drawn_(drawn), diagnostics_(diagnostics) {}

  Status find(const parallel::Context& context) {
    for (std::size_t v = 0; v < what_.views.size(); ++v) {
      auto far = drawing::find_far_objects(scene_, *drawn_[v], what_.views[v].view, context);
      if (!far) return far.error();
      far_.push_back(std::move(*far));
    }
    return {};
  }

  std::vector<std::vector<model::ObjectId>> leave_out() {
    const std::vector<model::ObjectId> shared = far_in_arranged_views();
    std::vector<std::vector<model::ObjectId>> left_out(what_.views.size());
    for (std::size_t v = 0; v < what_.views.size(); ++v) {
      const ViewSpec& view = what_.views[v];
      if (!view.leaves_far_objects_out) {
        if (!far_[v].objects.empty()) warn_of(v);
        continue;
      }
      left_out[v] = view.slot == ViewSlot::none ? far_[v].objects : drawn_of(shared, v);
      if (left_out[v].empty()) continue;
      report(v, left_out[v].size());
      FarObjects out;
      out.objects = left_out[v];
      drawing::leave_out(out, *scene_.model, *drawn_[v]);
    }
    return left_out;
  }

 private:
  [[nodiscard]] std::vector<model::ObjectId> far_in_arranged_views() const {
    std::vector<model::ObjectId> objects;
    for (std::size_t v = 0; v < what_.views.size(); ++v)
      if (what_.views[v].slot != ViewSlot::none && what_.views[v].leaves_far_objects_out)
        for (const model::ObjectId object : far_[v].objects)
          if (std::ranges::find(objects, object) == objects.end()) objects.push_back(object);
    return objects;
  }

  [[nodiscard]] std::vector<model::ObjectId> drawn_of(std::vector<model::ObjectId> objects,
                                                      std::size_t v) const {
    const std::vector<bool>& drawn = *drawn_[v];
    if (!drawn.empty())
      std::erase_if(objects, [&](model::ObjectId object) { return !drawn[model::index(object)]; });
    return objects;
  }

  void warn_of(std::size_t v) {
    const FarObjects& far = far_[v];
    const auto size = [](const drawing::PlaneBox& box) {
      return std::max(box.width(), box.height());
    };
    const std::string pronoun = far.objects.size() == 1 ? "it" : "them";
    const std::string times = size(far.rest) > 0
                                  ? fmt::format("{:.0f} times", size(far.whole) / size(far.rest))
                                  : "many times";
    diagnostics_.add(
        Severity::warning, "far-object",
        fmt::format("{}: the view '{}' is {} as large for {} (limits = \"auto\" leaves {} out)",
                    drawing::far_objects_text(far, *scene_.model), what_.views[v].name, times,
                    pronoun, pronoun),
        what_.views[v].where);
  }

  void report(std::size_t v, std::size_t count) {
    const FarObjects& far = far_[v];
    const std::string left_out =
        fmt::format("the view '{}' leaves {} {} out (limits = \"auto\")", what_.views[v].name,
                    count, count == 1 ? "object" : "objects");
    diagnostics_.add(Severity::note, "far-object-left-out",
                     (far.objects.empty() ? "far off in another arranged view"
                                          : drawing::far_objects_text(far, *scene_.model)) +
                         ": " + left_out,
                     what_.views[v].where);
  }

  const SheetSpec& what_;
  const model::Scene& scene_;
  std::span<std::vector<bool>* const> drawn_;
  Diagnostics& diagnostics_;
  std::vector<FarObjects> far_;
};

}  // namespace

Result<std::vector<std::vector<model::ObjectId>>> resolve_far_objects(
    const SheetSpec& what, const model::Scene& scene, std::span<std::vector<bool>* const> drawn,
    Diagnostics& diagnostics, const parallel::Context& context) {
  FarObjectsOfViews views(what, scene, drawn, diagnostics);
  if (const Status status = views.find(context); !status) return status.error();
  return views.leave_out();
}

}  // namespace strake::sheets
