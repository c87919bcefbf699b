// SPDX-License-Identifier: Apache-2.0
#include <fmt/core.h>
#include <fmt/ranges.h>
#include <nanobind/nanobind.h>
#include <nanobind/stl/shared_ptr.h>
#include <nanobind/stl/string.h>
#include <nanobind/stl/string_view.h>

#include <algorithm>
#include <cstdint>
#include <memory>
#include <string_view>
#include <utility>

#include "python/bindings/bindings.hpp"
#include "python/bindings/model.hpp"
#include "python/bindings/run.hpp"
#include "strake/generate/ship.hpp"

namespace nb = nanobind;

namespace strake::python {

namespace {

ModelPointer generate_model(std::string_view kind, std::uint64_t objects, std::uint64_t seed,
                            bool turned, const RunOptions& options) {
  const auto found = std::ranges::find(generate::kShipKinds, kind);
  if (found == generate::kShipKinds.end())
    raise({ErrorCode::usage, fmt::format("there is no kind of ship '{}'", kind), "kind",
           fmt::format("write one of {}", fmt::join(generate::kShipKinds, ", "))});
  const generate::ShipOptions ship{
      .objects = objects,
      .seed = seed,
      .turned = turned,
      .kind = static_cast<generate::ShipKind>(found - generate::kShipKinds.begin())};
  generate::Ship made =
      run(options, "generate", [&](const parallel::Context& context) -> Result<generate::Ship> {
        Result<generate::Ship> ready = generate::generate_ship(ship, context);
        if (ready || ready.error().where != "--objects") return ready;
        Error error = ready.error();
        error.where = "objects";
        return error;
      });
  return std::make_shared<LoadedModel>(std::move(made.model));
}

}  // namespace

void bind_generate(nb::module_& module) {
  module.def("generate", &generate_model, nb::arg("kind"), nb::arg("objects"), nb::arg("seed"),
             nb::arg("turned"), nb::arg("options"));
}

}  // namespace strake::python
