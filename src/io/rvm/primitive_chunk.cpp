// SPDX-License-Identifier: Apache-2.0
#include "io/rvm/primitive_chunk.hpp"

#include <algorithm>
#include <cmath>
#include <numbers>

namespace strake::io::rvm {

namespace {

using geometry::Vec3d;

/// Returns the stored value in millimetres: the decimal with the fewest places (down to a
/// micrometre) that the same float stands for, or the float itself when there is none.
double decimal_mm(float stored, double unit_mm) {
  const double mm = static_cast<double>(stored) * unit_mm;
  for (const double steps : {1.0, 10.0, 100.0, 1000.0}) {
    const double candidate = std::nearbyint(mm * steps) / steps;
    if (static_cast<float>(candidate / unit_mm) == stored) return candidate;
  }
  return mm;
}

Vec3d column_of(const std::array<float, 12>& m, std::size_t c) {
  return {static_cast<double>(m[3 * c]), static_cast<double>(m[3 * c + 1]),
          static_cast<double>(m[3 * c + 2])};
}

/// Undoes the float rounding of a column that maps one local millimetre to one world millimetre.
Vec3d clean_column(Vec3d column) {
  constexpr double kFloatNoise = 1e-6;
  const double length = std::sqrt(dot(column, column));
  if (!(std::fabs(length - 1) < kFloatNoise)) return column;
  for (int k = 0; k < 3; ++k) {
    // Single-precision cos(90°) leaves 4.4e-8 where zero was meant.
    if (std::fabs(column[k]) < 0x1p-23) column[k] = 0;
  }
  // It is divided, not multiplied by an inverse: a column along an axis becomes exactly one.
  const double clean = std::sqrt(dot(column, column));
  return {column.x / clean, column.y / clean, column.z / clean};
}

/// Reads the parameters of one primitive in file order.
class Parameters {
 public:
  explicit Parameters(Bytes bytes) : cursor_(bytes) {}
  double next() {
    const double value = static_cast<double>(cursor_.f32());
    finite_ = finite_ && std::isfinite(value);
    return value;
  }
  double length() {
    const double value = next();
    negative_ = negative_ || value < 0;
    return value;
  }
  [[nodiscard]] std::string_view problem() const {
    if (!finite_) return "a parameter is not a finite number";
    return negative_ ? "a length is negative" : "";
  }

