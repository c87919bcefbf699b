// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstddef>
#include <cstdint>
#include <initializer_list>
#include <string>
#include <vector>

#include "drawing/buffered_writer.hpp"
#include "strake/drawing/drawing.hpp"
#include "strake/model/model.hpp"

namespace strake::drawing {

/// The objects that lines name, each once, in the order of the model.
class ListedObjects {
 public:
  ListedObjects(const std::vector<Line>& lines, std::size_t objects);

  [[nodiscard]] const std::vector<model::ObjectId>& objects() const { return objects_; }
  [[nodiscard]] std::uint32_t number(model::ObjectId id) const { return number_[model::index(id)]; }

 private:
  static constexpr std::uint32_t kNot = 0xffffffffU;
  std::vector<std::uint32_t> number_;
  std::vector<model::ObjectId> objects_;
};

/// Writes the beginning of both neutral forms: the opened object and all its members but the lines.
void write_view_head(BufferedWriter& out, const NeutralDrawing& drawing, const model::Model& model,
                     const ListedObjects& listed);

/// Appends "[1,2.5]".
void append_numbers(std::string& out, std::initializer_list<double> values);

}  // namespace strake::drawing
