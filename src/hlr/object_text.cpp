// SPDX-License-Identifier: Apache-2.0
#include "hlr/object_text.hpp"

#include <fmt/format.h>

namespace strake::hlr {

std::string object_text(const model::Model& model, model::ObjectId id) {
  const model::Object& object = model.object(id);
  const std::string& name = object.name.empty() ? object.id : object.name;
  return object.file < model.files.size() && !model.files[object.file].label.empty()
             ? fmt::format("{}: {}", model.files[object.file].label, name)
             : name;
}

}  // namespace strake::hlr