 private:
  BigEndianCursor cursor_;
  bool finite_ = true, negative_ = false;
};

constexpr std::string_view kNoExtent = "it has no extent";

/// Returns a clean angle: a full turn as single precision stores it, or more, sweeps the whole
/// ring.
double clean_angle(double angle) {
  constexpr double kTurn = 2 * std::numbers::pi;
  return angle > kTurn - 1e-5 ? kTurn : angle;
}

std::string_view angle_problem(double angle) {
  return angle <= 0 ? "the swept angle is not positive" : "";
}

DecodedPrimitive decode_pyramid(Parameters& in) {
  geometry::PyramidPrimitive p;
  p.bottom_x = in.length();
  p.bottom_y = in.length();
  p.top_x = in.length();
  p.top_y = in.length();
  p.offset_x = in.next();
  p.offset_y = in.next();
  p.height = in.length();
  const double x = std::max(p.bottom_x, p.top_x), y = std::max(p.bottom_y, p.top_y);
  const int extents = (x > 0) + (y > 0) + (p.height > 0);
  return {p, extents < 2 ? kNoExtent : ""};
}

DecodedPrimitive decode_box(Parameters& in) {
  geometry::BoxPrimitive p;
  p.length_x = in.length();
  p.length_y = in.length();
  p.length_z = in.length();
  const int extents = (p.length_x > 0) + (p.length_y > 0) + (p.length_z > 0);
  return {p, extents < 2 ? kNoExtent : ""};
}

DecodedPrimitive decode_rectangular_torus(Parameters& in) {
  geometry::RectangularTorusPrimitive p;
  p.inner_radius = in.length();
  p.outer_radius = in.length();
  p.height = in.length();
  p.angle = clean_angle(in.next());
  if (p.outer_radius < p.inner_radius) return {p, "the inner radius is larger than the outer"};
  const int extents = (p.outer_radius > p.inner_radius) + (p.height > 0);
  return {p, p.outer_radius <= 0 || extents == 0 ? kNoExtent : angle_problem(p.angle)};
}

DecodedPrimitive decode_circular_torus(Parameters& in) {
  geometry::CircularTorusPrimitive p;
  p.centre_radius = in.length();
  p.tube_radius = in.length();
  p.angle = clean_angle(in.next());
  return {p, p.tube_radius <= 0 ? kNoExtent : angle_problem(p.angle)};
}

DecodedPrimitive decode_snout(Parameters& in) {
  geometry::SnoutPrimitive p;
  p.bottom_radius = in.length();
  p.top_radius = in.length();
  p.height = in.length();
  p.offset_x = in.next();
  p.offset_y = in.next();
  p.bottom_shear_x = in.next();
  p.bottom_shear_y = in.next();
  p.top_shear_x = in.next();
  p.top_shear_y = in.next();
  if (std::max(p.bottom_radius, p.top_radius) <= 0) return {p, kNoExtent};
  constexpr double kSteepest = std::numbers::pi / 2 - 1e-3;
  for (const double shear : {p.bottom_shear_x, p.bottom_shear_y, p.top_shear_x, p.top_shear_y})
    if (!(std::fabs(shear) < kSteepest)) return {p, "an end plane is sheared by 90° or more"};
  return {p, ""};
}

DecodedPrimitive decode_two_lengths(std::uint32_t kind, Parameters& in) {
  const double a = in.length(), b = in.length();
  const std::string_view problem = a <= 0 ? kNoExtent : "";
  if (kind == 5) return {geometry::EllipticalDishPrimitive{a, b}, problem};
  if (kind == 6) return {geometry::SphericalDishPrimitive{a, b}, problem};
  return {geometry::CylinderPrimitive{a, b}, problem};
}

/// Decodes a line. The file gives the half width a and, in b, the length along local Z; with b = 0
/// only the stored box tells the length.
DecodedPrimitive decode_line(Parameters& in, const std::array<float, 6>& box) {
  const double a = std::fabs(in.next()), b = std::fabs(in.next());
  const double from_box = static_cast<double>(box[5]) - static_cast<double>(box[2]);
  const double length = b > 0 ? b : from_box;
  return {geometry::LinePrimitive{a, length}, length > 0 && std::isfinite(length) ? "" : kNoExtent};
}

struct ChunkKind {
  std::string_view with_article;
  std::size_t parameters = 0;  ///< numbers after the frame; a facet group has lists instead
};

/// By number of the kind in files; decode_primitive() takes the same numbers.
constexpr std::array kKinds{ChunkKind{"a primitive", 0},
                            ChunkKind{"a pyramid", 7},
                            ChunkKind{"a box", 3},
                            ChunkKind{"a rectangular torus", 4},
                            ChunkKind{"a circular torus", 3},
                            ChunkKind{"an elliptical dish", 2},
                            ChunkKind{"a spherical dish", 2},
                            ChunkKind{"a snout", 9},
                            ChunkKind{"a cylinder", 2},
                            ChunkKind{"a sphere", 1},
                            ChunkKind{"a line", 2},
                            ChunkKind{"a facet group", 0}};

}  // namespace

std::size_t kind_count() { return kKinds.size(); }

std::size_t parameter_count(std::uint32_t kind) {
  return kind < kKinds.size() ? kKinds[kind].parameters : 0;
}

std::string_view kind_with_article(std::uint32_t kind) {
  return kKinds[kind < kKinds.size() ? kind : 0].with_article;
}

bool is_plausible_frame(const std::array<float, 12>& matrix) {
  for (const float v : matrix)
    if (!std::isfinite(v)) return false;
  std::array<Vec3d, 3> axis;
  std::array<double, 3> length{};
  for (std::size_t c = 0; c < 3; ++c) {
    axis[c] = column_of(matrix, c);
    length[c] = std::sqrt(dot(axis[c], axis[c]));
  }
  const auto [shortest, longest] = std::minmax_element(length.begin(), length.end());
  if (!(*shortest > 0) || *longest > 1e3 * *shortest) return false;
  for (std::size_t c = 0; c < 3; ++c) {
    const std::size_t d = (c + 1) % 3;
    if (std::fabs(dot(axis[c], axis[d])) > 1e-3 * length[c] * length[d]) return false;
  }
  return true;
}

std::optional<geometry::Placement> placement_of(const std::array<float, 12>& matrix,
                                                const SourceFrame& frame) {
  for (const float v : matrix)
    if (!std::isfinite(v)) return std::nullopt;
  geometry::Placement placement;
  for (std::size_t c = 0; c < 3; ++c) {
    const Vec3d column = frame.turn(clean_column(column_of(matrix, c) * frame.unit_mm));
    for (std::size_t r = 0; r < 3; ++r)
      placement.linear.row[r][static_cast<int>(c)] = column[static_cast<int>(r)];
  }
  placement.translation =
      frame.turn({decimal_mm(matrix[9], frame.unit_mm), decimal_mm(matrix[10], frame.unit_mm),
                  decimal_mm(matrix[11], frame.unit_mm)});
  return placement;
}

DecodedPrimitive decode_primitive(const PrimitiveChunk& chunk) {
  Parameters in(chunk.parameters);
  DecodedPrimitive decoded;
  switch (chunk.kind) {
    case 1:
      decoded = decode_pyramid(in);
      break;
    case 2:
      decoded = decode_box(in);
      break;
    case 3:
      decoded = decode_rectangular_torus(in);
      break;
    case 4:
      decoded = decode_circular_torus(in);
      break;
    case 5:
    case 6:
    case 8:
      decoded = decode_two_lengths(chunk.kind, in);
      break;
    case 7:
      decoded = decode_snout(in);
      break;
    case 9: {
      const double diameter = in.length();
      decoded = {geometry::SpherePrimitive{diameter}, diameter > 0 ? "" : kNoExtent};
      break;
    }
    case kLineKind:
      decoded = decode_line(in, chunk.box);
      break;
    default:
      return {std::nullopt, "the kind is not known"};
  }
  if (!in.problem().empty()) decoded.problem = in.problem();
  if (!decoded.problem.empty()) decoded.primitive.reset();
  return decoded;
}

}  // namespace strake::io::rvm
