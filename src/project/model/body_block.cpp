// SPDX-License-Identifier: Apache-2.0
#include <array>
#include <bit>
#include <cstring>
#include <string_view>
#include <unordered_map>
#include <utility>

#include "core/seeded_hash.hpp"
#include "project/codec/blob.hpp"
#include "project/model/blocks.hpp"
#include "project/model/columns.hpp"

namespace strake::project {
namespace {

constexpr std::size_t kLinear = 9;
using LinearBits = std::array<double, kLinear>;

LinearBits bits_of(const geometry::Mat3d& linear) {
  LinearBits bits;
  static_assert(sizeof bits == sizeof linear.row);
  std::memcpy(bits.data(), linear.row.data(), sizeof bits);
  return bits;
}

/// The linear parts of placements, each once: most bodies of a model lie along its axes.
class LinearDictionary {
 public:
  std::uint32_t number_of(const geometry::Mat3d& linear) {
    const LinearBits bits = bits_of(linear);
    const std::string key(reinterpret_cast<const char*>(bits.data()), sizeof bits);
    const auto [at, added] = numbers_.try_emplace(key, static_cast<std::uint32_t>(parts_.size()));
    if (added) parts_.push_back(bits);
    return at->second;
  }
  void write(BlobWriter& out) const {
    for (std::size_t k = 0; k < kLinear; ++k) {
      std::vector<double> column;
      column.reserve(parts_.size());
      for (const LinearBits& part : parts_) column.push_back(part[k]);
      out.planes(column);
    }
  }

 private:
  std::unordered_map<std::string, std::uint32_t, SeededHash> numbers_;
  std::vector<LinearBits> parts_;
};

std::vector<geometry::Mat3d> read_linear(BlobReader& in) {
  std::array<std::vector<double>, kLinear> columns;
  for (std::vector<double>& column : columns) {
    column = in.planes<double>();
    if (column.size() != columns.front().size()) in.refuse("placements lack");
  }
  if (in.failed()) return {};
  std::vector<geometry::Mat3d> parts(columns.front().size());
  for (std::size_t i = 0; i < parts.size(); ++i)
    for (std::size_t k = 0; k < kLinear; ++k)
      parts[i].row[k / 3][static_cast<int>(k % 3)] = columns[k][i];
  return parts;
}

std::uint32_t packed(const model::Color& color) {
  return std::uint32_t{color.red} | std::uint32_t{color.green} << 8U |
         std::uint32_t{color.blue} << 16U | std::uint32_t{color.alpha} << 24U;
}

model::Color unpacked(std::uint32_t color) {
  const auto byte = [color](unsigned shift) {
    return static_cast<std::uint8_t>(color >> shift & 0xffU);
  };
  return {byte(0), byte(8), byte(16), byte(24)};
}

/// The columns of bodies, in the order in which they are stored.
struct BodyColumns {
  std::vector<std::uint32_t> shapes, precisions, linear, colors;
  std::array<std::vector<double>, 3> translations;
  std::vector<std::uint8_t> categories;
};

}  // namespace

Result<Blob> pack_bodies(std::span<const model::Body> bodies) {
  BodyColumns columns;
  LinearDictionary linear;
  for (const model::Body& body : bodies) {
    columns.shapes.push_back(model::index(body.shape));
    columns.precisions.push_back(std::bit_cast<std::uint32_t>(body.precision_um));
    columns.linear.push_back(linear.number_of(body.placement.linear));
    columns.colors.push_back(packed(body.color));
    for (std::size_t k = 0; k < 3; ++k)
      columns.translations[k].push_back(body.placement.translation[static_cast<int>(k)]);
    columns.categories.push_back(static_cast<std::uint8_t>(body.category));
  }
  BlobWriter out;
  write_steps(out, columns.shapes);
  out.planes(columns.precisions);
  out.planes(columns.linear);
  out.planes(columns.colors);
  for (const std::vector<double>& translation : columns.translations) out.planes(translation);
  out.column<std::uint8_t>(columns.categories);
  linear.write(out);
  return out.finish();
}

Status unpack_bodies(std::span<const std::byte> blob, std::string what, const FilePlace& place,
                     std::span<model::Body> bodies) {
  Result<BlobReader> in = BlobReader::open(blob, std::move(what));
  if (!in) return in.error();
  BodyColumns columns;
  columns.shapes = read_steps(*in, bodies.size());
  columns.precisions = read_planes(*in, bodies.size());
  columns.linear = read_planes(*in, bodies.size());
  columns.colors = read_planes(*in, bodies.size());
  for (std::vector<double>& translation : columns.translations) {
    translation = in->planes<double>();
    if (translation.size() != bodies.size()) in->refuse("translations lack");
  }
  columns.categories = in->column<std::uint8_t>();
  if (columns.categories.size() != bodies.size()) in->refuse("categories lack");
  const std::vector<geometry::Mat3d> linear = read_linear(*in);
  if (const Status status = in->finish(); !status) return status;
  for (std::size_t i = 0; i < bodies.size(); ++i) {
    if (columns.shapes[i] >= place.shapes || columns.linear[i] >= linear.size() ||
        columns.categories[i] > static_cast<std::uint8_t>(model::Category::insulation)) {
      in->refuse("a body refers to what is not there");
      return in->finish();
    }
    model::Body& body = bodies[i];
    body.shape = model::ShapeId{place.first_shape + columns.shapes[i]};
    body.precision_um = std::bit_cast<float>(columns.precisions[i]);
    body.placement.linear = linear[columns.linear[i]];
    body.placement.translation = {columns.translations[0][i], columns.translations[1][i],
                                  columns.translations[2][i]};
    body.color = unpacked(columns.colors[i]);
    body.category = static_cast<model::Category>(columns.categories[i]);
  }
  return {};
}

}  // namespace strake::project
