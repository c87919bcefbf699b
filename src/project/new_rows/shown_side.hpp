// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <array>
#include <string>
#include <string_view>

#include "core/text_encoding.hpp"
#include "strake/model/model.hpp"

namespace strake::project {

/// What rows show of an object.
struct ShownTexts {
  std::string_view file, id, name;
};

/// The texts of an object as rows show them: what is no UTF-8 lies here.
class ShownSide {
 public:
  ShownSide(const model::Model& model, model::ObjectId id) {
    const model::Object& object = model.object(id);
    shown_ = {valid_utf8(model.files[object.file].label, rooms_[0]),
              valid_utf8(object.id, rooms_[1]), valid_utf8(object.name, rooms_[2])};
  }
  ShownSide(const ShownSide&) = delete;
  ShownSide& operator=(const ShownSide&) = delete;
  [[nodiscard]] const ShownTexts& texts() const { return shown_; }

 private:
  std::array<std::string, 3> rooms_;
  ShownTexts shown_;
};

}  // namespace strake::project
