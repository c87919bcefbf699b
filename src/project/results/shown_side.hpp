// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <array>
#include <string>

#include "core/text_encoding.hpp"
#include "project/results/clash_rows.hpp"
#include "strake/model/model.hpp"

namespace strake::project {

/// The texts of an object as rows show them.
class ShownSide {
 public:
  ShownSide(const model::Model& model, model::ObjectId id) {
    const model::Object& object = model.object(id);
    shown_ = {valid_utf8(model.files[object.file].label, rooms_[0]),
              valid_utf8(object.id, rooms_[1]), valid_utf8(object.name, rooms_[2])};
  }
  ShownSide(const ShownSide&) = delete;
  ShownSide& operator=(const ShownSide&) = delete;
  [[nodiscard]] const NewClash::Side& texts() const { return shown_; }

 private:
  std::array<std::string, 3> rooms_;
  NewClash::Side shown_;
};

}  // namespace strake::project
